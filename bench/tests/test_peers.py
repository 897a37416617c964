"""What other codes are told of a state, against what riesel itself writes of it in SI units; how they are tuned, and what is
read from their answers. None of them is needed."""

import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))
import run  # noqa: E402
import table as peers_table  # noqa: E402
from lammps import Lammps, Liggghts, read_answer, write_data  # noqa: E402
from peer import Failed, riesel_name  # noqa: E402
from states import read_state  # noqa: E402
from yade import Yade  # noqa: E402

RIESEL = os.path.abspath(os.environ["RIESEL"])
TUBE = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9, slip: spring, slip_stiffness: 600 N/m}
grains: {area_fraction: 0.45}
wall: {spacing: 1.25 mm}
tube: {width: 10 mm, length: 10 mm}
start: {axial_velocity: -3 m/s, random_velocity: 2 m/s}
run: {duration: 4.5 ms}
"""


@contextlib.contextmanager
def programs(name, says=""):
    """A program of this name that prints something, whatever it is asked, and what else the peers need."""
    with tempfile.TemporaryDirectory() as folder:
        for program in (name, "taskset", "mpirun"):
            path = pathlib.Path(folder) / program
            path.write_text(f"#!/bin/sh\ncat <<'END'\n{says}\nEND\n", encoding="utf-8")
            path.chmod(0o755)
        with unittest.mock.patch.dict(os.environ, {"PATH": f"{folder}:{os.environ['PATH']}"}):
            yield


def table(text, heading):
    """The rows of numbers under a heading of the data file."""
    after = text.split(heading + "\n\n")[1].split("\n\n")[0]
    return np.array([[float(number) for number in row.split()] for row in after.strip().splitlines()])


class OfAState(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        (folder / "tube.yaml").write_text(TUBE, encoding="utf-8")
        subprocess.run([RIESEL, "run", "tube.yaml", "--out", "run"], check=True, cwd=folder, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL)
        with h5py.File(folder / "run" / "run.h5") as file:
            final = file["final"]
            cls.truth = {name: final[name][:] for name in ("position", "velocity", "radius", "mass")}
        with h5py.File(folder / "run" / "checkpoint.h5") as file:
            cls.springs = file["contacts/spring"][:]
        cls.state = read_state(folder / "run" / "checkpoint.h5")
        write_data(cls.state, Lammps.density, folder / "tube.data")
        cls.text = (folder / "tube.data").read_text(encoding="ascii")
        cls.count = len(cls.truth["mass"])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_state_is_that_of_the_run_file(self):
        for name, truth in self.truth.items():
            np.testing.assert_allclose(getattr(self.state, name), truth, rtol=1e-12, atol=1e-15, err_msg=name)
        self.assertGreater(np.abs(self.truth["velocity"]).max(), 1.0)

    def test_acceleration_of_who_flies_is_gravity(self):
        flies = np.setdiff1d(np.arange(self.count), self.state.touching)
        self.assertGreater(len(flies), self.count // 2)
        np.testing.assert_allclose(self.state.acceleration[flies], np.tile([0.0, 10.0], (len(flies), 1)), rtol=1e-6)
        self.assertGreater(np.abs(self.state.acceleration).max(), 100.0)

    def test_bodies_that_touch(self):
        position = np.concatenate([self.state.position, self.state.wall_position])
        radius = np.concatenate([self.state.radius, self.state.wall_radius])
        first, second = self.state.touching.T
        apart = position[second] - position[first]
        apart[:, 1] -= self.state.length * np.rint(apart[:, 1] / self.state.length)
        overlap = radius[first] + radius[second] - np.hypot(*apart.T)
        self.assertTrue((overlap > 0.0).all() and (overlap < 0.05e-3).all(), overlap)
        of_walls = np.count_nonzero(second >= self.count)
        self.assertTrue(0 < of_walls < len(second))
        np.testing.assert_array_equal(self.state.spring, self.springs)
        self.assertTrue((self.state.spring < 0.0).any() and (self.state.spring > 0.0).any())

    def test_liggghts_makes_discs_of_the_density(self):
        path = pathlib.Path(self.folder.name) / "discs.data"
        write_data(self.state, Liggghts.density, path)
        atoms = table(path.read_text(encoding="ascii"), "Atoms # sphere")[:self.count]
        np.testing.assert_allclose(np.pi / 4.0 * atoms[:, 2]**2 * atoms[:, 3], self.truth["mass"], rtol=1e-14)

    def test_what_yade_is_told(self):
        path = pathlib.Path(self.folder.name) / "tube"
        law = {"time_step": 1e-6, "gravity": 10.0, "k_n": 2000.0, "k_t": 600.0, "gamma_n": 3e3, "mu": 0.5}
        with programs("yade"):
            Yade().write({"grains_state": self.state, "files": {"yade": str(path)}, "gamma_t": None} | law)
        with np.load(path) as told:
            self.assertEqual({name: float(told[name]) for name in law}, law)
            for name, truth in self.state._asdict().items():
                np.testing.assert_array_equal(told[name], truth, err_msg=name)
            np.testing.assert_allclose(told["velocity"] - told["half_step_velocity"], 0.5e-6 * self.state.acceleration,
                                       atol=1e-14)

    def test_free_atoms(self):
        atoms, velocities = table(self.text, "Atoms # sphere"), table(self.text, "Velocities")
        free = atoms[:, 1] == 1
        self.assertEqual(free.sum(), self.count)
        np.testing.assert_array_equal(atoms[:, 0], np.arange(1, len(atoms) + 1))
        diameter, density = atoms[free, 2], atoms[free, 3]
        np.testing.assert_allclose(diameter, 2.0 * self.truth["radius"], rtol=1e-15)
        np.testing.assert_allclose(np.pi / 6.0 * diameter**3 * density, self.truth["mass"], rtol=1e-14)
        np.testing.assert_allclose(atoms[free, 4:6], self.truth["position"], rtol=1e-12)
        np.testing.assert_allclose(velocities[free, 1:3], self.truth["velocity"], rtol=1e-12)
        self.assertFalse(velocities[~free, 1:].any())

    def test_wall_atoms(self):
        atoms = table(self.text, "Atoms # sphere")
        walls = atoms[atoms[:, 1] == 2]
        places = {(round(x * 1e3, 9), round(y * 1e3, 9)) for x, y in walls[:, 4:6]}
        self.assertEqual(places, {(x, y) for x in (0.0, 10.0) for y in np.arange(8) * 1.25})
        np.testing.assert_allclose(walls[:, 2], 0.66e-3)
        self.assertEqual(len(walls), 16)


ANSWER = """\
Step c_vx c_vy c_kinetic c_contacts
       0  0.001 0.99 0.00102 150
      20  0.002 0.98 0.00101 152
