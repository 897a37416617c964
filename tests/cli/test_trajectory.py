"""Trajectories: what h5py and netCDF find in them is what the run did, and a run that was stopped leaves
the same frames as one that was not."""

import re
import time
import unittest

import h5py
import numpy as np

from riesel_command import SMALL_TUBE, CommandTest, bytes_of_files

try:
    import netCDF4
except ImportError:
    netCDF4 = None

FRAMES = "output: {trajectory_interval: 0.2 ms, checkpoint_interval: 0.02 s}\n"
TUBE = SMALL_TUBE + FRAMES
GRAINS = "particles/grains"


def arrays_of(run_directory):
    """{name: (type, shape, bytes)} of all data sets of the trajectory."""
    arrays = {}
    with h5py.File(run_directory / "trajectory.h5", "r") as file:
        file.visititems(lambda name, item: arrays.update(
            {name: (str(item.dtype), item.shape, item[()].tobytes())}
            if isinstance(item, h5py.Dataset) else {}))
    return arrays


class TrajectoryTest(CommandTest):

    def run_tube(self, out, *options, threads=1):
        return self.run_to_end(self.write("tube.yaml", TUBE), out, *options, threads=threads)

    def assert_same_trajectory(self, one, other):
        first, second = arrays_of(one), arrays_of(other)
        self.assertEqual(sorted(first), sorted(second))
        for name, array in first.items():
            self.assertEqual(array, second[name], name)
        self.assertEqual((one / "trajectory.xdmf2").read_bytes(),
                         (other / "trajectory.xdmf2").read_bytes())


class Contents(TrajectoryTest):
    """Of a run with a frame at each step."""

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        cls.out = maker.run_tube("out", "--set", "output.trajectory_interval=1 ns", "--set",
                                 "run.duration=0.5 ms")
        cls.file = h5py.File(cls.out / "trajectory.h5", "r")
        cls.addClassCleanup(cls.file.close)
        cls.run_file = h5py.File(cls.out / "run.h5", "r")
        cls.addClassCleanup(cls.run_file.close)

    def test_times_and_steps(self):
        steps = int(self.run_file["final"].attrs["step"])
        for element in ("position", "velocity"):
            group = self.file[f"{GRAINS}/{element}"]
            self.assertEqual(group["step"][:].tolist(), list(range(steps + 1)))
            np.testing.assert_allclose(group["time"][:],
                                       np.arange(steps + 1) * self.run_file["final"].attrs["time_step"])

    def test_the_last_frame_is_the_final_state_in_the_order_of_the_ids(self):
        grains, final = self.file[GRAINS], self.run_file["final"]
        length = final.attrs["box_length"]
        for element, scale in (("position", length), ("velocity", 1.0)):
            last = grains[f"{element}/value"][-1]
            self.assertEqual(last.shape, (len(final["id"]), 3))
            self.assertLess(abs(last[:, :2] - final[element][:]).max(), 2e-7 * scale)
            self.assertTrue((last[:, 2] == 0).all())
        for name in ("radius", "mass", "id"):
            self.assertTrue((grains[name][:] == final[name][:]).all(), name)

    def test_velocities_are_the_ways_from_frame_to_frame(self):
        position, velocity = (self.file[f"{GRAINS}/{name}/value"][:, :, :2].astype(float)
                              for name in ("position", "velocity"))
        dt, length = self.run_file["final"].attrs["time_step"], self.run_file["final"].attrs["box_length"]
        way = (position[20:] - position[:-20])
        way[:, :, 1] -= length * np.round(way[:, :, 1] / length)
        mean = np.array([velocity[i:len(velocity) - 20 + i] for i in range(21)])
        mean = (mean.sum(axis=0) - 0.5 * (mean[0] + mean[-1])) / 20
        self.assertLess(abs(way / (20 * dt) - mean).max(), 0.01)

    def test_the_index_has_the_times_of_the_frames(self):
        text = (self.out / "trajectory.xdmf2").read_text(encoding="utf-8")
        times = [float(time) for time in re.findall(r'<Time Value="([^"]+)"', text)]
        np.testing.assert_allclose(times, self.file[f"{GRAINS}/position/time"][:], rtol=1e-6, atol=1e-12)

    def test_positions_are_in_the_box(self):
        y = self.file[f"{GRAINS}/position/value"][:, :, 1]
        edges = self.file[f"{GRAINS}/box/edges"][:]
        self.assertTrue((y >= 0).all() and (y < np.float32(edges[1])).all())
        self.assertEqual(list(edges[:2]), [0.01, 0.01])

    def test_walls_are_a_group_of_their_own(self):
        walls, described = self.file["particles/walls"], self.run_file["final/walls"]
        position, radius = walls["position"][:], walls["radius"][:]
        self.assertEqual(len(position), sum(described["count"][:]))
        expected = [(line, k * 0.01 / count, r) for line, count, r in zip(
            described["line"][:], described["count"][:], described["radius"][:]) for k in range(count)]
        np.testing.assert_allclose(np.column_stack([position[:, :2], radius]), expected, atol=1e-9)

    def test_it_is_h5md(self):
        self.assertEqual(self.file["h5md"].attrs["version"].tolist(), [1, 1])
        self.assertEqual(self.file["h5md/creator"].attrs["name"], b"riesel")
        box = self.file[f"{GRAINS}/box"].attrs
        self.assertEqual((box["dimension"], list(box["boundary"])), (3, [b"none", b"periodic", b"none"]))
        units = [self.file[f"{GRAINS}/{name}"].attrs["unit"] for name in ("position/value", "velocity/value")]
        self.assertEqual(units, [b"m", b"m s-1"])
        self.assertIn(b"periodic_tube", self.file["parameters"].attrs["settings"])

    @unittest.skipIf(netCDF4 is None, "there is no python3-netcdf4")
    def test_netcdf_reads_amber(self):
        grains = self.file[GRAINS]
        with netCDF4.Dataset(self.out / "trajectory.h5") as amber:
            self.assertEqual((amber.Conventions, amber.ConventionVersion), ("AMBER", "1.0"))
            sizes = {name: len(dimension) for name, dimension in amber.dimensions.items()}
            frames = len(grains["position/step"])
            self.assertEqual({name: sizes[name] for name in ("frame", "atom", "spatial")},
                             {"frame": frames, "atom": len(grains["id"]), "spatial": 3})
            self.assertEqual(amber["coordinates"].dimensions, ("frame", "atom", "spatial"))
            self.assertEqual(b"".join(amber["spatial"][:]), b"xyz")
            for name, path in {"coordinates": "position/value", "velocities": "velocity/value",
                               "time": "position/time", "radius": "radius", "mass": "mass"}.items():
                self.assertTrue((amber[name][:] == grains[path][:]).all(), name)
            self.assertTrue((amber["cell_lengths"][:] == np.float32([0, 0.01, 0])).all())
            self.assertTrue((amber["cell_angles"][:] == 90).all())


