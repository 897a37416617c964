"""riesel sweep: many runs from one file, each the run that `riesel run` would make, whatever
happens on the way."""

import csv
import json
import re
import shutil
import signal

import h5py

from riesel_command import (BAD_INPUT, DONE, FAILED, PATIENCE, SHIPPED, SMALL_TUBE, CommandTest,
                            bytes_of_files)

GRID = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes:
  - contact.restitution: [0.7, 0.9]
    contact.friction: {from: 0.1, to: 0.4, points: 2, spacing: log}
branches:
  slow: {start.axial_velocity: 1 m/s}
  fast: {start.axial_velocity: 8 m/s}
seeds: [1, 5]
"""

# The same points, written and ordered otherwise.
GRID_REARRANGED = """\
seeds: [5, 1]
branches:
  fast: {start.axial_velocity: 8000 mm/s}
  slow: {start.axial_velocity: 1}
axes:
  - contact.friction: [40 %, 10 %]
    contact.restitution: [90 %, 0.7]
base:
  scenario: periodic_tube
  run: {duration: 2e-3, threads: 2}
  tube: {length: 1 cm, width: 10 mm}
  contact: {stiffness: 2 kN/m}
  start: {random_velocity: 2}
  grains: {area_fraction: 0.3}
"""

CHAIN = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes:
  contact.restitution: [0.7, 0.8, 0.9]
continue_along: contact.restitution
"""

ONE_POINT = """\
base: tube.yaml
set: {run.duration: 2 ms}
axes: {contact.stiffness: [2000 N/m]}
"""

# The second point has contacts so soft that grains go through the walls.
ONE_FAILS = """\
base: tube.yaml
set: {run.duration: 4 ms}
axes: {contact.stiffness: [2000 N/m, 0.5 N/m, 1000 N/m]}
"""


