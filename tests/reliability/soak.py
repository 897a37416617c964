#!/usr/bin/env python3
"""A long run under fire: a tube that is killed at random moments and resumed, for as long as is asked for.

    /usr/bin/python3 tests/reliability/soak.py [--hours 1] [--threads 2] [--seed 1] [--out DIRECTORY]

10,000 grains, a checkpoint every three seconds. The first quarter of the time is of lives of one second to ten
minutes, then comes one life that takes half of it, then short ones again. Looked at ten times a second: the memory of
the process, its processor time, and what its checkpoint counts. After each kill, the checkpoint and the rows of run.h5.
At the end it prints how memory and cost per step went over the time, and over the long life, and ends with status 1

- if a checkpoint that had been seen was gone, or replaced by an older one;
- if rows were lost or out of step, or a resume failed;
- if memory grew by more than rows take, over the time or over the long life, from the second sixth to the last;
- if a step got dearer, likewise: if the median of its cost, from one checkpoint to the next, grew by more than 10 %
  and three standard errors of the difference of the medians.

The first 20 s of a life do not count, nor what has fewer than 128 rows: profiles and histograms keep up to 128 samples
apart, and then add them up in pairs. A soak that is too short for one of these judgements says so.
The cost of a step is its processor time as a multiple of what a step of the yardstick takes at that time: always the
same steps, from a copy of the same early checkpoint, for which the tube is halted twice a minute. So it tells the
program from what else the machine does. Threads that wait for each other use processor time, too: on a machine that is
busy otherwise OMP_WAIT_POLICY=passive in the environment is needed, or --threads 1.
The command is build/release/app/riesel, or what the variable RIESEL names.
"""

import argparse
import dataclasses
import math
import os
import pathlib
import random
import re
import shutil
import signal
import statistics
import subprocess
import sys
import time

import h5py
import numpy as np

HOME = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.path.abspath(os.environ.get("RIESEL", HOME / "build/release/app/riesel"))
TUBE = {"tube.length": "0.714 m", "run.stepping": "windows", "run.duration": "1000 s",
        "output.interval": "20 ms", "output.checkpoint_interval": "3 s"}
KILLED = -9
WARM = 20.0  # s: older lives have made all that they keep
LOOK = 0.1  # s, from one look to the next
SAMPLES = 128  # rows after which profiles and histograms do not grow any more
PARTS = 6  # of the time; what grew is told from
EARLY, LATE = 1, PARTS - 1  # the second and the last
GROWTH = 1.0  # MB, that is borne besides
ROW = 2e-3  # MB that a row takes: 41 numbers, in the state and in the images of the files
DEARER, ERRORS = 0.1, 3.0  # that are borne: a part of the cost of a step, and standard errors
FEWEST = 5  # costs in a part of the time, to tell its median and error
BETWEEN_YARDSTICKS = 30.0  # s
YARDSTICK = ("300 ms", "330 ms")  # of flow: from where to where


@dataclasses.dataclass
class Look:
    """At a running process, or at its last checkpoint."""
    life: int
    hour: float  # since the start of the soak
    age: float  # s, of the process
    memory: float  # MB, resident
    processor: float  # s, that the process has used on all its threads
    step: int  # of the last checkpoint, as
    rows: int
    is_first: bool  # to see this checkpoint


@dataclasses.dataclass
class Yardstick:
    hour: float  # since the start of the soak
    cost: float  # us of processor time per step


def memory_of(process):
    """MB, or None if the process has ended."""
    try:
        text = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    except FileNotFoundError:
        return None
    resident = re.search(r"^VmRSS:\s*(\d+) kB", text, re.MULTILINE)
    return int(resident[1]) / 1024 if resident else None


def processor_time_of(process):
    """s, in user and kernel mode; of a process that has ended and not been waited for, too."""
    stat = pathlib.Path(f"/proc/{process.pid}/stat").read_text(encoding="utf-8")
    user, kernel = stat.rpartition(")")[2].split()[11:13]
    return (int(user) + int(kernel)) / os.sysconf("SC_CLK_TCK")


def counted(checkpoint):
    with h5py.File(checkpoint, "r") as file:
        return {name: file.attrs[name].item() for name in ("step", "rows", "time_step")}


def median_with_error(values):
    """The standard error is that of the median of as many normal values of the same scatter."""
    return statistics.median(values), math.sqrt(math.pi / 2) * statistics.stdev(values) / math.sqrt(len(values))


def gets_dearer(early, late):
    """(whether, in words), of the costs of steps in two parts of the time"""
    (before, error_before), (after, error_after) = median_with_error(early), median_with_error(late)
    borne = DEARER * before + ERRORS * math.hypot(error_before, error_after)
    return after - before > borne, (f"a step costs {after:.3f} yardsticks after {before:.3f}, "
                                    f"{after - before:+.3f} of which {borne:.3f} are borne")


