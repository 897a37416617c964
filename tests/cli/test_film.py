"""docs/animate.py makes a film of a run: ./setup.sh look."""

import pathlib
import shutil
import subprocess
import unittest

from riesel_command import SMALL_TUBE, CommandTest

ANIMATE = pathlib.Path(__file__).resolve().parents[2] / "docs/animate.py"


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