class SweepTest(CommandTest):

    def setUp(self):
        super().setUp()
        self.write("tube.yaml", SMALL_TUBE)

    def sweep(self, text, out="out", *options):
        self.write("sweep.yaml", text)
        return self.riesel("sweep", "sweep.yaml", "--out", out, *options)

    def sweep_to_end(self, text, out="out", *options):
        self.assert_done(self.sweep(text, out, *options))
        return self.home / out

    def manifest(self, out="out"):
        return json.loads((self.home / out / "manifest.json").read_text(encoding="utf-8"))

    def points(self, out="out"):
        return self.manifest(out)["points"]

    def rows(self, out="out"):
        with open(self.home / out / "sweep.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def hashes(self, out="out"):
        """{name of the point: state hash}"""
        hashes = {row["point"]: row["state_hash"] for row in self.rows(out)}
        self.assertNotIn("", hashes.values())
        return hashes


class Grid(SweepTest):

    def test_a_dry_run_lists_the_points_and_writes_nothing(self):
        before = bytes_of_files(self.home)
        self.write("sweep.yaml", GRID)
        before["sweep.yaml"] = GRID.encode()
        result = self.sweep(GRID, "out", "--dry-run")
        self.assert_done(result)
        self.assert_nothing_written(before)
        self.assertEqual(len(re.findall(r"out/points/[0-9a-f]{16} ", result.stdout)), 8)
        self.assertIn("8 points, 8 runs, about ", result.stdout)
        self.assertIn("contact.restitution=0.9 contact.friction=0.4 start.axial_velocity=8 seed=5 "
                      "fast", result.stdout)

    def test_one_point_is_told_as_one(self):
        self.assertRegex(self.sweep(ONE_POINT, "out", "--dry-run").stdout, r"(?m)^1 point, 1 run, about ")

    def test_every_combination_is_the_run_that_it_names(self):
        self.sweep_to_end(GRID)
        rows = self.rows()
        self.assertEqual(len(rows), 8)
        self.assertEqual(len({row["point"] for row in rows}), 8)
        self.assertEqual({row["status"] for row in rows}, {"done"})
        for row in rows[1::3]:
            alone = self.run_to_end("tube.yaml", "runs/" + row["point"], *[
                f"--set={key}={value}" for key, value in {
                    "run.duration": "2 ms", "contact.restitution": row["contact.restitution"],
                    "contact.friction": row["contact.friction"], "seed": row["seed"],
                    "start.axial_velocity": row["start.axial_velocity"]}.items()])
            self.assert_same_result(alone, self.home / "out/points" / row["point"])
            self.assertEqual(self.state_hash(alone), row["state_hash"])
            self.assertEqual(row["branch"], "slow" if row["start.axial_velocity"] == "1" else "fast")

    def test_names_and_results_do_not_depend_on_how_the_file_is_written(self):
        self.sweep_to_end(GRID, "one", "--jobs", 1)
        self.sweep_to_end(GRID_REARRANGED, "other", "--jobs", 3)
        self.assertEqual(self.hashes("one"), self.hashes("other"))
        self.assertNotEqual([row["point"] for row in self.rows("one")],
                            [row["point"] for row in self.rows("other")])

    def test_whoever_starts_it_may_ignore_the_ends_of_children(self):
        self.write("sweep.yaml", GRID)
        process = self.start("sweep", "sweep.yaml", "--out", "out",
                             preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0)
        self.assertEqual({point["status"] for point in self.points()}, {"done"})

    def test_what_is_done_is_not_done_again(self):
        out = self.sweep_to_end(GRID)
        points = bytes_of_files(out / "points")
        self.sweep_to_end(GRID)
        self.assertEqual(bytes_of_files(out / "points"), points)
        self.assertEqual({point["attempts"] for point in self.points()}, {1})

    def test_a_longer_axis_runs_the_new_points_only(self):
        out = self.sweep_to_end(GRID)
        before = bytes_of_files(out / "points")
        self.sweep_to_end(GRID.replace("[0.7, 0.9]", "[0.7, 0.8, 0.9]").replace(
            "points: 2", "points: 3"))
        after = bytes_of_files(out / "points")
        self.assertEqual({path: after[path] for path in before}, before)
        self.assertEqual(len(self.hashes()), 12)

    def test_equal_points_are_one_run(self):
        self.sweep_to_end(GRID.replace("8 m/s", "1 m/s").replace("[1, 5]", "[5, 5]"))
        rows = self.rows()
        self.assertEqual(len(rows), 4)
        self.assertEqual(len(list((self.home / "out/points").iterdir())), 2)
        for slow, fast in zip(rows[::2], rows[1::2]):
            self.assertEqual((slow["branch"], fast["branch"]), ("slow", "fast"))
            self.assertEqual(slow["state_hash"], fast["state_hash"])

    def test_a_damaged_result_is_told_and_the_others_are_in_the_table(self):
        out = self.sweep_to_end(CHAIN.replace("continue_along: contact.restitution\n", ""))
        damaged = out / "points" / self.rows()[1]["point"]
        for text, mention in {'{"validity": {"findings": [1]}}': "is damaged", "": "summary.json"}.items():
            with self.subTest(text):
                (damaged / "summary.json").write_text(text, encoding="utf-8")
                result = self.riesel("collect", "out")
                self.assertEqual(result.returncode, FAILED)
                self.assertIn(f"{damaged.name}/summary.json", result.stderr)
                self.assertIn(mention, result.stderr)
                self.assertEqual([row["state_hash"] != "" for row in self.rows()], [True, False, True])
                self.assertIn("summary.json", self.rows()[1]["reason"])

    def test_large_numbers_are_told_with_all_their_digits(self):
        listed = self.sweep(CHAIN.replace("continue_along: contact.restitution", "seeds: [20240101, 20240102]"), "out",
                            "--dry-run")
        for number in ("seed=20240101", "seed=20240102", "contact.restitution=0.7 "):
            self.assertIn(number, listed.stdout)

    def test_a_list_stands_in_one_line(self):
        self.write("wall.yaml", "scenario: single_wall_grain\ncontact: {stiffness: 2000 N/m, restitution: 0.9}\n")
        listed = self.sweep("base: wall.yaml\naxes: {impact.axial_velocity: [[1, 2, 3, 4, 5, 6], [2, 4]]}\n", "out",
                            "--dry-run")
        self.assertIn("impact.axial_velocity=[1.0, 2.0, 3.0, 4.0, 5.0, 6.0] seed", listed.stdout)

    def test_another_sweep_is_not_put_in_its_place(self):
        out = self.sweep_to_end(ONE_POINT)
        before = bytes_of_files(out / "points") | {"table": (out / "sweep.csv").read_bytes()}
        other = ONE_POINT.replace("2000", "3000")
        self.assert_refused(self.sweep(other), "holds another sweep", "--out")
        self.assertEqual(bytes_of_files(out / "points") | {"table": (out / "sweep.csv").read_bytes()}, before)
        both = self.sweep(other.replace("[3000 N/m]", "[2000 N/m, 3000 N/m]"))
        self.assertNotIn("are not in this sweep", both.stderr)
        self.assertIn("1 of 2 points that were here are not in this sweep", self.sweep(other).stderr)
        self.assertEqual(len(self.rows()), 1)

    def test_seeds_of_runs_that_draw_no_numbers_are_refused(self):
        """Else means over seeds would be known exactly."""
        self.run_small_tube("earlier", "--set", "run.duration=1 ms")
        self.write("tube.yaml", SMALL_TUBE.replace("start: {random_velocity: 2 m/s}\n", ""))
        self.write("wall.yaml", "scenario: single_wall_grain\ncontact: {stiffness: 2000 N/m, restitution: 0.9}\n")
        for text in ("base: tube.yaml\nset: {start.kind: continued, start.from: earlier}\nseeds: 3\n",
                     "base: wall.yaml\nseeds: [4, 5]\n", "base: wall.yaml\naxes: {seed: [4, 5]}\n"):
            self.assert_refused(self.sweep(text), "seed: changes no result", "several times")
        self.assert_done(self.sweep("base: wall.yaml\nseeds: 1\n", "out", "--prepare"))

    def test_a_start_counts_by_what_stands_in_it(self):
        earlier = self.run_small_tube("earlier", "--set", "run.duration=1 ms")
        text = ("base: tube.yaml\nset: {run.duration: 1 ms, start.kind: continued, start.from: earlier}\n"
                "axes: {contact.friction: [0.5]}\n")
        base = SMALL_TUBE.replace("start: {random_velocity: 2 m/s}\n", "")
        self.write("tube.yaml", base)
        self.sweep_to_end(text)
        name = self.points()[0]["name"]
        (self.home / "elsewhere").mkdir()
        self.write("elsewhere/tube.yaml", base)
        self.write("elsewhere/sweep.yaml", text.replace("earlier", str(earlier)))
        self.assert_done(self.riesel("sweep", "elsewhere/sweep.yaml", "--out", "there", "--prepare"))
        self.assertEqual(self.points("there")[0]["name"], name)
        self.resume_to_end(earlier, "--set", "run.duration=2 ms")
        self.assert_done(self.sweep(text, "again", "--prepare"))
        self.assertNotEqual(self.points("again")[0]["name"], name)

    def test_the_table_holds_all_values_of_the_summaries(self):
        out = self.sweep_to_end(GRID)
        with h5py.File(out / "sweep.h5") as file:
            self.assertEqual(file["sweep_file"][()].decode(), GRID)
            table = {name: data[()] for name, data in file["points"].items()}
            self.assertEqual(file["points/contact.friction"].attrs["unit"].decode(), "1")
            self.assertEqual(file["points/start.axial_velocity"].attrs["unit"].decode(), "m/s")
        for i, row in enumerate(self.rows()):
            summary = self.summary(out / "points" / row["point"])
            self.assertEqual(table["point"][i].decode(), row["point"])
            self.assertEqual(float(row["mean_axial_velocity.error"]),
                             summary["mean_axial_velocity"]["error"])
            self.assertEqual(table["mean_axial_velocity.value"][i],
                             summary["mean_axial_velocity"]["value"])
            self.assertEqual(row["state"], summary["state"])
            self.assertEqual(table["state"][i].decode(), summary["state"])
            self.assertEqual(set(flat(summary)) - set(row), set())
            for finding in summary["validity"]["findings"]:
                cell = row[f"validity.findings.{finding['name']}"]
                self.assertEqual(float(cell) if cell else None, finding["value"])

    def test_the_columns_have_their_units(self):
        self.sweep_to_end(ONE_POINT)
        with h5py.File(self.home / "out/sweep.h5", "r") as file:
            columns = file["points"]
            unit = {name: columns[name].attrs.get("unit", b"").decode() for name in columns
                    if columns[name].dtype.kind == "f"}
        for name, expected in {"mean_axial_velocity.error": "m/s", "balance.errors.n_dot": "1/s",
                               "granular_temperature": "m^2/s^2", "braking_force.weight": "N",
                               "energy.residual": "J", "validity.t_col.walls": "s",
                               "profiles.core.stress_xx.value": "N/m", "contact.stiffness": "N/m",
                               "balance.gravity": "m/s^2"}.items():
            self.assertEqual(unit[name], expected, name)
        # What has none, has none: counts, and ratios of equal things.
        self.assertLessEqual({re.sub(r"\.(value|error)$", "", name) for name, of_it in unit.items() if of_it == ""},
                             {"seed", "attempts", "format", "held_back_by", "grains", "steps", "performance.threads",
                              "independent_samples", *[f"structure_factor.{n}" for n in range(1, 5)],
                              "profiles.core.area_fraction", "profiles.wall_layers.area_fraction",
                              "wall_visits.visits", "wall_visits.contacts", "validity.max_overlap_ratio",
                              "validity.brake_failure_fraction", "validity.friction_failure_fraction",
                              "validity.contacts_per_wall_visit",
                              *[name for name in unit if name.startswith("validity.findings.")]})

    def test_the_unit_of_a_setting_is_that_of_its_points(self):
        """It may depend on the contact law."""
        hertz = "contact.law: hertz, contact.damping: 4.1, contact.impact_speed: 1 m/s"
        base = "base: {scenario: periodic_tube, grains: {area_fraction: 0.1}, tube: {width: 5 mm, length: 5 mm}}"
        axis = "axes: {contact.stiffness: [5e5, 6e5]}\n"
        for number, (text, unit) in enumerate({
                f"set: {{run.duration: 1 us, {hertz}}}\n": "",
                "set: {run.duration: 1 us, contact.damping: 4.1}\n": "N/m",
                f"set: {{run.duration: 1 us}}\nbranches: {{hard: {{contact.damping: 4.1}}, round: {{{hertz}}}}}\n":
                ""}.items()):
            with self.subTest(unit):
                out = self.sweep_to_end(f"{base}\n{text}{axis}", f"out{number}")
                varied = {each["key"]: each["unit"] for each in self.manifest(out.name)["varied"]}
                self.assertEqual(varied["contact.stiffness"], unit)
                with h5py.File(out / "sweep.h5") as file:
                    stated = file["points/contact.stiffness"].attrs.get("unit", b"").decode()
                self.assertEqual(stated, unit)

    def test_impacts_are_swept_too_and_share_the_cores(self):
        for points, threads in ((1, "4"), (2, "2"), (4, "1")):
            out = f"sweeps/{points}"
            self.write(f"{points}.yaml", f"""\
base: {{scenario: single_wall_grain, contact: {{stiffness: 2000}}, impact: {{axial_velocity: [1, 2]}}}}
axes: {{contact.damping: {[1e4 / 2 ** i for i in range(points)]}}}
""")
            self.assert_done(self.riesel("sweep", f"{points}.yaml", OMP_NUM_THREADS="4"))
            rows = self.rows(out)
            self.assertEqual([float(row["contact.damping"]) for row in rows],
                             [1e4 / 2 ** i for i in range(points)])
            self.assertEqual(len(self.hashes(out)), points)
            self.assertEqual({row["performance.threads"] for row in rows}, {threads})

    def test_more_threads_than_there_is_memory_for(self):
        self.write("walls.yaml", "scenario: wall_array\ncontact: {stiffness: 2000 N/m, restitution: 0.9}\n"
                                 "impact: {starts: 2, axial_velocity: 1 m/s}\n")
        many = {"OMP_NUM_THREADS": "100000"}
        self.write("sweep.yaml", "base: walls.yaml\naxes: {contact.restitution: [0.8, 0.9]}\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--dry-run", **many))
        self.assert_done(self.riesel("run", "walls.yaml", **many))

    def test_the_longest_runs_go_first(self):
        # Which these are is found by the clock: so far apart that no other work confuses them.
        out = self.sweep_to_end("base: tube.yaml\naxes: {run.duration: [1 ms, 900 ms, 30 ms]}\n", "out",
                                "--jobs", 1)
        ends = {row["run.duration"]: (out / "points" / row["point"] / "summary.json").stat().st_mtime_ns
                for row in self.rows()}
        self.assertEqual(sorted(ends, key=ends.get), ["0.9", "0.03", "0.001"])


