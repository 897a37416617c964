"""Frames of trajectories in the Python package."""

import math

import h5py
import numpy as np
import riesel

from riesel_command import CommandTest


class TrajectoryOfMore(CommandTest):
    """Of grains that rotate, between walls that are shaken across the tube."""

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        directory = maker.run_small_tube(
            "run", "--set", "output.trajectory_interval=1 ms", "--set", "grains.rotation=disc",
            "--set", "wall.shake_amplitude=0.1 mm", "--set", "wall.shake_frequency=100 Hz",
            "--set", "wall.shake_angle=90 degrees")
        cls.final = riesel.Run(directory).final
        cls.frames = riesel.Run(directory).trajectory
        cls.file = h5py.File(directory / "trajectory.h5", "r")
        cls.addClassCleanup(cls.file.close)

    def test_radii_and_masses(self):
        self.assertEqual(len(set(self.frames.radius)), len(self.frames.radius))
        np.testing.assert_array_equal(self.frames.mass, self.final.grains["mass"])
        # 1 mg of 1 mm, by area.
        np.testing.assert_allclose(self.frames.mass, 1e-6 * (self.frames.radius / 0.5e-3) ** 2,
                                   rtol=1e-12)
        np.testing.assert_array_equal(self.frames.wall_radius,
                                      np.full(sum(self.final.walls["count"]), 0.33e-3))

    def test_spins(self):
        written = self.file["particles/grains/spin/value"]
        for i, frame in enumerate(self.frames):
            np.testing.assert_array_equal(frame.spin, written[i])
        self.assertEqual(self.frames[0].spin.tolist(), [0.0] * len(self.frames.radius))
        self.assertTrue(np.any(self.frames[-1].spin))

    def test_walls_are_where_they_have_moved_to(self):
        self.assertTrue(self.frames.walls_move)
        left, right = self.final.walls["count"]
        at_rest = np.repeat([0.0, 0.01], [left, right])
        for frame in self.frames:
            swing = 1e-4 * math.sin(2.0 * math.pi * 100.0 * frame.time)
            np.testing.assert_allclose(frame.wall_position[:, 0], at_rest + swing, atol=2e-9)
            np.testing.assert_array_equal(frame.wall_position[:, 1],
                                          self.frames[0].wall_position[:, 1])


class GrowingTrajectory(CommandTest):

    def test_a_loop_over_frames_outlives_the_checkpoints_of_a_run_that_goes_on(self):
        directory = self.run_small_tube("run", "--set", "output.trajectory_interval=0.05 ms")
        frames = riesel.Run(directory).trajectory
        loop = iter(frames)
        next(loop)
        # Each ends with a checkpoint, and every other one is written over what was read.
        for duration in (10, 15, 20):
            self.resume_to_end(directory, "--set", f"run.duration={duration} ms")
        grown = riesel.Run(directory).trajectory
        self.assertGreater(len(grown), len(frames))
        rest = list(loop)
        self.assertEqual(len(rest), len(frames) - 1)
        for frame, same in zip(rest, grown[1:]):
            np.testing.assert_array_equal(frame.position, same.position)
