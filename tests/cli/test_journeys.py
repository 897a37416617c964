"""The same bits, whatever happens on the way: random flows, in tubes that may shake, shear cells and chutes, each run once
plainly on one thread in one go, and then again by random journeys that mix all that must not matter.

A journey draws anew for each of its legs: the number of threads (1 to 4), the way of stepping, whether a profile is
measured, and how the leg ends, by itself, by a limit, by a polite signal or by a kill at a random moment. For the whole
of it: how often checkpoints are written, whether frames are, how often rows are, and whether limits stop it, from where
it goes on by the post mortem. And it may be a point of a sweep, of which the order of the points and the number of jobs
are drawn, too.

The variable RIESEL_JOURNEYS tells how many flows are tried, 4 unless it is set, and RIESEL_FIRST the first of them.
"""

import os
import random
import shutil
import signal
import time

from riesel_command import FAILED, PATIENCE, CommandTest, PROGRESS

FLOWS = int(os.environ.get("RIESEL_JOURNEYS", "4"))
FIRST = int(os.environ.get("RIESEL_FIRST", "1"))
JOURNEYS = 3  # of each flow
ROWS = "1 ms"
# Exit status of a run that heeds a signal; of one that has hardly begun, or cannot, it is minus the signal.
HEEDED = {signal.SIGTERM: 143, signal.SIGINT: 130}


ROOMS = {
    "periodic_tube": """\
tube: {{width: 10 mm, length: {length} mm}}
grains: {{area_fraction: {fraction}, {grains}}}
wall: {{spacing: {spacing}{shaking}}}
start: {{axial_velocity: 1 m/s, random_velocity: {random_velocity} m/s}}
""",
    "shear_cell": """\
cell: {{width: 10 mm, length: {length} mm, velocity: {random_velocity} m/s}}
grains: {{area_fraction: {fraction}, {grains}}}
wall: {{spacing: {spacing}}}
start: {{random_velocity: {random_velocity} m/s}}
""",
    "inclined_chute": """\
chute: {{inclination: 25 degrees, length: {length} mm, layers: 6, height: 40 mm}}
grains: {{{grains}}}
wall: {{spacing: {spacing}}}
start: {{axial_velocity: 1 m/s, random_velocity: 0.3 m/s}}
"""}


class Flow:
    """Settings of a small one."""

    def __init__(self, dice):
        self.seeds = dice.sample(range(1, 1000), 2)
        rotation = dice.choice(["none", "disc", "sphere"])
        slip = "spring, slip_stiffness: 800 N/m" if rotation != "none" and dice.random() < 0.5 else "cap"
        scenario = dice.choice(["periodic_tube", "periodic_tube", "shear_cell", "inclined_chute"])
        room = ROOMS[scenario].format(
            length=dice.choice([8, 12]),
            fraction=dice.choice([0.2, 0.5, 0.7]),
            grains=f"rotation: {rotation}, " + dice.choice(
                ["polydispersity: 0.1", "size_distribution: bidisperse, size_ratio: 2, large_fraction: 0.2"]),
            spacing=dice.choice(["0.66 mm", "1.2 mm"]),
            random_velocity=dice.choice([0.5, 2]),
            shaking=dice.choice(["", f", shake_amplitude: 0.3 mm, shake_frequency: 100, shake_angle: {dice.choice([0, 0.7, 1.5])}"]))
        self.text = f"""\
scenario: {scenario}
contact: {{stiffness: {dice.choice([500, 2000, 10000])} N/m, restitution: {dice.choice([0.6, 0.9])}, slip: {slip}}}
{room}run: {{duration: {dice.choice([10, 25])} ms}}
seed: {self.seeds[0]}
output: {{interval: {ROWS}}}
limits: {{speed: 3 m/s, overlap: 0.05, action: warn}}
"""