def flat(value, prefix=""):
    """Names of all single values, nested names joined by dots."""
    for name, part in value.items():
        if isinstance(part, dict):
            yield from flat(part, prefix + name + ".")
        elif name == "findings":
            yield from (f"{prefix}{name}.{finding['name']}" for finding in part)
        elif isinstance(part, list):
            continue
        else:
            yield prefix + name


class Chain(SweepTest):

    def test_runs_go_forward_and_back_each_from_its_neighbours_end(self):
        out = self.sweep_to_end(CHAIN, "out", "--jobs", 3)
        rows = self.rows()
        self.assertEqual([(row["contact.restitution"], row["leg"]) for row in rows],
                         [("0.7", "forward"), ("0.8", "forward"), ("0.9", "forward"),
                          ("0.8", "backward"), ("0.7", "backward")])
        self.assertEqual([row["parent"] for row in rows],
                         [""] + [row["point"] for row in rows[:-1]])
        summaries = [self.summary(out / "points" / row["point"]) for row in rows]
        for before, after in zip(summaries, summaries[1:]):
            left = before["energy"]["kinetic"] + before["energy"]["elastic"]
            self.assertAlmostEqual(after["energy"]["initial"] / left, 1.0, delta=1e-12)
        self.assertNotEqual(rows[0]["state_hash"], rows[4]["state_hash"])

    def test_the_first_point_is_an_ordinary_run_and_shared_with_other_sweeps(self):
        self.sweep_to_end(CHAIN)
        first = self.rows()[0]
        self.sweep_to_end(CHAIN.replace("continue_along: contact.restitution\n", ""), "grid")
        self.assertEqual(self.hashes("grid")[first["point"]], first["state_hash"])

    def test_a_point_can_be_run_by_hand(self):
        out = self.sweep_to_end(CHAIN)
        second = self.rows()[1]
        for name in ("point.yaml", "effective.yaml"):
            alone = self.run_to_end(out / "points" / second["point"] / name, "by_" + name)
            self.assertEqual(self.state_hash(alone), second["state_hash"])

    def test_another_past_is_another_point(self):
        self.sweep_to_end(CHAIN, "up")
        self.sweep_to_end(CHAIN.replace("[0.7, 0.8, 0.9]", "[0.75, 0.8, 0.9]"), "other")
        self.assertEqual(set(self.hashes("up")) & set(self.hashes("other")), set())

    def test_a_failed_neighbour_is_told_and_the_rest_of_the_chain_waits(self):
        chain = ONE_FAILS + "continue_along: contact.stiffness\n"
        result = self.sweep(chain)
        self.assertEqual(result.returncode, FAILED, result)
        points = self.points()
        self.assertEqual([point["status"] for point in points],
                         ["done", "failed", "waiting", "waiting", "waiting"])
        for before, after in zip(points[1:], points[2:]):
            self.assertIn(before["name"], after["reason"])

    def test_another_tube_cannot_be_continued(self):
        self.sweep_to_end(CHAIN)
        point = self.rows()[1]["point"]
        before = bytes_of_files(self.home)
        result = self.riesel("run", f"out/points/{point}/point.yaml", "--out", "x", "--set",
                             "tube.width=11 mm")
        self.assert_refused(result, "tube.width", "0.011", "0.01 ", "continued")
        result = self.riesel("run", f"out/points/{point}/point.yaml", "--out", "x", "--set",
                             "start.from=nowhere")
        self.assert_refused(result, "start.from", "nowhere")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_the_start_may_differ_between_chains(self):
        branches = "{slow: {start.axial_velocity: 1 m/s}, fast: {start.axial_velocity: 3 m/s}}"
        self.sweep_to_end(f"{CHAIN}branches: {branches}\nseeds: 2\n")
        self.assertEqual(len(set(self.hashes().values())), 20)
        self.assertEqual([row["status"] for row in self.rows()], ["done"] * 20)