class WallsThatMove(TrajectoryTest):
    """And grains that rotate: both are in each frame then."""

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        settings = ("output.trajectory_interval=1 ns", "run.duration=0.5 ms", "grains.rotation=disc",
                    "wall.shake_amplitude=0.5 mm", "wall.shake_frequency=3000", "wall.shake_angle=30 degrees")
        cls.out = maker.run_tube("out", *(word for setting in settings for word in ("--set", setting)))
        cls.file = h5py.File(cls.out / "trajectory.h5", "r")
        cls.addClassCleanup(cls.file.close)
        cls.run_file = h5py.File(cls.out / "run.h5", "r")
        cls.addClassCleanup(cls.run_file.close)

    def test_each_frame_has_the_walls_where_they_are(self):
        walls, described = self.file["particles/walls/position"], self.run_file["final/walls"]
        length = self.run_file["final"].attrs["box_length"]
        at_first = [(line, k * length / count) for line, count in zip(
            described["line"][:], described["count"][:]) for k in range(count)]
        for time, places in zip(walls["time"][:], walls["value"][:]):
            swing = 0.5e-3 * np.sin(2 * np.pi * 3000 * time)
            expected = at_first + swing * np.array([0.5, np.sqrt(0.75)])
            off = places[:, :2] - expected
            off[:, 1] -= length * np.round(off[:, 1] / length)
            self.assertLess(abs(off).max(), 1e-8)
        self.assertTrue((walls["value"][:, :, 1] >= 0).all() and (walls["value"][:, :, 1] < length).all())

    def test_each_frame_has_the_spins(self):
        spin = self.file[f"{GRAINS}/spin"]
        self.assertEqual(spin["value"].attrs["unit"], b"rad s-1")
        self.assertEqual(spin["step"][:].tolist(), self.file[f"{GRAINS}/position/step"][:].tolist())
        np.testing.assert_allclose(spin["value"][-1], self.run_file["final/spin"][:], rtol=1e-6)
        self.assertGreater(abs(spin["value"][-1]).max(), 1)


class WithoutWallGrains(TrajectoryTest):

    def test_smooth_walls_that_move_leave_a_file_that_is_read(self):
        out = self.run_tube("out", "--set", "wall.surface=smooth", "--set", "wall.shake_amplitude=0.5 mm",
                            "--set", "wall.shake_frequency=300")
        with h5py.File(out / "trajectory.h5", "r") as file:
            self.assertEqual(file["particles/walls/position"].shape, (0, 3))
            self.assertGreater(len(file[f"{GRAINS}/position/value"]), 2)
        if netCDF4 is not None:
            with netCDF4.Dataset(out / "trajectory.h5") as amber:
                self.assertGreater(len(amber["time"]), 2)


