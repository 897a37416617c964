"""The same bits, whatever happens on the way: random tubes, each run once plainly on one thread in one go, and then
again by random journeys that mix all that must not matter.

A journey draws anew for each of its legs: the number of threads (1 to 4), the way of stepping, whether a profile is
measured, and how the leg ends, by itself, by a polite signal or by a kill at a random moment. For the whole of it: how
often checkpoints are written, whether frames are, and how often rows are. And it may be a point of a sweep, of which
the order of the points and the number of jobs are drawn, too.

The variable RIESEL_JOURNEYS tells how many tubes are tried, 4 unless it is set, and RIESEL_FIRST the first of them.
"""

import os
import random
import shutil
import signal
import time

from riesel_command import PATIENCE, CommandTest, PROGRESS

TUBES = int(os.environ.get("RIESEL_JOURNEYS", "4"))
FIRST = int(os.environ.get("RIESEL_FIRST", "1"))
JOURNEYS = 3  # of each tube
ROWS = "1 ms"
# Exit status of a run that heeds a signal; of one that has hardly begun, or cannot, it is minus the signal.
HEEDED = {signal.SIGTERM: 143, signal.SIGINT: 130}


class Tube:
    """Settings of a small tube."""

    def __init__(self, dice):
        self.seeds = dice.sample(range(1, 1000), 2)
        rotation = dice.choice(["none", "disc", "sphere"])
        slip = "spring, slip_stiffness: 800 N/m" if rotation != "none" and dice.random() < 0.5 else "cap"
        self.text = f"""\
scenario: periodic_tube
contact: {{stiffness: {dice.choice([500, 2000, 10000])} N/m, restitution: {dice.choice([0.6, 0.9])}, slip: {slip}}}
grains: {{area_fraction: {dice.choice([0.2, 0.5])}, rotation: {rotation}}}
tube: {{width: 10 mm, length: {dice.choice([8, 12])} mm}}
wall: {{spacing: {dice.choice(["0.66 mm", "1.2 mm"])}}}
start: {{axial_velocity: 1 m/s, random_velocity: {dice.choice([0.5, 2])} m/s}}
run: {{duration: {dice.choice([10, 25])} ms}}
seed: {self.seeds[0]}
output: {{interval: {ROWS}}}
limits: {{speed: 3 m/s, overlap: 0.05, action: warn}}
"""


class Journeys(CommandTest):

    def leg(self, dice, first, out, length):
        """Arguments of a run or of its resume, and after how long and by what it is stopped, if it is."""
        how = ["--threads", dice.choice([1, 1, 2, 3, 4]), *(["--profile"] if dice.random() < 0.3 else []),
               "--set", "run.stepping=" + dice.choice(["plain", "windows", "auto"])]
        stop = dice.choice([None, signal.SIGTERM, signal.SIGINT, signal.SIGKILL, signal.SIGKILL])
        arguments = ["run", "tube.yaml", "--out", out, *first] if first is not None else ["resume", out]
        return [*arguments, *how], stop, dice.uniform(0.0, 1.2) * length

    def is_done(self, out):
        return (self.home / out / "summary.json").exists()

    def travel(self, dice, out, settings, length):
        """By legs until the run is done. Returns in how many. `length` (s) of the run in one go."""
        first, legs = settings, 0
        while not self.is_done(out):
            arguments, stop, after = self.leg(dice, first, out, length)
            process = self.start(*arguments)
            legs += 1
            if stop is not None and legs < 12:  # and then in peace
                time.sleep(after)
                process.send_signal(stop)
            _, stderr = process.communicate(timeout=PATIENCE)
            ends = {0} if stop is None else {0, -stop, HEEDED.get(stop, 0)}
            self.assertIn(process.returncode, ends, (arguments, stderr))
            complaints = [line for line in stderr.splitlines() if not PROGRESS.fullmatch(line)
                          and not line.startswith("riesel: limits.")]
            self.assertTrue(process.returncode != 0 or not complaints, stderr)
            first = None
            if not (self.home / out / "checkpoint.h5").exists():  # it has to be started again
                shutil.rmtree(self.home / out, ignore_errors=True)
                first = settings
        return legs

    def test_random_journeys_come_to_the_same_bits(self):
        legs = warned = 0
        for number in range(FIRST, FIRST + TUBES):
            dice = random.Random(number)
            tube = Tube(dice)
            self.write("tube.yaml", tube.text)
            began = time.monotonic()
            whole = self.home / f"whole-{number}"
            result = self.riesel("run", "tube.yaml", "--out", whole, "--threads", 1, "--set", "run.stepping=plain")
            self.assertEqual(result.returncode, 0, result)
            warned += len(self.summary(whole)["validity"]["warnings"])
            length = time.monotonic() - began
            for journey in range(JOURNEYS):
                same_rows = dice.random() < 0.6
                frames = dice.random() < 0.4
                settings = ["--set", f"output.checkpoint_interval={dice.choice(['1e-6', '0.02', '0.1'])} s"]
                settings += [] if same_rows else ["--set", f"output.interval={dice.choice(['0.3', '2', '40'])} ms"]
                settings += ["--set", "output.trajectory_interval=1 ms"] if frames else []
                out = f"journey-{number}-{journey}"
                with self.subTest(tube=tube.text, settings=settings):
                    legs += self.travel(dice, out, settings, length)
                    if same_rows:
                        self.assert_same_result(whole, self.home / out)
                    else:
                        self.assertEqual(self.state_hash(whole), self.state_hash(self.home / out))
            with self.subTest(tube=tube.text, sweep=True):
                self.assert_point_is_the_same(dice, number, tube, whole)
        self.assertGreater(legs, TUBES * JOURNEYS, "none was interrupted")
        self.assertGreater(warned, 0)

    def assert_point_is_the_same(self, dice, number, tube, whole):
        """As a point of a sweep, among others in any order."""
        seeds = dice.sample(tube.seeds, len(tube.seeds))
        sweep = self.write("sweep.yaml", f"base: tube.yaml\nset: {{run.stepping: {dice.choice(['plain', 'windows'])}}}\n"
                                         f"seeds: {seeds}\n")
        out = f"sweep-{number}"
        result = self.riesel("sweep", sweep, "--out", out, "--jobs", dice.choice([1, 2, 3]))
        self.assertEqual(result.returncode, 0, result)
        hashes = [self.summary(path.parent)["state_hash"] for path in (self.home / out).rglob("summary.json")]
        self.assertIn(self.state_hash(whole), hashes)
        self.assertEqual(len(set(hashes)), len(seeds))


del CommandTest