class Failures(SweepTest):

    def test_a_failure_is_recorded_and_does_not_stop_the_others(self):
        result = self.sweep(ONE_FAILS)
        self.assertEqual(result.returncode, FAILED, result)
        points = self.points()
        self.assertEqual([point["status"] for point in points], ["done", "failed", "done"])
        self.assertIn("gone through a wall", points[1]["reason"])
        self.assertIn("gone through a wall", result.stderr)
        rows = self.rows()
        self.assertEqual([row["status"] for row in rows], ["done", "failed", "done"])
        self.assertEqual((rows[1]["state_hash"], rows[1]["reason"]), ("", points[1]["reason"]))

    def test_a_directory_may_look_like_an_option(self):
        self.write("sweep.yaml", ONE_FAILS)
        told = self.riesel("sweep", "sweep.yaml", "--out=-x").stdout
        again, = re.findall(r"'riesel (sweep .*) --retry-failed'", told)
        self.assertEqual(self.riesel(*again.split()).returncode, FAILED)
        self.assertEqual(again, "sweep ./-x")

    def test_a_failed_point_is_run_again_only_if_asked(self):
        attempts = []
        for options in ([], [], ["--retry-failed"]):
            result = self.sweep(ONE_FAILS, "out", *options)
            self.assertEqual(result.returncode, FAILED, result)
            attempts.append([point["attempts"] for point in self.points()])
        self.assertEqual(attempts, [[1, 1, 1], [1, 1, 1], [1, 2, 1]])

    def test_attempts_do_not_overflow(self):
        most = 2**31 - 1
        self.assert_done(self.sweep(ONE_POINT, "out", "--prepare"))
        record = self.home / "out/points" / self.points()[0]["name"] / "attempts.json"
        record.write_text(json.dumps({"attempts": most, "failure": ""}), encoding="utf-8")
        self.assert_done(self.riesel("sweep", "out"))
        self.assertEqual(self.points()[0]["attempts"], most)

    def damage(self, text):
        """The summary of the first point."""
        point = self.home / "out/points" / self.points()[0]["name"]
        (point / "summary.json").write_text(text, encoding="utf-8")
        return point

    def test_a_result_that_is_cut_short_is_made_anew(self):
        self.sweep_to_end(ONE_POINT)
        whole = self.hashes()
        for text in ("", "{", '{"scenario": "peri'):
            with self.subTest(text):
                self.damage(text)
                self.assertIn("1 interrupted", self.riesel("status", "out").stdout)
                self.assert_done(self.riesel("sweep", "out"))
                self.assertEqual(self.hashes(), whole)

    def test_a_result_that_is_cut_short_and_cannot_be_made_anew_is_a_failure(self):
        self.sweep_to_end(ONE_POINT)
        point = self.damage("{")
        for path in point.glob("checkpoint*"):
            path.unlink()
        before = bytes_of_files(point)
        for options in ([], ["--retry-failed"]):
            result = self.riesel("sweep", "out", *options)
            self.assertEqual(result.returncode, FAILED, result)
            self.assertIn("summary.json is damaged; restore it", result.stdout)
            self.assertEqual(bytes_of_files(point), before)

    def test_a_result_that_is_damaged_otherwise_is_told(self):
        self.sweep_to_end(ONE_POINT)
        point = self.damage("{]}")
        result = self.riesel("sweep", "out")
        self.assertEqual(result.returncode, FAILED, result)
        self.assert_one_message(result.stderr, "summary.json",
                                f"riesel resume out/points/{point.name}'")
        self.resume_to_end(point)
        self.assert_done(self.riesel("sweep", "out"))

    def test_results_of_other_points_are_not_taken(self):
        """After two directories have changed places: of other settings, or of another past."""
        for text, one, other in ((GRID, 0, 1), (CHAIN, 1, 3)):
            with self.subTest(text):
                shutil.rmtree(self.home / "out", ignore_errors=True)
                out = self.sweep_to_end(text)
                points = self.points()
                one_point, other_point = (out / "points" / points[i]["name"] for i in (one, other))
                aside = one_point.with_name("aside")
                one_point.rename(aside)
                other_point.rename(one_point)
                aside.rename(other_point)
                for command, status in ((["collect", "out"], FAILED), (["status", "out"], DONE)):
                    result = self.riesel(*command)
                    self.assertEqual((result.returncode, result.stderr), (status, ""))
                    self.assertIn("2 failed", result.stdout)
                    self.assertEqual(result.stdout.count("is of another point"), 2)
                self.assertEqual(self.riesel("sweep", "out").returncode, FAILED)
                for row in self.rows():
                    misplaced = row["point"] in (one_point.name, other_point.name)
                    self.assertEqual((row["status"], row["state_hash"] == ""),
                                     ("failed", True) if misplaced else ("done", False))

    def test_what_is_left_takes_no_time_for_what_has_failed(self):
        self.assertEqual(self.sweep(ONE_FAILS).returncode, FAILED)
        manifest = self.manifest()
        for point in manifest["points"]:
            point["expected_seconds"] = 36000.0
        self.write("out/manifest.json", json.dumps(manifest))
        for options, told in (([], "1 s"), (["--retry-failed"], "10.0 h")):
            result = self.riesel("sweep", "out", "--dry-run", *options)
            self.assertIn(f"3 runs, about {told} with ", result.stdout)

    def test_failed_chains_are_not_to_be_run_with_changes(self):
        out = self.sweep_to_end(CHAIN)
        point = out / "points" / self.points()[-1]["name"]
        for path in [point / "summary.json", *point.glob("checkpoint*")]:
            path.unlink()
        (point / "attempts.json").write_text(json.dumps({"attempts": 1, "failure": "bad luck"}),
                                             encoding="utf-8")
        told = self.riesel("status", "out").stdout
        self.assertIn("to run the failed points again: '", told)
        self.assertNotIn("--set", told)

    def prepare_three(self):
        """Returns their directories."""
        self.assert_done(self.sweep(CHAIN.replace("continue_along: contact.restitution\n", ""), "out", "--prepare"))
        return [self.home / "out/points" / point["name"] for point in self.points()]

    def assert_the_others_are_done(self, result, failed, reason):
        """Of three points."""
        self.assertEqual(result.returncode, FAILED, result)
        self.assertEqual([row["status"] for row in self.rows()],
                         ["failed" if i == failed else "done" for i in range(3)])
        self.assertIn(reason, self.rows()[failed]["reason"])
        self.assertIn(reason, result.stderr + result.stdout)

    def test_a_point_that_cannot_be_written_fails_alone(self):
        for name, reason in (("log.txt", "log.txt: cannot be written: Is a directory"),
                             ("attempts.json", "attempts.json: "), (".lock", "cannot be locked: Is a directory")):
            with self.subTest(name):
                shutil.rmtree(self.home / "out", ignore_errors=True)
                obstacle = self.prepare_three()[1] / name
                obstacle.mkdir()
                self.assertIn(f"failed: {obstacle.parent}".replace(f"{self.home}/", ""),
                              self.riesel("sweep-task", "out", 1).stdout)
                for options in ([], ["--retry-failed"]):
                    self.assert_the_others_are_done(self.riesel("sweep", "out", *options), 1, reason)
                obstacle.rmdir()
                self.assert_done(self.riesel("sweep", "out", "--retry-failed"))

    def test_a_point_out_of_reach_fails_alone(self):
        point = self.prepare_three()[0]
        aside = point.with_name("aside")
        point.rename(aside)
        point.symlink_to(point.name)  # to itself: as without permission, but for root, too
        for command in (["out"], ["out", "--retry-failed"], ["sweep.yaml", "--out", "out"]):
            self.assert_the_others_are_done(self.riesel("sweep", *command), 0, "cannot be reached")
        for command in ("status", "report"):
            self.assert_done(self.riesel(command, "out"))
        collected = self.riesel("collect", "out")
        self.assertEqual((collected.returncode, "2 done, 1 failed" in collected.stdout), (FAILED, True), collected)
        self.assertEqual(self.sweep(CHAIN.replace("continue_along: contact.restitution\n", ""), "out",
                                    "--prepare").returncode, FAILED)
        point.unlink()
        aside.rename(point)
        self.assert_done(self.riesel("sweep", "out"))

    def test_status_tells_why(self):
        self.sweep(ONE_FAILS)
        result = self.riesel("status", "out")
        self.assert_done(result)
        self.assertIn("3 points: 2 done, 1 failed", result.stdout)
        self.assertIn("--retry-failed'", result.stdout)
        self.assertIn("--set", result.stdout)
        self.assertRegex(result.stdout, r"failed \(contact.stiffness=0.5 seed=1\): .*a wall")