class Trajectory(TrajectoryTest):

    def test_it_does_not_change_the_run(self):
        self.assert_same_result(self.run_small_tube("without"), self.run_tube("with"))
        self.assertFalse((self.home / "without" / "trajectory.h5").exists())

    def test_the_same_frames_with_any_number_of_threads_and_stepping(self):
        arrays = []
        for stepping in ("plain", "windows"):
            setting = ["--set", f"run.stepping={stepping}"]
            one = self.run_tube(f"{stepping}-1", *setting)
            self.assert_same_trajectory(one, self.run_tube(f"{stepping}-2", *setting, threads=2))
            arrays.append(arrays_of(one))
        self.assertEqual(*arrays)

    def test_a_run_that_was_resumed_has_the_frames_of_one_that_was_not(self):
        whole = self.run_tube("whole")
        part = self.run_tube("part", "--set", "run.duration=1.1 ms")
        for duration in ("2.3 ms", "5 ms"):
            self.resume_to_end(part, "--set", f"run.duration={duration}")
        self.assert_same_trajectory(whole, part)

    def test_a_run_that_was_killed_shows_its_frames_and_goes_on(self):
        self.write("long.yaml", TUBE.replace("5 ms", "1000 s"))
        process = self.start("run", "long.yaml", "--out", "out", "--threads", 1)
        out = self.home / "out"
        self.wait_until((out / "checkpoint.h5.previous").exists, "the second checkpoint")
        time.sleep(0.2)
        process.kill()
        process.communicate()
        with h5py.File(out / "trajectory.h5", "r") as file, \
                h5py.File(out / "checkpoint.h5", "r") as checkpoint:
            times = file[f"{GRAINS}/position/time"][:]
            self.assertGreater(len(times), 1)
            reached = checkpoint.attrs["step"] * checkpoint.attrs["time_step"]
            self.assertGreater(times[-1], reached - 0.21e-3)  # each frame that the checkpoint counts
            end = times[-1] + 20e-3
        self.resume_to_end(out, "--set", f"run.duration={end!r}")
        whole = self.run_to_end("long.yaml", "whole", "--set", f"run.duration={end!r}")
        self.assert_same_trajectory(whole, out)

    def test_what_a_resumed_run_cannot_go_on_with_is_refused(self):
        out = self.run_tube("out", "--set", "run.duration=1 ms")
        longer = ["--set", "run.duration=2 ms"]
        for interval in ("1 ms", ""):
            result = self.riesel("resume", out, *longer, "--set", f"output.trajectory_interval={interval}")
            self.assert_refused(result, "output.trajectory_interval: cannot change", "start a new run")
        file = out / "trajectory.h5"
        whole = file.read_bytes()
        for content in (b"", whole[:300], whole[:100] + b"x" + whole[101:]):
            file.write_bytes(content)
            self.assert_refused(self.riesel("resume", out, *longer), "out/trajectory.h5",
                                "does not fit the checkpoint", "restore the file")
        file.unlink()
        self.assert_refused(self.riesel("resume", out, *longer), "out/trajectory.h5", "is missing", "restore")
        file.write_bytes(whole)
        self.resume_to_end(out, *longer)

    def test_a_trajectory_of_somebody_else_is_not_written_over(self):
        self.write("tube.yaml", TUBE)
        (self.home / "out").mkdir()
        (self.home / "out/trajectory.h5").write_bytes(b"mine")
        self.assert_refused(self.riesel("run", "tube.yaml", "--out", "out"), "out: ", "a run already")
        self.assertEqual(bytes_of_files(self.home / "out"), {"trajectory.h5": b"mine"})

    def test_its_size_is_told_before(self):
        tube = self.write("tube.yaml", TUBE)
        for duration in ("7 ms", "11.9 ms"):
            with self.subTest(duration):
                options = ["--set", f"run.duration={duration}"]
                told = self.riesel("check", tube, *options).stdout
                out = self.run_to_end(tube, duration.replace(" ", ""), *options)
                with h5py.File(out / "trajectory.h5") as file:
                    written = len(file["particles/grains/position/value"])
                self.assertRegex(told, rf"\n  trajectory +{written} frames, 0.\d MB, and 0.\d MB in trajectory.xdmf2\n")

    def test_its_size_is_told_nearly(self):
        """Without what the file takes to find its frames, and the room for the rest of the last block."""
        tube = self.write("tube.yaml", TUBE)
        often = ["--set", "output.trajectory_interval=10 us", "--set", "run.duration=12 ms"]
        for more in ((), ("--set", "grains.rotation=disc", "--set", "wall.shake_amplitude=0.1 mm", "--set",
                          "wall.shake_frequency=100")):
            with self.subTest(more):
                told = re.search(r"\n  trajectory +\d+ frames, (\S+) MB, and (\S+) MB in trajectory.xdmf2\n",
                                 self.riesel("check", tube, *often, *more).stdout)
                out = self.run_to_end(tube, f"out{len(more)}", *often, *more)
                for size, name in zip(told.groups(), ("trajectory.h5", "trajectory.xdmf2")):
                    written = (out / name).stat().st_size / 1e6
                    self.assertGreater(written, 1.0, name)
                    self.assertAlmostEqual(float(size) / written, 1.0, delta=0.15, msg=name)
