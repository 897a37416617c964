#!/usr/bin/env python3
"""A long run under fire: a tube that is killed at random moments and resumed, for as long as is asked for.

    /usr/bin/python3 tests/reliability/soak.py [--hours 1] [--threads 2] [--seed 1] [--out DIRECTORY]

10,000 grains, a checkpoint every three seconds. Looked at once a second: the memory of the process, and
what its checkpoint counts. After each kill, rows that are missing or out of step in run.h5. At the end it
prints how memory and cost per step went over the time, and ends with status 1 if rows were lost, a resume
failed, or memory grew by more than rows take. The first sixth of the time does not count for that: profiles
and histograms keep up to 128 samples apart, and then add them up in pairs.
The command is build/release/app/riesel, or what the variable RIESEL names.
"""

import argparse
import dataclasses
import os
import pathlib
import random
import re
import shutil
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
PARTS = 6  # of the time, the first of which does not count for the growth of memory
GROWTH = 1.0  # MB, that is borne besides
ROW = 2e-3  # MB that a row takes: 41 numbers, in the state and in the images of the files


@dataclasses.dataclass
class Look:
    """At a running process, or at its last checkpoint."""
    life: int
    hour: float  # since the start of the soak
    age: float  # s, of the process
    memory: float  # MB, resident
    step: int
    wall: float  # s, that all lives have used up to this step, as the checkpoint tells


def memory_of(process):
    """MB, or None if the process has ended."""
    try:
        text = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    except FileNotFoundError:
        return None
    resident = re.search(r"^VmRSS:\s*(\d+) kB", text, re.MULTILINE)
    return int(resident[1]) / 1024 if resident else None


def counted(checkpoint):
    with h5py.File(checkpoint, "r") as file:
        return {name: file.attrs[name].item() for name in ("step", "wall_seconds", "rows", "time_step")}


class Soak:
    def __init__(self, out, threads, seed):
        self.out, self.threads = out, threads
        self.random = random.Random(seed)
        self.begin = time.monotonic()
        self.looks, self.complaints = [], []
        self.lives = 0

    def start(self):
        if (self.out / "checkpoint.h5").exists():
            what = ["resume", self.out]
        else:
            what = ["run", HOME / "scenarios/periodic_tube.yaml", "--out", self.out]
            what += [word for item in TUBE.items() for word in ("--set", "=".join(item))]
        self.lives += 1
        return subprocess.Popen([COMMAND, *what, "--quiet", "--threads", str(self.threads)],
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def look(self, process, born):
        memory = memory_of(process)
        if memory is None or not (self.out / "checkpoint.h5").exists():
            return
        now = counted(self.out / "checkpoint.h5")
        self.looks.append(Look(self.lives, (time.monotonic() - self.begin) / 3600,
                               time.monotonic() - born, memory, now["step"], now["wall_seconds"]))

    def live(self, seconds):
        """One life: from a start or resume to a kill."""
        process, born = self.start(), time.monotonic()
        while time.monotonic() - born < seconds and process.poll() is None:
            time.sleep(min(1.0, max(0.0, born + seconds - time.monotonic())))
            self.look(process, born)
        process.kill()
        message = process.communicate()[1]
        if process.returncode != KILLED:
            self.complaints.append(f"life {self.lives} ended with status {process.returncode}: {message}")
        self.look_at_rows()

    def look_at_rows(self):
        if not (self.out / "checkpoint.h5").exists():  # killed before the first: to be started again
            shutil.rmtree(self.out, ignore_errors=True)
            return
        now = counted(self.out / "checkpoint.h5")
        with h5py.File(self.out / "run.h5", "r") as file:
            steps = np.rint(file["series/time"][:] / now["time_step"]).astype(np.int64)
        if len(steps) < now["rows"]:
            self.complaints.append(f"life {self.lives}: {now['rows'] - len(steps)} rows are lost")
        if len(set(np.diff(steps))) > 1:
            self.complaints.append(f"life {self.lives}: rows are not in step")

    def go_on_for(self, hours):
        while (left := 3600 * hours - (time.monotonic() - self.begin)) > 0:
            # From a second to ten minutes, each decade as often as the next.
            self.live(min(left, 10 ** self.random.uniform(0.0, 2.78)))
            if self.complaints:
                return

    # --- what came of it ---

    def costs(self):
        """[(hour, microseconds on the clock per step)] between the checkpoints of one life."""
        costs = []
        for before, after in zip(self.looks, self.looks[1:]):
            if before.life == after.life and before.age > WARM and after.step > before.step:
                costs.append((after.hour, 1e6 * (after.wall - before.wall) / (after.step - before.step)))
        return costs

    def print_parts(self, hours):
        """Prints a row for each part of the time; returns the largest memory of each, in MB."""
        costs, largest = self.costs(), []
        print("| part of the time | memory, MB: median | largest | cost of a step, us | checkpoints |")
        print("|---|--:|--:|--:|--:|")
        for part in range(PARTS):
            low, high = (hours * k / PARTS for k in (part, part + 1))
            memory = [look.memory for look in self.looks if low <= look.hour < high and look.age > WARM]
            cost = [value for hour, value in costs if low <= hour < high]
            if len(memory) < 2 or len(cost) < 2:
                continue
            largest.append(max(memory))
            print(f"| {60 * low:.3g} to {60 * high:.3g} min | {statistics.median(memory):.1f} "
                  f"| {largest[-1]:.1f} | {statistics.median(cost):.1f} +- "
                  f"{statistics.stdev(cost) / len(cost) ** 0.5:.1f} | {len(cost)} |")
        return largest

    def report(self, hours):
        largest = self.print_parts(hours)
        now = counted(self.out / "checkpoint.h5")
        if len(largest) > 2 and largest[-1] - largest[1] > GROWTH + ROW * now["rows"]:
            self.complaints.append("memory grew")
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
    soak.go_on_for(options.hours)
    soak.report(options.hours)
    return 1 if soak.complaints else 0


if __name__ == "__main__":
    sys.exit(main())