class Tasks(SweepTest):

    def test_the_points_of_a_prepared_sweep_can_be_run_one_by_one(self):
        self.sweep_to_end(CHAIN, "whole")
        self.assert_done(self.sweep(CHAIN, "out", "--prepare"))
        self.assertEqual({point["status"] for point in self.points()}, {"waiting"})
        refused = self.riesel("sweep-task", "out", 1)
        self.assert_refused(refused, "neighbour", self.points()[0]["name"], "run that one first")
        for index in range(5):
            result = self.riesel("sweep-task", "out", index)
            self.assert_done(result)
            self.assertIn(": done", result.stdout)
        self.assert_done(self.riesel("collect", "out"))
        self.assertEqual(self.hashes("whole"), self.hashes("out"))

    def test_a_task_that_fails_says_so(self):
        self.sweep(ONE_FAILS, "out", "--prepare")
        for options, attempts in (([], 1), ([], 1), (["--retry-failed"], 2)):
            result = self.riesel("sweep-task", "out", 1, *options)
            self.assertEqual(result.returncode, FAILED, result)
            record = self.home / "out/points" / self.points()[1]["name"] / "attempts.json"
            self.assertEqual(json.loads(record.read_text(encoding="utf-8"))["attempts"], attempts)

    def test_what_is_no_point_is_refused(self):
        self.sweep(CHAIN, "out", "--prepare")
        self.assert_refused(self.riesel("sweep-task", "out", 5), "no point 5", "from 0 to 4")
        for command in (["sweep-task", "nowhere", 0], ["status", "nowhere"], ["collect", "."]):
            self.assert_refused(self.riesel(*command), "manifest.json", "'riesel sweep'")

    def test_the_directory_of_a_run_is_no_place_for_a_sweep(self):
        self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        before = bytes_of_files(self.home / "out")
        self.assert_refused(self.sweep(CHAIN), "out: holds a run", "--out")
        self.assertEqual(bytes_of_files(self.home / "out"), before)

    def test_a_dry_run_refuses_what_the_sweep_refuses(self):
        self.run_small_tube("run", "--set", "run.duration=0.1 ms")
        self.sweep_to_end(ONE_POINT, "other")
        before = bytes_of_files(self.home)
        for out, mention in (("run", "run: holds a run"), ("other", "other: holds another sweep")):
            for options in ([], ["--dry-run"], ["--slurm", "--dry-run"]):
                with self.subTest(out, options=options):
                    self.assert_refused(self.sweep(CHAIN, out, *options), mention, "--out")
        after = bytes_of_files(self.home)
        del before["sweep.yaml"], after["sweep.yaml"], before["other/.lock"], after["other/.lock"]
        self.assertEqual(after, before)

    def test_files_of_others_are_not_overwritten(self):
        for name in ("sweep.yaml", "sweep.csv", "sweep.h5"):
            for options in ([], ["--dry-run"]):
                with self.subTest(name, options=options):
                    (self.home / name).mkdir()
                    self.write(f"{name}/{name}", "mine")
                    self.write("one.yaml", ONE_POINT)
                    result = self.riesel("sweep", "one.yaml", "--out", name, *options)
                    self.assert_refused(result, f"{name}/{name}", "--out")
                    self.assertEqual(bytes_of_files(self.home / name), {name: b"mine"})
                    shutil.rmtree(self.home / name)

    def test_a_sweep_that_has_lost_its_manifest_makes_it_anew(self):
        out = self.sweep_to_end(ONE_POINT)
        before = self.manifest()
        (out / "manifest.json").unlink()
        self.sweep_to_end(ONE_POINT)
        for manifest in (before, self.manifest()):
            del manifest["points"][0]["expected_seconds"]
            self.assertEqual(manifest["points"][0]["status"], "done")

    def test_a_sweep_of_which_nothing_has_come_may_be_replaced(self):
        self.assert_done(self.sweep(ONE_POINT, "out", "--prepare"))
        point = self.home / "out/points" / self.points()[0]["name"]
        (point / "attempts.json").write_text(json.dumps({"attempts": 1, "failure": "bad luck"}), encoding="utf-8")
        other = self.sweep(ONE_POINT.replace("2000", "3000"))
        self.assertEqual((other.returncode, len(self.rows())), (0, 1), other)

    def test_the_copy_of_the_sweep_file_is_kept_when_it_changes(self):
        out = self.sweep_to_end(ONE_POINT)
        notes = ONE_POINT + "# my notes\n"
        self.write("out/sweep.yaml", notes)
        for _ in range(2):
            self.sweep_to_end(ONE_POINT)
            self.assertEqual((out / "sweep.yaml").read_text(encoding="utf-8"), ONE_POINT)
            self.assertEqual((out / "sweep.yaml.previous").read_text(encoding="utf-8"), notes)

    def test_runs_begin_from_the_files_of_the_plan_only(self):
        self.write("grains.csv", "x (mm), y (mm), vx (m/s), vy (m/s), diameter (mm)\n2, 2, 1, 0, 1\n")
        self.write("tube.yaml", """\
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.9}
tube: {width: 10 mm, length: 6 mm}
start: {kind: file, from: grains.csv}
""")
        text = "base: tube.yaml\nset: {run.duration: 1 ms}\naxes: {contact.friction: [0.1, 0.2]}\n"
        self.assert_done(self.sweep(text, "out", "--prepare"))
        self.assert_done(self.riesel("sweep-task", "out", 0))
        planned = (self.home / "grains.csv").read_text(encoding="utf-8")
        self.write("grains.csv", planned + "5, 5, 0, 0, 1\n")
        before = bytes_of_files(self.home)
        for command in (["sweep", "out"], ["sweep", "out", "--dry-run"], ["sweep-task", "out", 1]):
            self.assert_refused(self.riesel(*command), "grains.csv: is not as it was when the sweep was planned",
                                "with the sweep file and another --out")
        self.assertEqual(bytes_of_files(self.home), before)
        self.assert_done(self.riesel("sweep-task", "out", 0))  # it has begun, and reads the file no more
        self.write("grains.csv", planned)
        self.assert_done(self.riesel("sweep", "out"))
        self.assertEqual({row["grains"] for row in self.rows()}, {"1"})

    def test_the_directory_of_a_sweep_is_no_place_for_a_run(self):
        self.assert_done(self.sweep(ONE_POINT, "out", "--prepare"))
        before = bytes_of_files(self.home / "out")
        self.assert_refused(self.riesel("run", "tube.yaml", "--out", "out"), "out: holds a sweep", "--out")
        self.assertEqual(bytes_of_files(self.home / "out"), before)