Loop time of 9.5 on 1 procs for 20 steps with 1565 atoms
Neighbor list builds = 1
Dangerous builds = 1
Step c_vx c_vy c_kinetic c_contacts
      20  0.002 0.98 0.00101 152
     220 -3e-05 0.97 0.00100 158
Loop time of 0.25 on 1 procs for 200 steps with 1565 atoms
Neighbor list builds = 4
Dangerous builds = 2
"""


class Answers(unittest.TestCase):

    def test_the_last_run_of_lammps_counts_but_all_dangers(self):
        answer = read_answer(ANSWER)
        self.assertEqual(answer["seconds"], 0.25)
        self.assertEqual(answer["too_late"], 3)
        self.assertEqual(answer["state"], {"mean_vx": -3e-05, "mean_vy": 0.97, "kinetic_energy": 0.001,
                                           "contacts_of_grains": 158})

    def test_lammps_that_tells_no_numbers(self):
        with self.assertRaisesRegex(RuntimeError, "that are numbers"):
            read_answer(re.sub(r"(?m)^( *\d+ +)\S+", r"\1nan", ANSWER))

    def test_yade_that_fails_with_status_0(self):
        with programs("yade", says="NameError: name 'O' is not defined"):
            with self.assertRaisesRegex(RuntimeError, "name 'O' is not defined"):
                Yade().advance({"files": {"yade": "state"}}, Yade.usual, cores=1, warm_up=0, steps=1)

    def test_versions(self):
        with programs("lmp", says="Large-scale Atomic/Molecular Massively Parallel Simulator - 1 Apr 2025"):
            self.assertTrue(Lammps().version.startswith("1 Apr 2025"))
            # Named by the environment, from where one is.
            there = os.path.relpath(shutil.which("lmp"))
            with unittest.mock.patch.dict(os.environ, {"LMP": there}):
                self.assertTrue(Lammps().version.startswith("1 Apr 2025"))
        with programs("liggghts", says="LIGGGHTS (Version LIGGGHTS-PUBLIC 3.9.0, compiled)"):
            self.assertTrue(Liggghts().version.startswith("3.9.0"))
        with programs("yade", says="Yade version: 2025.01"):
            self.assertTrue(Yade().version.startswith("2025.01"))


class Steady:
    """A peer whose speed depends on its settings, and that looks too late with a small skin."""
    name, usual, choices = "steady", {"skin": 2.0, "every": 5}, {"skin": (1.0, 2.0, 3.0), "every": (1, 5, 10)}

    @staticmethod
    def advance(start, settings, cores, warm_up, steps):
        seconds = settings["skin"] * (1.0 + abs(settings["every"] - 10))
        return {"seconds": seconds, "too_late": int(settings["skin"] < 2.0)}


class Tuning(unittest.TestCase):

    def test_the_fastest_that_is_safe(self):
        with contextlib.redirect_stdout(io.StringIO()):
            best, speed = run.tuned(Steady, {"grains": 10}, steps=100)
        self.assertEqual(best, {"skin": 2.0, "every": 10})
        self.assertEqual(speed, 10 * 100 / 2.0)
        self.assertEqual(Steady.usual, {"skin": 2.0, "every": 5})

    def test_what_is_best_with_other_settings_is_found_in_the_second_round(self):
        class Frequent(Steady):
            usual, choices = {"skin": 3.0, "every": 5}, {"skin": (1.0, 3.0), "every": (1, 5)}
            took = {(3.0, 5): 2.0, (1.0, 5): 5.0, (3.0, 1): 1.5, (1.0, 1): 1.0}  # s

            @classmethod
            def advance(cls, start, settings, cores, warm_up, steps):
                return {"seconds": cls.took[settings["skin"], settings["every"]], "too_late": 0}

        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(run.tuned(Frequent, {"grains": 10}, steps=100), ({"skin": 1.0, "every": 1}, 1000.0))

    def test_a_peer_that_loses_grains_is_not_safe(self):
        class Losing(Steady):
            @classmethod
            def advance(cls, start, settings, cores, warm_up, steps):
                if settings["skin"] < 2.0:
                    raise Failed("Lost atoms")
                return Steady.advance(start, settings, cores, warm_up, steps)

        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(run.tuned(Losing, {"grains": 10}, steps=100), run.tuned(Steady, {"grains": 10}, steps=100))

    def test_looks_that_come_too_late_are_kept(self):
        row = run.row_of("tube", "1.4k", "lammps 1", 10, 100, [{"seconds": 1.0, "too_late": 2}, {"seconds": 3.0}])
        self.assertEqual(row["too_late"], [2, 0])
        self.assertEqual(row["seconds"]["median"], 2.0)

    def test_none_is_safe(self):
        class Hasty(Steady):
            usual, choices = {"skin": 1.0, "every": 5}, {"skin": (0.5, 1.0)}

        with self.assertRaisesRegex(RuntimeError, "no settings are safe for steady"):
            run.tuned(Hasty, {"grains": 10}, steps=100)


class Timing(unittest.TestCase):

    def test_in_turns_and_for_as_many_grains(self):
        calls = []

        def contender(name, per_grain):
            def advance(start, warm_up, steps):
                calls.append((name, start["seed"], warm_up, steps))
                return {"seconds": per_grain * start["grains"] * steps}
            return run.Contender(advance, 100 if name == "slow" else 1000)

        contenders = {"fast": contender("fast", 1e-3), "slow": contender("slow", 1e-2)}
        starts = [{"grains": 10, "seed": 1}, {"grains": 20, "seed": 2}]
        answers = run.timed(contenders, starts)
        self.assertEqual(calls, [("fast", 1, 100, 1000), ("slow", 1, 20, 100), ("fast", 2, 100, 1000), ("slow", 2, 20, 100)])
        np.testing.assert_allclose([answer["seconds"] for answer in answers["fast"]], [10.0, 10.0])
        rows = {name: run.row_of("tube", "1.4k", name, 10, contenders[name].steps, answers[name]) for name in contenders}
        self.assertAlmostEqual(run.paired_ratio(rows["fast"], rows["slow"]).value, 10.0)

    def test_each_peer_is_compared_on_as_many_cores(self):
        rows = {riesel_name(variant, "spring"): run.row_of("tube", "1.4k", "", 10, 1, [{"seconds": 1.0}])
                for variant in run.RIESEL}
        rows |= {f"steady {cores}": run.row_of("tube", "1.4k", "", 10, 1, [{"seconds": 2.0 * cores}]) for cores in run.CORES}
        ratios = {(ratio["over"], ratio["under"]): ratio["value"] for ratio in run.ratios_of(rows, [Steady], "spring")}
        self.assertEqual(ratios["riesel windows 1, spring", "steady 1"], 2.0)
        self.assertEqual(ratios["riesel plain 2 apart, spring", "steady 2"], 4.0)
        self.assertEqual(len(ratios), len(run.RIESEL))


class Table(unittest.TestCase):

    def test_each_code_beside_riesel_with_its_law(self):
        viscous = {"lammps 1": 50e6, "riesel plain 1": 400e6, "riesel windows 1": 600e6}  # particle-steps/s
        spring = {"yade 1": 4e6, "riesel plain 1, spring": 300e6, "riesel windows 1, spring": 360e6, "yade 2": 1.0}
        def rows(speeds):
            return [run.row_of("tube_slow", "10k", name, 10_000, 100, [{"seconds": 1e6 / speed}])
                    for name, speed in speeds.items()]

        cases = [{"case": "tube_slow", "size": "10k", "law": law, "grains": 10_000, "rows": rows(speeds)}
                 for law, speeds in (("viscous", viscous), ("spring", spring))]
        lines = peers_table.table(cases, cores=1).splitlines()
        self.assertEqual(lines[2:], ["| slow tube | 10,000 | 50 | 8.0 | 12.0 |  |  |  | 4.0 | 75 | 90 |"])


if __name__ == "__main__":
    unittest.main()