class Soak:
    def __init__(self, out, threads, seed):
        self.out, self.threads = out, threads
        self.early = out.with_name(out.name + "-yardstick")
        self.random = random.Random(seed)
        self.begin = time.monotonic()
        self.looks, self.yardsticks, self.complaints = [], [], []
        self.lives = 0
        self.long_life = None
        self.seen, self.saved = None, None  # the last checkpoint: when it was written, and what it counts

    def hour(self):
        return (time.monotonic() - self.begin) / 3600

    def command(self, *words, **settings):
        given = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        return [COMMAND, *words, *given, "--quiet", "--threads", str(self.threads)]

    def beginning(self, out, **settings):
        return self.command("run", HOME / "scenarios/periodic_tube.yaml", "--out", out, **{**TUBE, **settings})

    # --- the yardstick ---

    def make_yardstick(self):
        shutil.rmtree(self.early, ignore_errors=True)  # of an earlier soak
        subprocess.run(self.beginning(self.early, **{"run.duration": YARDSTICK[0]}), check=True)

    def take_yardstick(self):
        copy = self.early.with_name(self.early.name + "-copy")
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(self.early, copy)
        first = counted(copy / "checkpoint.h5")["step"]
        process = subprocess.Popen(self.command("resume", copy, **{"run.duration": YARDSTICK[1]}))
        _, status, used = os.wait4(process.pid, 0)
        if status != 0:
            raise SystemExit(f"the yardstick {copy} ended with status {status}")
        steps = counted(copy / "checkpoint.h5")["step"] - first
        self.yardsticks.append(Yardstick(self.hour(), 1e6 * (used.ru_utime + used.ru_stime) / steps))

    def take_yardstick_if_due(self, process):
        if not self.yardsticks or 3600 * (self.hour() - self.yardsticks[-1].hour) > BETWEEN_YARDSTICKS:
            process.send_signal(signal.SIGSTOP)
            try:
                self.take_yardstick()
            finally:
                process.send_signal(signal.SIGCONT)

    # --- lives ---

    def start(self):
        goes_on = (self.out / "checkpoint.h5").exists()
        self.lives += 1
        return subprocess.Popen(self.command("resume", self.out) if goes_on else self.beginning(self.out),
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def look(self, process, born):
        memory, checkpoint = memory_of(process), self.out / "checkpoint.h5"
        if memory is None or not checkpoint.exists():
            return
        processor, written = processor_time_of(process), checkpoint.stat().st_mtime_ns
        is_first = written != self.seen
        if is_first:
            self.seen = written
            self.note_checkpoint()
        self.looks.append(Look(self.lives, self.hour(), time.monotonic() - born, memory,
                               processor, self.saved["step"], self.saved["rows"], is_first))

    def note_checkpoint(self):
        """It must not be older than any that was seen before."""
        now = counted(self.out / "checkpoint.h5")
        for what in ("step", "rows"):
            if self.saved is not None and now[what] < self.saved[what]:
                self.complaints.append(f"life {self.lives}: back from {what} {self.saved[what]} to {now[what]}")
        self.saved = now

    def live(self, seconds):
        """One life: from a start or resume to a kill."""
        process, born = self.start(), time.monotonic()
        while (left := born + seconds - time.monotonic()) > 0 and process.poll() is None:
            time.sleep(min(LOOK, left))
            self.look(process, born)
            self.take_yardstick_if_due(process)
        process.kill()
        message = process.communicate()[1]
        if process.returncode != KILLED:
            self.complaints.append(f"life {self.lives} ended with status {process.returncode}: {message}")
        self.look_at_rows()

    def look_at_rows(self):
        """After the end of a life: what had been saved before must be there, and its rows."""
        if not (self.out / "checkpoint.h5").exists():
            if self.saved is not None:
                self.complaints.append(f"life {self.lives}: the checkpoint of step {self.saved['step']} is gone")
            else:  # killed before the first: to be started again
                shutil.rmtree(self.out, ignore_errors=True)
            return
        self.note_checkpoint()
        now = self.saved
        with h5py.File(self.out / "run.h5", "r") as file:
            steps = np.rint(file["series/time"][:] / now["time_step"]).astype(np.int64)
        if len(steps) < now["rows"]:
            self.complaints.append(f"life {self.lives}: {now['rows'] - len(steps)} rows are lost")
        if len(set(np.diff(steps))) > 1:
            self.complaints.append(f"life {self.lives}: rows are not in step")

    def short_lives_until(self, hour):
        while (left := 3600 * (hour - self.hour())) > 0 and not self.complaints:
            # From a second to ten minutes, each decade as often as the next.
            self.live(min(left, 10 ** self.random.uniform(0.0, 2.78)))

    def go_on_for(self, hours):
        self.short_lives_until(0.25 * hours)
        self.long_life = self.lives + 1
        if not self.complaints:
            self.live(0.5 * 3600 * hours)
        self.short_lives_until(hours)

    # --- what came of it ---

    def costs(self):
        """[(look, processor time per step in yardsticks)] between the checkpoints of one life."""
        costs, looks = [], [look for look in self.looks if look.is_first]
        for before, after in zip(looks, looks[1:]):
            if before.life == after.life and before.age > WARM and after.step > before.step:
                cost = 1e6 * (after.processor - before.processor) / (after.step - before.step)
                costs.append((after, cost / self.yardstick_at(after.hour)))
        return costs

    def yardstick_at(self, hour):
        """us, the median of the five that were taken next to it"""
        nearest = sorted(self.yardsticks, key=lambda yardstick: abs(yardstick.hour - hour))[:5]
        return statistics.median(yardstick.cost for yardstick in nearest)

    def parts(self, hours, hour_of, counts=lambda look: True):
        """[(looks, costs of a step)] of each part of the time that hour_of(look) tells."""
        looks = [look for look in self.looks if look.age > WARM and look.rows >= SAMPLES and counts(look)]
        costs, parts = [(look, cost) for look, cost in self.costs() if counts(look)], []
        for part in range(PARTS):
            low, high = (hours * k / PARTS for k in (part, part + 1))
            parts.append(([look for look in looks if low <= hour_of(look) < high],
                          [cost for look, cost in costs if low <= hour_of(look) < high]))
        return parts

    @staticmethod
    def print_parts(parts, hours, what):
        print(f"| part of {what} | memory, MB: median | largest | cost of a step, yardsticks | checkpoints |")
        print("|---|--:|--:|--:|--:|")
        for part, (looks, costs) in enumerate(parts):
            if not looks or len(costs) < 2:
                continue
            low, high = (60 * hours * k / PARTS for k in (part, part + 1))
            memory = [look.memory for look in looks]
            cost, error = median_with_error(costs)
            print(f"| {low:.3g} to {high:.3g} min | {statistics.median(memory):.1f} | {max(memory):.1f} "
                  f"| {cost:.3f} +- {error:.3f} | {len(costs)} |")

    def judge_memory(self, early, late, what):
        if not early or not late:
            print(f"{what}: too short to judge the memory")
            return
        before, after = (max(look.memory for look in looks) for looks in (early, late))
        borne = GROWTH + ROW * (late[-1].rows - early[0].rows)
        print(f"{what}: at most {after:.1f} MB after {before:.1f} MB, {after - before:+.1f} MB of which {borne:.1f} MB are borne")
        if after - before > borne:
            self.complaints.append(f"memory grew over {what}")

    def judge_costs(self, early, late, what):
        if min(len(early), len(late)) < FEWEST:
            print(f"{what}: too short to judge the cost of a step")
            return
        dearer, words = gets_dearer(early, late)
        print(f"{what}: {words}")
        if dearer:
            self.complaints.append(f"steps got dearer over {what}")

    def judge(self, parts, hours, what):
        self.print_parts(parts, hours, what)
        (early, early_costs), (late, late_costs) = parts[EARLY], parts[LATE]
        self.judge_memory(early, late, what)
        self.judge_costs(early_costs, late_costs, what)

    def judge_all(self, hours):
        self.judge(self.parts(hours, lambda look: look.hour), hours, "the time")
        self.judge(self.parts(0.5 * hours, lambda look: look.age / 3600, lambda look: look.life == self.long_life),
                   0.5 * hours, "the long life")

    def report(self, hours):
        self.judge_all(hours)
        taken = [yardstick.cost for yardstick in self.yardsticks]
        print(f"{len(taken)} yardsticks of {min(taken):.1f} to {max(taken):.1f} us per step, median {statistics.median(taken):.1f} us")
        now = self.saved or {"step": 0, "time_step": 0.0, "rows": 0}
        print(f"{self.lives} lives, {now['step']} steps ({now['step'] * now['time_step']:.3g} s of flow), "
              f"{now['rows']} rows, {len(self.complaints)} complaints")
        for complaint in self.complaints:
            print(complaint)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hours", type=float, default=1.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1, help="of the moments of the kills")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("runs/soak"))
    options = parser.parse_args()
    if options.out.exists():
        parser.error(f"{options.out} is there already; choose another directory by --out")
    options.out.parent.mkdir(parents=True, exist_ok=True)

    soak = Soak(options.out, options.threads, options.seed)
    soak.make_yardstick()
    soak.go_on_for(options.hours)
    soak.report(options.hours)
    return 1 if soak.complaints else 0


if __name__ == "__main__":
    sys.exit(main())
