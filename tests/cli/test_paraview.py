"""ParaView shows what the run did: ./setup.sh look."""

import json
import pathlib
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from riesel_command import SMALL_TUBE, CommandTest

PROGRAM = shutil.which("pvpython")
PROBE = pathlib.Path(__file__).with_name("paraview_probe.py")


@unittest.skipIf(PROGRAM is None, "there is no ParaView")
class ParaView(CommandTest):

    def shown(self, *options):
        """What ParaView finds in the frames of a run, and the run's directory."""
        self.write("tube.yaml", SMALL_TUBE + "output: {trajectory_interval: 1 ms}\n")
        out = self.run_to_end("tube.yaml", "out", *options)
        shown = subprocess.run([PROGRAM, "--force-offscreen-rendering", PROBE, out / "trajectory.xdmf2"],
                               capture_output=True, text=True, timeout=200, check=True)
        found = json.loads(shown.stdout.splitlines()[-1])
        self.assertEqual(len(found["frames"]), 6)
        return found, out

    def test_grains_and_walls_at_all_times(self):
        found, out = self.shown()
        with h5py.File(out / "trajectory.h5", "r") as file:
            grains, walls = file["particles/grains"], file["particles/walls"]
            np.testing.assert_allclose(found["times"], grains["position/time"][:], rtol=1e-12)
            for i, frame in enumerate(found["frames"]):
                for name, path in {"position": "position/value", "velocity": "velocity/value"}.items():
                    np.testing.assert_array_equal(np.float32(frame["grains"][name]), grains[path][i])
                np.testing.assert_array_equal(frame["grains"]["radius"], grains["radius"][:])
                np.testing.assert_array_equal(np.float32(frame["walls"]["position"]), walls["position"][:])
                np.testing.assert_array_equal(frame["walls"]["radius"], walls["radius"][:])

    def test_walls_that_move_and_grains_that_rotate(self):
        found, out = self.shown("--set", "grains.rotation=disc", "--set", "wall.shake_amplitude=0.5 mm", "--set",
                                "wall.shake_frequency=300")
        with h5py.File(out / "trajectory.h5", "r") as file:
            grains, walls = file["particles/grains"], file["particles/walls"]
            for i, frame in enumerate(found["frames"]):
                np.testing.assert_array_equal(np.float32(frame["walls"]["position"]), walls["position/value"][i])
                np.testing.assert_array_equal(np.float32(frame["grains"]["spin"]), grains["spin/value"][i])

    def test_smooth_walls_have_no_grains(self):
        found, out = self.shown("--set", "wall.surface=smooth")
        with h5py.File(out / "trajectory.h5", "r") as file:
            for i, frame in enumerate(found["frames"]):
                self.assertEqual(sorted(frame), ["grains"])
                np.testing.assert_array_equal(np.float32(frame["grains"]["position"]),
                                              file["particles/grains/position/value"][i])
