"""docs/animate.py makes a film of a run: ./setup.sh look."""

import math
import pathlib
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from riesel_command import SMALL_TUBE, CommandTest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
ANIMATE = DOCS / "animate.py"
sys.path.insert(0, str(DOCS))
from draw_tube import TubePicture, walls_of


class SmoothWalls(CommandTest):

    def test_they_are_drawn_where_they_are(self):
        """A trajectory does not have them: they are those of the run, moved by its clock."""
        self.write("tube.yaml", SMALL_TUBE + "wall: {surface: smooth, shake_amplitude: 0.1 mm, "
                                             "shake_frequency: 200 Hz, shake_angle: 90 degrees}\n")
        with h5py.File(self.run_to_end("tube.yaml", "out") / "run.h5") as file:
            walls = walls_of(file["final"])
        tube = TubePicture(0.01, 0.01, np.empty((0, 2)), np.empty(0), np.array([5e-4]), walls)
        for time in (0.0, 1e-3, 3.3e-3):
            tube.move_smooth_walls(time)
            swing = 1e-4 * math.sin(2 * math.pi * 200 * time)
            for wall, drawn, line in zip(walls, tube.figure.axes[0].lines, (0.0, 0.01), strict=True):
                self.assertAlmostEqual(wall.x(time), line + swing, delta=1e-9)
                np.testing.assert_allclose(drawn.get_ydata(), [(line + swing) * 1e3] * 2, atol=1e-6)


@unittest.skipIf(shutil.which("ffmpeg") is None, "there is no ffmpeg")
class Film(CommandTest):

    def test_it_has_a_picture_for_each_frame(self):
        self.write("tube.yaml", SMALL_TUBE + "output: {trajectory_interval: 0.5 ms}\n")
        out = self.run_to_end("tube.yaml", "out")
        subprocess.run(["/usr/bin/python3", "-B", ANIMATE, out, "film.mp4", "--fps", "5"],
                       cwd=self.home, timeout=200, check=True)
        probe = subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-show_entries",
             "stream=codec_name,nb_read_frames,r_frame_rate", "-of", "csv=p=0", "film.mp4"],
            cwd=self.home, capture_output=True, text=True, timeout=100, check=True)
        self.assertEqual(probe.stdout.strip(), "h264,5/1,11")
