"""A small tube from end to end."""

import re

import h5py
import numpy as np
import yaml

from riesel_command import FAILED, SHIPPED, SMALL_TUBE, CommandTest, data_of, series_of

OF_ALL_SCENARIOS = {"format", "scenario", "version", "commit", "grains", "steps", "state_hash", "performance"}


def manual(heading):
    """A section of the page on files."""
    page = (SHIPPED.parent / "docs/files.md").read_text(encoding="utf-8").replace("\\|", "|")
    return page.split(f"\n## {heading}\n")[1].split("\n## ")[0]


def rows_of(text):
    """The first two cells of the rows of a table."""
    return re.findall(r"^\| (`.+?) \| (.+) \|$", text, re.MULTILINE)


class Tube(CommandTest):

    @classmethod
    def setUpClass(cls):
        """One run for all that only look at it."""
        cls.out = cls.maker().run_small_tube("out")

    def test_the_directory_holds_the_files_of_a_run(self):
        names = {path.name for path in self.out.iterdir()}
        self.assertEqual(names - {".lock"},
                         {"effective.yaml", "run.h5", "checkpoint.h5", "checkpoint.h5.previous",
                          "summary.json"})

    def test_the_manual_lists_the_names_in_the_summary(self):
        summary = self.summary(self.out)
        listed = {}  # names, and those within them: {"balance": {"n_dot": None, "errors": {...}}}
        for names, meaning in rows_of(manual("summary.json").split("Flows (tube")[1]):
            for name in re.findall(r"`(.+?)`", names):
                listed |= yaml.safe_load(name) if ":" in name else {name: None}
            if names.startswith("`profiles"):
                quantities = set(re.findall(r"`(\w+)`", meaning)) - {"wall_layers"}
        self.assertEqual(set(listed) | OF_ALL_SCENARIOS, set(summary))
        for name, within in listed.items():
            if within is not None:
                self.assertEqual({str(each) for each in within}, set(summary[name]), name)
        self.assertEqual(set(listed["balance"]["errors"]), set(summary["balance"]["errors"]))
        for zone in listed["profiles"]:
            self.assertEqual(quantities, set(summary["profiles"][zone]), zone)
        self.assertEqual(set(summary["performance"]), {"wall_seconds", "particle_steps_per_second", "threads"})
        self.assertEqual(set(summary["validity"]["t_col"]), {"grains", "walls"})

    def test_the_manual_lists_profiles_histograms_and_columns_of_contacts(self):
        text, of_contacts = manual("run.h5").split("\n### Contacts of the final state\n")
        profiles = ["x"]
        for names, _ in rows_of(text):
            for name in re.findall(r"`(\w+)`", names):  # `stress_xx`, `_xy`
                profiles.append(profiles[-1][:-len(name)] + name if name.startswith("_") else name)
        with h5py.File(self.out / "run.h5", "r") as file:
            self.assertEqual({name.removesuffix("_error") for name in file["profiles"]}, set(profiles))
            self.assertEqual(set(file["histograms"]), set(re.findall(r"`(\w+)`", text.split("NAME is")[1])))
            contacts = [name for names, _ in rows_of(of_contacts) for name in re.findall(r"`(\w+)`", names)]
            self.assertEqual(sorted(file["final/contacts"]), sorted(contacts))

    def test_the_summary_has_finite_values(self):
        summary = self.summary(self.out)
        self.assert_finite(summary)
        self.assertIn(summary["state"], {"steady", "accelerating", "drifting", "too_short"})
        self.assertEqual(summary["balance"]["gravity"], 10.0)
        self.assertEqual(summary["performance"]["threads"], 1)

    def test_five_milliseconds_are_too_short_for_a_steady_mean(self):
        self.assertEqual(self.summary(self.out)["state"], "too_short")

    def test_the_manual_lists_the_series(self):
        page = (SHIPPED.parent / "docs/series.md").read_text(encoding="utf-8")
        listed = [tuple(row) for row in re.findall(r"^\| `(\w+)` \| ([^|]+) \| (.+) \|$", page.replace("\\|", "|"),
                                                   re.MULTILINE)]
        with h5py.File(self.out / "run.h5", "r") as file:
            there = [(name, column.attrs["unit"].decode(), column.attrs["doc"].decode())
                     for name, column in file["series"].items()]
        self.assertEqual(sorted(listed), sorted(there))

    def test_the_series_have_units_and_a_row_for_each_interval(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            for name, column in file["series"].items():
                self.assertEqual(column.shape, (6,), name)
                self.assertTrue(np.isfinite(column[()]).all(), name)
                self.assertTrue(column.attrs["unit"], name)
                self.assertTrue(column.attrs["doc"], name)
            units = {name: file["series"][name].attrs["unit"] for name in ("time", "mean_vy")}
            self.assertEqual(units, {"time": b"s", "mean_vy": b"m/s"})
            np.testing.assert_allclose(file["series/time"], np.arange(6) * 1e-3, atol=1e-6)

    def test_counts_and_losses_never_decrease(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            for name in ("time", "grain_contacts", "wall_contacts", "normal_loss", "friction_loss",
                         "max_overlap", "wall_contacts_ended", "wall_contacts_cut_short",
                         "wall_braking", "wall_braking_cut_short", "wall_visits",
                         "wall_visit_contacts", "wall_pulling_time"):
                self.assertTrue((np.diff(file["series"][name]) >= 0.0).all(), name)
            self.assertGreater(file["series/grain_contacts"][-1], 0)
            self.assertGreater(file["series/wall_contacts"][-1], 0)

    def test_the_energy_balance_closes(self):
        energy = self.summary(self.out)["energy"]
        self.assertLess(abs(energy["residual"]), 1e-2 * energy["initial"])
        balance = (energy["initial"] + energy["gravity_work"] - energy["kinetic"]
                   - energy["elastic"] - energy["normal_loss"] - energy["friction_loss"])
        self.assertAlmostEqual(balance, energy["residual"], delta=1e-12 * energy["initial"])

    def test_the_final_state_has_all_grains_inside_the_tube(self):
        summary = self.summary(self.out)
        with h5py.File(self.out / "run.h5", "r") as file:
            final = file["final"]
            grains = summary["grains"]
            self.assertEqual(final["position"].shape, (grains, 2))
            self.assertEqual(final["velocity"].shape, (grains, 2))
            self.assertEqual(list(final["id"]), list(range(grains)))
            x, y = final["position"][()].T
            self.assertTrue(((x > 0.0) & (x < 10e-3)).all())
            self.assertTrue(((y >= 0.0) & (y < 10e-3)).all())
            self.assertEqual(final.attrs["step"], summary["steps"])
            self.assertEqual(final["position"].attrs["unit"], b"m")
            area = np.pi * (final["radius"][()] ** 2).sum()
            self.assertAlmostEqual(area / 1e-4, 0.3, delta=0.005)

    def test_the_run_file_tells_where_the_numbers_come_from(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            told = {name: item[()] for name, item in file["provenance"].items()}
        self.assertEqual(told["source"].decode(), SMALL_TUBE)
        writer, _, settings = (self.out / "effective.yaml").read_bytes().partition(b"\n")
        self.assertEqual(told["settings"], settings)
        self.assertIn(told["riesel_version"] + b", commit " + told["git_commit"], writer)
        self.assertIn(b"run", told["command"])
        self.assertEqual(told["riesel_version"].decode(), self.summary(self.out)["version"])

    def test_the_profiles_add_up_to_the_tube(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            profiles, series, final = file["profiles"], file["series"], file["final"]
            strips = len(profiles["x"])
            self.assertEqual(strips, 10)
            np.testing.assert_allclose(profiles["x"], (np.arange(10) + 0.5) * 1e-3)
            for name, profile in profiles.items():
                self.assertEqual(profile.shape, (strips,), name)
                self.assertTrue(profile.attrs["unit"], name)
                self.assertTrue(profile.attrs["doc"], name)
                self.assertTrue(name == "x" or name.endswith("_error")
                                or f"{name}_error" in profiles, name)
            covered = np.pi * (final["radius"][()] ** 2).sum()
            self.assertAlmostEqual(profiles["area_fraction"][()].mean() * 1e-4 / covered, 1.0)
            mass = profiles["density"][()].mean() * 1e-4
            self.assertAlmostEqual(mass / final["mass"][()].sum(), 1.0)
            after = series["time"][()] >= profiles.attrs["since"] - 1e-12
            first = int(np.argmax(after))
            np.testing.assert_allclose(series["time"][first], profiles.attrs["since"])

    def test_the_parts_of_the_stress_add_up(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            stress = {name: data[()] for name, data in file["profiles"].items()}
        for a, b in ("xx", "xy", "yy"):
            np.testing.assert_allclose(
                stress[f"stress_{a}{b}"],
                stress[f"kinetic_stress_{a}{b}"] + stress[f"contact_stress_{a}{b}"], atol=1e-12)
        # What grains carry has no order of its letters; what contacts hand on has, without rotation.
        np.testing.assert_allclose(
            stress["stress_yx"], stress["kinetic_stress_xy"] + stress["contact_stress_yx"], atol=1e-12)
        self.assertGreater(abs(stress["contact_stress_yx"] - stress["contact_stress_xy"]).max(), 0.0)
        self.assertTrue((stress["kinetic_stress_xx"] >= 0.0).all())
        self.assertGreater(stress["contact_stress_xx"].max(), 0.0)

    def test_the_summary_tells_of_the_core_and_of_the_walls(self):
        summary = self.summary(self.out)
        with h5py.File(self.out / "run.h5", "r") as file:
            area = file["profiles/area_fraction"][()]
        profiles = summary["profiles"]
        self.assertAlmostEqual(profiles["core"]["area_fraction"]["value"], area[2:8].mean())
        self.assertAlmostEqual(profiles["wall_layers"]["area_fraction"]["value"],
                               area[[0, 9]].mean())

    def test_the_histograms_count_what_has_ended(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            histograms, series = file["histograms"], file["series"]
            counts = {name: group["count"][()].sum() for name, group in histograms.items()}
            # The run goes on for a step or so after the last row.
            after_the_rows = counts["wall_contact_duration"] - series["wall_contacts_ended"][-1]
            self.assertIn(after_the_rows, (0, 1, 2))
            self.assertEqual(counts["wall_contact_overlap"], counts["wall_contact_duration"])
            self.assertEqual(counts["grain_contact_overlap"], counts["grain_contact_duration"])
            self.assertGreater(counts["grain_contact_duration"], 0)
            visits = self.summary(self.out)["wall_visits"]["of_contacts_since_start"]
            self.assertEqual(counts["wall_visit_entry_rate"], sum(visits))
            self.assertEqual(counts["wall_visit_entry_slip"], sum(visits))

    def test_wall_contacts_slip_about_as_far_as_their_speed_and_duration_say(self):
        series = {name: column[-1] for name, column in series_of(self.out).items()}
        speed = series["wall_slip_path"] / series["wall_contact_time"]
        at_first = series["wall_entry_slip"] / series["wall_contacts_ended"]
        # Friction slows the grains down, and at most reverses what is along the surface.
        self.assertGreater(speed, 0.2 * at_first)
        self.assertLess(speed, at_first)

    def test_the_histograms_hold_the_sums_of_the_series(self):
        """They lie between what they were if all values stood at the lower edges of their bins, or at the upper."""
        with h5py.File(self.out / "run.h5", "r") as file:
            for name, column, ended in (("wall_visit_entry_rate", "wall_visit_entry_rate", "wall_visits"),
                                        ("wall_visit_entry_slip", "wall_visit_entry_slip", "wall_visits"),
                                        ("wall_contact_duration", "wall_contact_time", "wall_contacts_ended"),
                                        ("grain_contact_duration", "grain_contact_time", "grain_contacts_ended")):
                with self.subTest(name):
                    count = file[f"histograms/{name}/count"][()]
                    edges = file[f"histograms/{name}/lower_edge"][()]
                    self.assertGreater(count.sum(), 10)
                    # The outermost bins hold what is beyond all, too.
                    self.assertEqual((count[0], count[-1]), (0, 0))
                    count, lower, upper = count[:-1], edges[:-1], edges[1:]
                    # The run goes on for a step or so after the last row.
                    after_the_rows = count.sum() - file[f"series/{ended}"][-1]
                    total, largest = file[f"series/{column}"][-1], upper[count > 0].max()
                    self.assertLessEqual((count * lower).sum() - after_the_rows * largest, total)
                    self.assertLess(total, (count * upper).sum())

    def test_the_rates_of_the_histograms_are_those_of_the_series(self):
        """Of what came after the transient, with error bars."""
        summary = self.summary(self.out)
        with h5py.File(self.out / "run.h5", "r") as file:
            histograms, series = file["histograms"], file["series"]
            self.assertEqual(histograms.attrs["since"], summary["transient_end"])
            after = series["time"][()] >= summary["transient_end"] - 1e-12
            ended = np.ptp(series["wall_contacts_ended"][()][after])
            time = np.ptp(series["time"][()][after])
            for name in ("wall_contact_duration", "wall_contact_overlap"):
                group = histograms[name]
                self.assertAlmostEqual(group["rate"][()].sum(), ended / time, delta=1e-6 * ended / time)
                self.assertEqual(group["rate"].attrs["unit"], b"1/s")
                self.assertTrue((group["rate_error"][()][group["rate"][()] > 0] > 0).any())
            self.assertGreater(ended, 0)

    def test_the_braking_of_each_wall_is_that_of_its_series(self):
        summary = self.summary(self.out)
        series = series_of(self.out)
        with h5py.File(self.out / "run.h5", "r") as file:
            weight = 10.0 * file["final/mass"][()].sum()
        after = series["time"] >= summary["transient_end"] - 1e-12
        braking = summary["braking_force"]
        self.assertAlmostEqual(braking["weight"] / weight, 1.0)
        for wall in ("left", "right"):
            impulse = series[f"{wall}_wall_impulse_y"]
            force = -(impulse[after][-1] - impulse[after][0]) / np.ptp(series["time"][after])
            self.assertAlmostEqual(braking[wall]["value"] / force, 1.0, delta=1e-6)
            self.assertGreater(force, 0.0)
            self.assertGreater(braking[wall]["error"], 0.0)
        self.assertNotEqual(braking["left"]["value"], braking["right"]["value"])
        begun = np.ptp(series["grain_contacts"][after]) / np.ptp(series["time"][after])
        self.assertAlmostEqual(
            summary["grain_contact_rate"]["value"] * summary["grains"] / 2.0 / begun, 1.0, delta=1e-6)
        both = series["left_wall_impulse_y"] + series["right_wall_impulse_y"]
        np.testing.assert_allclose(both, series["wall_impulse_y"], rtol=1e-12, atol=1e-20)
        balance = summary["balance"]["n_dot_dv_y"] / summary["balance"]["gravity"]
        both = braking["left"]["value"] + braking["right"]["value"]
        self.assertAlmostEqual(both / weight, balance)


class FinalForces(CommandTest):

    def test_elastic_contacts_push_apart_in_proportion_to_their_overlap(self):
        out = self.run_small_tube("out", "--set", "contact.restitution=1", "--set", "contact.friction=0")
        with h5py.File(out / "run.h5", "r") as file:
            position, radius = file["final/position"][()], file["final/radius"][()]
            length = file["final"].attrs["box_length"]
            contacts = {name: column[()] for name, column in file["final/contacts"].items()}
        among_grains = contacts["wall"] == -1
        self.assertGreater(among_grains.sum(), 1)
        i, j = contacts["grain"][among_grains], contacts["partner"][among_grains]
        away = position[i] - position[j]
        away[:, 1] -= length * np.round(away[:, 1] / length)
        distance = np.hypot(*away.T)
        overlap = radius[i] + radius[j] - distance
        np.testing.assert_allclose(contacts["force"][among_grains], 2000.0 * (overlap / distance)[:, None] * away,
                                   rtol=1e-6, atol=1e-9)


class SameBits(CommandTest):

    def test_for_any_number_of_threads(self):
        short = ["--set", "run.duration=0.4 ms", "--set", "output.interval=0.1 ms"]
        one = self.run_small_tube("one", *short)
        self.assertGreater(len(data_of(one, "/final/contacts")), 0)
        self.assertLess(self.summary(one)["steps"], 500)
        for stepping in ("plain", "windows"):  # the choice would be one thread
            for threads in (2, 3, 4):
                self.assert_same_result(one, self.run_small_tube(
                    f"{stepping}-{threads}", *short, "--set", f"run.stepping={stepping}", threads=threads))

    def test_for_any_way_of_stepping(self):
        one = self.run_small_tube("one")
        for stepping in ("plain", "windows"):
            self.assert_same_result(
                one, self.run_small_tube(stepping, "--set", f"run.stepping={stepping}"))

    def test_for_the_effective_settings(self):
        one = self.run_small_tube("one")
        again = self.run_to_end(one / "effective.yaml", "again")
        self.assert_same_result(one, again)
        self.assertEqual((one / "effective.yaml").read_bytes(),
                         (again / "effective.yaml").read_bytes())

    def test_but_not_for_another_seed(self):
        one = self.run_small_tube("one", "--set", "run.duration=0.1 ms")
        other = self.run_small_tube("other", "--set", "run.duration=0.1 ms", "--set", "seed=2")
        self.assertNotEqual(self.state_hash(one), self.state_hash(other))


class LostGrains(CommandTest):

    def test_a_grain_that_leaves_by_the_open_side_of_a_chute_is_told(self):
        result = self.riesel("run", SHIPPED / "inclined_chute.yaml", "--out", "out", "--threads", 1, "--set",
                             "chute.layers=3", "--set", "chute.length=10 mm", "--set", "start.random_velocity=1 m/s",
                             "--set", "run.duration=0.3 s")
        self.assertEqual(result.returncode, FAILED, result)
        self.assertRegex(result.stderr, r"grain \d+ has left the system at t = 0\.\d+ s \(step \d+\); more room at the "
                                        r"open side or a slower start may help")
        self.assertTrue((self.home / "out" / "post_mortem.h5").exists())

    def test_a_run_that_goes_wrong_fails_with_a_reason_and_keeps_what_it_has(self):
        tube = self.write("tube.yaml", SMALL_TUBE)
        for name, overrides in {
                "soft": ["contact.stiffness=20", "start.random_velocity=20 m/s"],
                "hot": ["start.random_velocity=200 m/s"],
        }.items():
            with self.subTest(name):
                options = [part for override in overrides for part in ("--set", override)]
                result = self.riesel("run", tube, "--out", name, "--threads", 1, *options)
                self.assertEqual(result.returncode, FAILED, result)
                self.assertEqual(result.stdout, "")
                self.assertIn("riesel: the run failed: ", result.stderr)
                self.assertIn(f"{name}/post_mortem.h5", result.stderr)
                self.assertIn("/final/position", data_of(self.home / name))
                self.assertFalse((self.home / name / "summary.json").exists())
