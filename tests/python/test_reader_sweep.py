"""The Python package reads sweeps, and means over their seeds."""

import csv
import json
import os
import shutil
import statistics

import numpy as np
import riesel

from riesel_command import FAILED, SMALL_TUBE, CommandTest
from seal import changed_behind_seal

SWEEP = """\
base: tube.yaml
set: {run.duration: 3 ms}
axes: {contact.restitution: [0.7, 0.9], contact.law: [linear]}
branches: {slow: {start.axial_velocity: 1 m/s}, fast: {start.axial_velocity: 3 m/s}}
"""


class OfSweep(CommandTest):

    def test_mean_profiles_over_seeds(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP.replace("3 ms", "20 ms") + "seeds: 3\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        sweep = riesel.Sweep(self.home / "out")
        fast = sweep.mean_profiles()[3]
        self.assertNotEqual(fast, sweep.mean_profiles()[3])
        self.assertEqual((fast.settings["contact.restitution"], fast.branch, fast.runs, fast.steady), (0.9, "fast", 3, 0))
        tables = [point.run.profiles for point in sweep.points
                  if (point.settings["contact.restitution"], point.branch) == (0.9, "fast")]
        self.assertEqual(set(fast.profiles), set(tables[0]))
        np.testing.assert_array_equal(fast.profiles["x"], tables[0]["x"])
        for name in ("area_fraction", "stress_yy"):
            values = np.array([table[name] for table in tables])
            np.testing.assert_allclose(fast.profiles[name], values.mean(axis=0), rtol=1e-12)
            np.testing.assert_allclose(fast.profiles[f"{name}_error"], 1.321 * values.std(axis=0, ddof=1) / 3 ** 0.5, rtol=1e-3)
        self.assertEqual(fast.profiles.label("stress_yy"), "stress_yy (N/m)")
        # One run less, one that is steady and has a strip without grains, and then one that has other strips.
        points = self.home / "out/points"
        (points / sweep.points[0].name / "summary.json").unlink()
        last = points / sweep.points[-1].name
        summary = json.loads((last / "summary.json").read_text(encoding="utf-8"))
        summary["validity"]["verdict"] = "valid"
        (last / "summary.json").write_text(json.dumps(summary | {"state": "steady"}), encoding="utf-8")
        with changed_behind_seal(last / "run.h5") as file:
            file["profiles/temperature_x"][0] = np.nan
        means = riesel.Sweep(self.home / "out").mean_profiles()
        self.assertEqual([(mean.runs, mean.steady) for mean in means], [(2, 0), (3, 0), (3, 0), (3, 1)])
        verdicts = [table["validity.verdict"] for table in (point.run.summary for point in sweep.points[-3:])]
        self.assertEqual(means[3].valid, verdicts[:2].count("valid") + 1)
        others = [table["temperature_x"][0] for table in tables[:-1]]
        self.assertAlmostEqual(means[3].profiles["temperature_x"][0], statistics.mean(others), places=12)
        with changed_behind_seal(last / "run.h5") as file:
            file["profiles/x"][:] *= 2.0
        with self.assertRaisesRegex(ValueError, "its strips differ from those of") as told:
            riesel.Sweep(self.home / "out").mean_profiles()
        self.assertIs(type(told.exception), ValueError)  # nothing is missing or damaged

    def test_mean_profiles_of_what_has_not_begun(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP + "seeds: 3\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        planned = riesel.Sweep(self.home / "out").mean_profiles()
        self.assertEqual([(mean.runs, len(mean.profiles)) for mean in planned], [(0, 0)] * 4)

    def test_means_over_seeds(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP + "seeds: 3\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        sweep = riesel.Sweep(self.home / "out")
        column = "mean_axial_velocity.value"
        means = sweep.means(column)
        self.assertEqual([(mean.settings["contact.restitution"], mean.branch) for mean in means],
                         [(0.7, "slow"), (0.7, "fast"), (0.9, "slow"), (0.9, "fast")])
        for mean, group in zip(means, sweep.groups(), strict=True):
            self.assertEqual([point.settings["seed"] for point in group], [1, 2, 3])
            self.assertEqual({(point.settings["contact.restitution"], point.branch) for point in group},
                             {(mean.settings["contact.restitution"], mean.branch)})
            values = [point.run.summary[column] for point in sweep.points
                      if (point.settings["contact.restitution"], point.branch)
                      == (mean.settings["contact.restitution"], mean.branch)]
            self.assertNotIn("seed", mean.settings)
            valid = [point for point in sweep.points if point.settings["contact.restitution"] == mean.settings[
                "contact.restitution"] and point.branch == mean.branch and point.run.validity.verdict == "valid"]
            self.assertEqual((mean.runs, mean.steady, mean.valid), (3, 0, len(valid)))
            self.assertIn(f"(3 runs, 0 steady, {len(valid)} valid)", str(mean))
            self.assertAlmostEqual(mean.value, statistics.mean(values), places=12)
            self.assertAlmostEqual(mean.error, 1.321 * statistics.stdev(values) / 3 ** 0.5, delta=0.001 * mean.error)
        (single,) = {mean.runs for mean in sweep.means(column, over="contact.restitution")}
        self.assertEqual(single, 2)
        (self.home / "out/points" / sweep.points[0].name / "summary.json").unlink()
        self.assert_done(self.riesel("collect", "out"))
        self.assertEqual([mean.runs for mean in riesel.Sweep(self.home / "out").means(column)], [2, 3, 3, 3])
        for wrong in ((column, "gravity"), ("no.such", "seed"), ("state", "seed")):
            with self.assertRaises(riesel.NotThere):
                sweep.means(*wrong)
        # A point more in the plan, and the table of before.
        before = sweep.means(column)
        self.write("sweep.yaml", (SWEEP + "seeds: 3\n").replace("[0.7, 0.9]", "[0.6, 0.7, 0.9]"))
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        with self.assertRaisesRegex(riesel.NotThere, "riesel collect"):
            riesel.Sweep(self.home / "out").means(column)
        self.assert_done(self.riesel("collect", "out"))
        after = riesel.Sweep(self.home / "out").means(column)
        self.assertEqual([mean.runs for mean in after], [0, 0, 2, 3, 3, 3])
        self.assertEqual([mean.value for mean in after[3:]], [mean.value for mean in before[1:]])

    def test_the_table_of_a_sweep_with_a_name_that_is_no_text(self):
        """Its name is in the reason why the summary of a point was not taken."""
        out = self.home / os.fsdecode(b"sw\xe9p")
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", out))
        next((out / "points").glob("*/summary.json")).write_text("{", encoding="utf-8")
        self.assertEqual(self.riesel("collect", out).returncode, FAILED)
        self.assertIn("sw?p", " ".join(riesel.Sweep(out).table["reason"]))

    def test_points_and_table(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", SWEEP)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--prepare", "--out", "out"))
        planned = riesel.Sweep(self.home / "out")
        self.assertEqual([point.status for point in planned.points], ["waiting"] * 4)
        self.assertFalse(planned.points[0].is_done)
        with self.assertRaisesRegex(riesel.NotThere, "riesel collect"):
            planned.table

        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out"))
        sweep = riesel.Sweep(self.home / "out")
        self.assertEqual([point.status for point in sweep.points], ["done"] * 4)
        self.assertEqual([point.is_done for point in sweep.points], [True] * 4)
        self.assertEqual([point.branch for point in sweep.points], ["slow", "fast"] * 2)
        self.assertEqual([point.settings["contact.restitution"] for point in sweep.points],
                         [0.7, 0.7, 0.9, 0.9])
        self.assertEqual(sweep.varied["start.axial_velocity"], "m/s")
        self.assertEqual([point.run.estimate("mean_axial_velocity").value for point in sweep.points],
                         sweep.table["mean_axial_velocity.value"].tolist())
        with open(self.home / "out/sweep.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(sorted(sweep.table), sorted(rows[0]))
        self.assertEqual(sweep.table["state_hash"].tolist(), [row["state_hash"] for row in rows])
        self.assertEqual(sweep.table["energy.residual"].tolist(),
                         [float(row["energy.residual"]) for row in rows])
        shutil.rmtree(sweep.points[1].directory)
        self.assertEqual([point.is_done for point in sweep.points], [True, False, True, True])
        with self.assertRaisesRegex(riesel.NotThere, "is not a directory"):
            sweep.points[1].run