class Journeys(CommandTest):

    def leg(self, dice, first, out, length):
        """Arguments of a run (`first`: its settings) or of its resume, and after how long and by what it is stopped, if
        it is."""
        how = ["--threads", dice.choice([1, 1, 2, 3, 4]), *(["--profile"] if dice.random() < 0.3 else []),
               "--set", "run.stepping=" + dice.choice(["plain", "windows", "auto"])]
        stop = dice.choice([None, signal.SIGTERM, signal.SIGINT, signal.SIGKILL, signal.SIGKILL])
        arguments = ["run", "flow.yaml", "--out", out, *first] if first is not None else ["resume", out]
        return [*arguments, *how], stop, dice.uniform(0.0, 1.2) * length

    def is_done(self, out):
        return (self.home / out / "summary.json").exists()

    def travel(self, dice, out, settings, length, legs):
        """By legs, which are added to the list, until the run is done. `length` (s) of the run in one go."""
        first = settings
        by_limit = False  # the last leg was ended
        while not self.is_done(out):
            arguments, stop, after = self.leg(dice, first, out, length)
            if by_limit:
                arguments[1] = f"{out}/post_mortem.h5"
                arguments += ["--set", "limits.action=warn"]
            process = self.start(*arguments)
            legs.append((arguments[3:], stop, after))
            if stop is not None and len(legs) < 12:  # and then in peace
                time.sleep(after)
                process.send_signal(stop)
            _, stderr = process.communicate(timeout=PATIENCE)
            interrupted = set() if stop is None else {-stop, HEEDED.get(stop, -stop)}
            self.interrupted += process.returncode in interrupted
            by_limit = process.returncode == FAILED and "to go on from there, remove the limit" in stderr
            self.limited += by_limit
            ends = {0} | interrupted | ({FAILED} if by_limit else set())
            self.assertIn(process.returncode, ends, (legs, stderr))
            complaints = [line for line in stderr.splitlines() if not PROGRESS.fullmatch(line)
                          and not line.startswith("riesel: limits.")]
            self.assertTrue(process.returncode != 0 or not complaints, (legs, stderr))
            first = None
            if not by_limit and not (self.home / out / "checkpoint.h5").exists():  # it has to be started again
                shutil.rmtree(self.home / out, ignore_errors=True)
                first = settings

    def test_random_journeys_come_to_the_same_bits(self):
        legs = warned = 0
        self.interrupted = self.limited = 0
        for number in range(FIRST, FIRST + FLOWS):
            flow = Flow(random.Random(number))
            self.write("flow.yaml", flow.text)
            began = time.monotonic()
            whole = self.home / f"whole-{number}"
            result = self.riesel("run", "flow.yaml", "--out", whole, "--threads", 1, "--set", "run.stepping=plain")
            self.assertEqual(result.returncode, 0, result)
            warned += len(self.summary(whole)["validity"]["warnings"])
            length = time.monotonic() - began
            for journey in range(JOURNEYS):
                dice = random.Random(f"{number}-{journey}")  # how many draws a journey takes depends on the clock
                same_rows = dice.random() < 0.6
                frames = dice.random() < 0.4
                settings = ["--set", f"output.checkpoint_interval={dice.choice(['1e-6', '0.02', '0.1'])} s"]
                settings += [] if same_rows else ["--set", f"output.interval={dice.choice(['0.3', '2', '40'])} ms"]
                settings += ["--set", "output.trajectory_interval=1 ms"] if frames else []
                settings += ["--set", "limits.action=stop"] if dice.random() < 0.5 else []
                out = f"journey-{number}-{journey}"
                with self.subTest(flow=flow.text, settings=settings):
                    travelled = []
                    self.travel(dice, out, settings, length, travelled)
                    legs += len(travelled)
                    with self.subTest(legs=travelled):
                        if same_rows:
                            self.assert_same_result(whole, self.home / out)
                        else:
                            self.assertEqual(self.state_hash(whole), self.state_hash(self.home / out))
            with self.subTest(flow=flow.text, sweep=True):
                self.assert_point_is_the_same(random.Random(f"{number}-sweep"), number, flow, whole)
        self.assertGreater(self.interrupted, 0)
        self.assertGreater(warned, 0)
        self.assertGreater(self.limited, 0)
        print(f"{FLOWS} flows, {FLOWS * JOURNEYS} journeys of {legs} legs, "
              f"{self.interrupted} of them ended by a signal and {self.limited} by a limit")

    def assert_point_is_the_same(self, dice, number, flow, whole):
        """As a point of a sweep, among others in any order."""
        seeds = dice.sample(flow.seeds, len(flow.seeds))
        sweep = self.write("sweep.yaml", f"base: flow.yaml\nset: {{run.stepping: {dice.choice(['plain', 'windows'])}}}\n"
                                         f"seeds: {seeds}\n")
        out = f"sweep-{number}"
        result = self.riesel("sweep", sweep, "--out", out, "--jobs", dice.choice([1, 2, 3]))
        self.assertEqual(result.returncode, 0, result)
        hashes = [self.summary(path.parent)["state_hash"] for path in (self.home / out).rglob("summary.json")]
        self.assertIn(self.state_hash(whole), hashes)
        self.assertEqual(len(set(hashes)), len(seeds))