class Mistakes(SweepTest):
    """One message that says where, which key, what is wrong and what to do; nothing written."""

    MISTAKES = {
        "": ["sweep.yaml:1:1:", "empty", "base:"],
        SMALL_TUBE: ["sweep.yaml:1:1: scenario: unknown key", "riesel run"],
        "axes: {seed: [1]}": ["sweep.yaml:1:1: base: is missing"],
        "base: nix.yaml": ["sweep.yaml:1:7: base: nix.yaml", "No such file", "relative to"],
        "base: tube.yaml\naxis: {seed: [1]}": [":2:1: axis: unknown key", "'axes'"],
        "base: tube.yaml\naxes: {contact.frictoin: [1]}": [
            ":2:8: contact.frictoin: unknown key", "'contact.friction'"],
        "base: tube.yaml\naxes: {contact.friction: []}": [":2:26: contact.friction:", "empty"],
        "base: tube.yaml\naxes: {contact.friction: 0.5}": [
            ":2:26: contact.friction: expected a list", "'set'"],
        "base: tube.yaml\naxes: {tube.width: [10 mm, 9 kg]}": [
            ":2:28: tube.width: expected a length", "'9 kg'"],
        "base: tube.yaml\naxes: {tube.width: [10 mm, 0.1 mm]}": [
            ":2:8: tube.width: the tube is too narrow", "tube.width above"],
        "base: tube.yaml\naxes: {tube.width: {from: 1 cm, to: 2, points: 3, spacing: lgo}}": [
            ":2:60: tube.width.spacing:", "did you mean 'log'?"],
        "base: tube.yaml\naxes: {contact: {friction: [1]}}": [":2:8: contact: is a section"],
        "base: tube.yaml\naxes: {scenario: [wall_array]}": [":2:8: scenario: cannot be changed"],
        "base: tube.yaml\naxes: [{seed: [1, 2], contact.friction: [0, 1, 2]}]": [
            ":2:41: contact.friction: has 3 values, but seed, which varies with it, has 2"],
        "base: tube.yaml\naxes: [{seed: [1]}, {seed: [2]}]": [
            "seed: is set twice", "sweep.yaml:2:9"],
        "base: tube.yaml\nset: {gravity: 0}\naxes: {gravity: [1]}": ["gravity: is set twice"],
        "base: tube.yaml\naxes: {}": [":2:7: axes: expected keys"],
        "base: tube.yaml\naxes: {run.stepping: [plain, windows]}": [
            ":2:8: run.stepping: changes no result", "leave it out"],
        "base: tube.yaml\nseeds: 0": [":2:8: seeds: must be from 1"],
        "base: tube.yaml\nseeds: []": [":2:8: seeds: the list is empty"],
        "base: tube.yaml\nseeds: [1, x]": [":2:12: seed: expected an integer"],
        "base: tube.yaml\nbranches: {slow: 1}": [":2:18: branches.slow: expected keys"],
        'base: tube.yaml\nbranches: {"": {}}': [":2:12: branches: a branch has no name"],
        "base: tube.yaml\nbranches: {slow: {start.axial: 1}}": [
            ":2:19: start.axial: unknown key"],
        "base: tube.yaml\nset: {contact: 1}": [":2:7: contact: is a section"],
        "base: tube.yaml\nset: {contact.impact_speed: 1}": [
            ":2:7: contact.impact_speed: has no effect when contact.law is linear"],
        "base: tube.yaml\ncontinue_along: seed": [":2:17: continue_along:", "an axis"],
        "base: tube.yaml\naxes: {tube.width: [1 cm, 2 cm]}\ncontinue_along: tube.width": [
            ":3:17: continue_along:", "tube.width", "the grains"],
        "base: tube.yaml\naxes: {seed: {from: 1, to: 3, points: 3, spacing: linear}}": [
            ":2:14: seed: only quantities"],
        "base: tube.yaml\nseeds: 2000\naxes: {gravity: [1, 2, 3, 4, 5, 6]}": [
            "more than 10000 points"],
    }

    def test_in_the_sweep_file(self):
        for text, mentions in self.MISTAKES.items():
            with self.subTest(text):
                self.write("sweep.yaml", text)
                before = bytes_of_files(self.home)
                self.assert_refused(self.riesel("sweep", "sweep.yaml"), *mentions)
                self.assert_nothing_written(before)

    def test_in_the_base(self):
        self.write("tube.yaml", SMALL_TUBE.replace("area_fraction", "area_fracton"))
        result = self.sweep(GRID)
        self.assert_refused(result, "tube.yaml:3:10: grains.area_fracton: unknown key")

    def test_on_the_command_line(self):
        self.write("sweep.yaml", GRID)
        for arguments, mention in ((["sweep"], "FILE"), (["sweep", "x.yaml"], "x.yaml"),
                                   (["sweep", "sweep.yaml", "--jobs", 0], "--jobs"),
                                   (["status"], "DIR"), (["sweep-task", "out"], "INDEX")):
            with self.subTest(arguments):
                result = self.riesel(*arguments)
                self.assertEqual(result.returncode, BAD_INPUT)
                self.assertIn(mention, result.stderr)
        self.assertFalse((self.home / "sweeps").exists())

    def test_options_of_running_are_refused_where_nothing_is_run(self):
        self.write("sweep.yaml", GRID)
        for options in (["--jobs", 2], ["--retry-failed"], ["--max-walltime", "1 h"]):
            self.assert_sweep_refuses(["--prepare"], options)

    def test_help_names_the_options(self):
        for command, options in {"sweep": ["FILE", "--out", "--jobs", "--dry-run", "--prepare",
                                           "--retry-failed"],
                                 "sweep-task": ["DIR", "INDEX", "--threads", "--retry-failed"],
                                 "status": ["DIR"], "collect": ["DIR"]}.items():
            result = self.riesel(command, "--help")
            self.assert_done(result)
            for option in options:
                self.assertIn(option, result.stdout)
            self.assertIn(f"  {command} ", self.riesel("--help").stdout)


class Shipped(SweepTest):

    def test_the_examples_of_the_manual_work(self):
        page = (SHIPPED.parent / "docs/sweeps.md").read_text(encoding="utf-8")
        examples = [text for text in re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
                    if "base:" in text]
        self.assertEqual(len(examples), 2)
        for number, text in enumerate(examples):
            self.sweep_to_end(text.replace("base: ", f"base: {SHIPPED.parent}/"), f"out{number}", "--jobs", 2)
            self.assertEqual({row["status"] for row in self.rows(f"out{number}")}, {"done"})
