"""The LAMMPS data file against what riesel itself writes of the same state in SI units; and what is read from LAMMPS's
answer. LAMMPS itself is not needed."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))
from lammps import read_answer  # noqa: E402
from lammps_data import read_state, write_lammps_data  # noqa: E402

RIESEL = os.path.abspath(os.environ["RIESEL"])
TUBE = """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
grains: {area_fraction: 0.3}
wall: {spacing: 1.25 mm}
tube: {width: 10 mm, length: 10 mm}
start: {axial_velocity: -3 m/s, random_velocity: 2 m/s}
run: {duration: 5 ms}
"""


def table(text, heading):
    """The rows of numbers under a heading of the data file."""
    after = text.split(heading + "\n\n")[1].split("\n\n")[0]
    return np.array([[float(number) for number in row.split()] for row in after.strip().splitlines()])


class LammpsData(unittest.TestCase):

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
        cls.state = read_state(folder / "run" / "checkpoint.h5")
        write_lammps_data(cls.state, folder / "tube.data")
        cls.text = (folder / "tube.data").read_text(encoding="ascii")
        cls.count = len(cls.truth["mass"])

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_state_is_that_of_the_run_file(self):
        for name, truth in self.truth.items():
            np.testing.assert_allclose(getattr(self.state, name), truth, rtol=1e-12, atol=1e-15, err_msg=name)
        self.assertGreater(np.abs(self.truth["velocity"]).max(), 1.0)

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


class LammpsAnswer(unittest.TestCase):

    def test_the_last_run_counts_but_all_dangers(self):
        answer = read_answer(ANSWER, grains=1000, steps=200)
        self.assertEqual(answer["seconds"], 0.25)
        self.assertEqual(answer["particle_steps_per_second"], 800_000)
        self.assertEqual(answer["dangerous_builds"], 3)
        self.assertEqual(answer["state"], {"mean_vx": -3e-05, "mean_vy": 0.97, "kinetic_energy": 0.001,
                                           "contacts_of_grains": 158})


if __name__ == "__main__":
    unittest.main()
