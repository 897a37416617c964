"""riesel sweep: many runs from one file, each the run that `riesel run` would make."""

import re
import signal

import h5py

from riesel_command import FAILED, PATIENCE, SHIPPED, SMALL_TUBE, bytes_of_files
from sweep_command import CHAIN, GRID, ONE_FAILS, ONE_POINT, SweepTest

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

    def test_a_range_that_is_extended_has_its_points_again(self):
        """Also where rounding makes their last digits others."""
        for key, spacing, low, short, long in (
                ("contact.restitution", "linear", 0.8, (0.95, 4), (1.0, 5)),
                ("contact.restitution", "linear", 0.5, (0.7, 7), (0.9, 13)),
                ("contact.stiffness", "log", 1000, (1e5, 7), (1e6, 10)),
                ("start.axial_velocity", "linear", -0.3, (0.6, 10), (0.9, 13))):
            names, values = [], []
            for number, (high, points) in enumerate((short, long)):
                text = ("base: tube.yaml\nset: {run.duration: 1 ms}\n"
                        f"axes: {{{key}: {{from: {low}, to: {high}, points: {points}, spacing: {spacing}}}}}\n")
                out = f"{key}-{low}-{number}"
                self.assert_done(self.sweep(text, out, "--prepare"))
                names.append([point["name"] for point in self.points(out)])
                values.append([point["settings"][key] for point in self.points(out)])
            with self.subTest(key, low=low):
                self.assertEqual(names[1][:short[1]], names[0])
        self.assertEqual(values[0], [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6])

    def test_the_cores_are_those_of_the_machine_that_runs_it(self):
        """Not of the one that makes the plan, such as the login node of a cluster."""
        wide = "base: tube.yaml\nset: {run.duration: 0.1 ms, tube.width: 100 mm, tube.length: 100 mm}\nseeds: 1\n"
        self.write("sweep.yaml", wide + "axes: {contact.friction: [0.5]}\n")
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out", "--prepare", OMP_NUM_THREADS="1"))
        self.assert_done(self.riesel("sweep-task", "out", 0, "--threads", 2, OMP_NUM_THREADS="2"))
        self.assertEqual(self.summary(self.home / "out/points" / self.points()[0]["name"])["performance"]["threads"], 2)

    def test_a_branch_may_take_out_a_section(self):
        self.write("tube.yaml", SMALL_TUBE + "limits: {speed: 50 m/s, overlap: 0.4}\n")
        self.sweep_to_end("base: tube.yaml\nset: {run.duration: 1 ms}\nbranches: {bound: {}, free: {limits: }}\n")
        told = [[row[key] for key in ("branch", "limits.speed", "limits.overlap")] for row in self.rows()]
        self.assertEqual(told, [["bound", "50", "0.4"], ["free", "", ""]])
        self.assertNotIn("limits.action", self.rows()[0])

    def test_an_axis_may_set_again_what_is_taken_out_for_all(self):
        self.write("tube.yaml", SMALL_TUBE + "limits: {speed: 50 m/s, overlap: 0.4}\n")
        self.sweep_to_end("base: tube.yaml\nset: {run.duration: 1 ms, limits: }\n"
                          "axes: {limits.speed: [60 m/s, 70 m/s]}\n")
        self.assertEqual([row["limits.speed"] for row in self.rows()], ["60", "70"])

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

    def test_a_chain_may_go_where_its_first_start_could_not(self):
        self.write("tube.yaml", SMALL_TUBE.replace("area_fraction: 0.3", "area_fraction: 0.6"))
        self.run_to_end("tube.yaml", "soft", "--set", "contact.stiffness=200 N/m", "--set", "start.random_velocity=0.5 m/s")
        chain = ("base: tube.yaml\nset: {run.duration: 1 ms, start: , start.kind: continued, start.from: soft}\n"
                 "axes: {contact.stiffness: [200 N/m, 2 kN/m, 20 kN/m]}\n")
        self.assert_refused(self.sweep(chain, "out", "--dry-run"), "would release more energy")
        self.sweep_to_end(chain + "continue_along: contact.stiffness\n")
        self.assertEqual([row["status"] for row in self.rows()], ["done"] * 5)

    def test_a_chain_is_refused_if_its_neighbours_shake_differently(self):
        chain = ("base: tube.yaml\nset: {run.duration: 1 ms, wall.shake_frequency: 50, wall.shake_angle: 90 degrees}\n"
                 "axes: {wall.shake_amplitude: [0.1 mm, 0.2 mm]}\ncontinue_along: wall.shake_amplitude\n")
        self.assert_refused(self.sweep(chain, "out", "--dry-run"), "shakes the walls across with amplitude 0.0002 m")

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
        self.resume_to_end(earlier)  # has nothing to do
        self.sweep_to_end(text)
        self.assertEqual(self.points()[0]["name"], name)
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


class Shipped(SweepTest):

    def test_the_examples_of_the_manual_work(self):
        page = (SHIPPED.parent / "docs/sweeps.md").read_text(encoding="utf-8")
        examples = [text for text in re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
                    if "base:" in text]
        self.assertEqual(len(examples), 2)
        for number, text in enumerate(examples):
            self.sweep_to_end(text.replace("base: ", f"base: {SHIPPED.parent}/"), f"out{number}", "--jobs", 2)
            self.assertEqual({row["status"] for row in self.rows(f"out{number}")}, {"done"})
