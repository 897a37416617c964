"""riesel report: a page that stands alone and shows what a flow left."""

import json
import re
import shutil

import h5py
import numpy as np

from report_files import SVG, Report
from riesel_command import bytes_of_files, with_error

FIGURES = {"state", "mean_vy", "granular_temperature", "contacts", "max_overlap", "energy", "visits",
           "area_fraction", "velocity", "temperature", "stress", "braking",
           "grain_contact_duration", "grain_contact_overlap", "wall_contact_duration",
           "wall_contact_overlap"}


class FinishedRun(Report):

    @classmethod
    def setUpClass(cls):
        """One run and its report for all that only look at them."""
        maker = cls.maker()
        cls.out = maker.run_small_tube("a&b<c>")
        cls.before = bytes_of_files(cls.out)
        result = maker.riesel("report", "a&b<c>")
        maker.assert_done(result)
        cls.told = result.stdout
        cls.page = maker.page_of(cls.out)

    def test_it_adds_a_page_and_figures_and_changes_nothing_else(self):
        self.assertEqual(self.told, "a&b<c>/report.html\n")
        after = bytes_of_files(self.out)
        del after[".lock"], self.before[".lock"]
        self.assertEqual(set(after) - set(self.before),
                         {"report.html"} | {f"figures/{name}.svg" for name in FIGURES})
        self.assertEqual({name: after[name] for name in self.before}, self.before)

    def test_the_page_is_well_formed_and_stands_alone(self):
        self.assertEqual(self.page.mistakes, [])
        raw = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertNotRegex(raw, r"https?://|url\(|@import")
        names = {name for name, _ in self.page.elements}
        self.assertFalse(names & {"script", "link", "img", "iframe", "object", "a"}, names)
        for _, attributes in self.page.elements:
            self.assertFalse({"src", "href", "xlink:href"} & set(attributes), attributes)

    def test_texts_are_escaped(self):
        command = next(line for line in self.page.text.splitlines() if line.startswith("command"))
        self.assertIn("--out 'a&b<c>'", command)

    def test_the_result_is_told_with_its_error_and_its_verdicts(self):
        summary = self.summary(self.out)
        mean = summary["mean_axial_velocity"]
        self.assertIn(f"{with_error(mean)} m/s", self.page.text)
        temperature = summary["fluctuations"]["granular_temperature"]
        self.assertRegex(self.page.text, r"Mean axial velocity .* Granular temperature "
                         rf"{with_error(temperature)} m\^2/s\^2 \(68 % error bar\)\. State")
        self.assertIn("too_short: only 1 of the 20 independent samples", self.page.text)
        self.assertIn(f"{summary['grains']} grains", self.page.text)
        self.assertIn(summary["state_hash"], self.page.text)
        self.assertIn(summary["validity"]["verdict"].capitalize() + ":", self.page.text)
        for finding in summary["validity"]["findings"]:
            value = finding["value"]
            shown = "not known" if value is None else f"{value:.3g}"
            self.assertIn(finding["name"] + shown, self.page.text)  # two cells of a row
        for name in ("initial", "kinetic", "gravity_work", "normal_loss", "residual"):
            self.assertIn(f"{summary['energy'][name]:.4g}", self.page.text, name)

    def test_a_mean_that_is_not_steady_is_no_good_news(self):
        classes = [given.get("class") for name, given in self.page.elements if name == "p"]
        self.assertIn("doubtful", classes)
        self.assertIn("not to be used as a property of the flow", self.page.text)

    def test_every_grain_wall_grain_and_contact_is_drawn_once(self):
        with h5py.File(self.out / "run.h5", "r") as file:
            final = file["final"]
            self.assertEqual(self.page.shapes["grains"], final["radius"].shape[0])
            self.assertEqual(self.page.shapes["walls"], int(sum(final["walls/count"])))
            self.assertEqual(self.page.shapes.get("contacts", 0), final["contacts/grain"].shape[0])
            self.assertGreater(final["contacts/grain"].shape[0], 0)
            force = np.hypot(*final["contacts/force"][()].T)
        discs = self.figure(self.out, "state").findall(f"{SVG}g[@class='grains']/{SVG}circle")
        self.assertEqual(len(discs), self.page.shapes["grains"])
        lines = self.figure(self.out, "state").findall(f"{SVG}g[@class='contacts']/{SVG}line")
        np.testing.assert_allclose([float(line.get("stroke-width")) for line in lines],
                                   np.maximum(0.5, 6.0 * force / force.max()), atol=0.006)
        self.assertIn(f"up to {force.max():.4g} N; those below a twelfth", self.page.text)
        self.assertIn(f"All {self.page.shapes['grains']} grains", self.page.text)

    def test_the_discs_are_where_the_grains_are(self):
        """Up to one scale and shift for both axes; the faster the grain, the lighter its disc."""
        discs = self.figure(self.out, "state").findall(f"{SVG}g[@class='grains']/{SVG}circle")
        with h5py.File(self.out / "run.h5", "r") as file:
            position, radius = file["final/position"][()], file["final/radius"][()]
            speed = file["final/velocity"][()][:, 1]
        scale = float(discs[0].get("r")) / radius[0]
        for disc, (x, y), r in zip(discs, position, radius):
            self.assertAlmostEqual(float(disc.get("r")), scale * r, delta=0.05)
            for axis, here, first in (("cx", x, position[0][0]), ("cy", y, position[0][1])):
                moved = float(disc.get(axis)) - float(discs[0].get(axis))
                self.assertAlmostEqual(moved, scale * (here - first), delta=0.2)
        fills = [disc.get("fill") for disc in discs]
        self.assertEqual((fills[speed.argmin()], fills[speed.argmax()]), ("#241c5c", "#fae860"))

    def test_profiles_are_drawn_as_they_stand_in_the_file(self):
        with h5py.File(self.out / "run.h5") as run:
            known = {name: sum(value == value for value in run[f"profiles/{name}"])
                     for name in ("area_fraction", "mean_axial_velocity")}
        self.assertGreater(known["area_fraction"], 5)
        for name, figure in (("area_fraction", "area_fraction"), ("mean_axial_velocity", "velocity")):
            discs = sum(1 for _ in self.figure(self.out, figure).iter(f"{SVG}circle"))
            self.assertEqual(discs, known[name] + 1)  # and one in the legend

    def test_visits_are_drawn_as_a_histogram(self):
        """Bars as high as the counts, in their order."""
        counts = self.summary(self.out)["wall_visits"]["of_contacts_since_start"]
        self.assertGreater(sum(counts), 0)
        bars = self.figure(self.out, "visits").findall(f"{SVG}g[@class='bars']/{SVG}rect")
        heights = [float(bar.get("height")) for bar in bars]
        self.assertEqual(len(heights), len(counts))
        for height, count in zip(heights, counts):
            self.assertAlmostEqual(height / max(heights), count / max(counts), delta=1e-3)
        places = [float(bar.get("x")) for bar in bars]
        self.assertEqual(places, sorted(places))

    def bars_and_marks(self, name):
        """Of a histogram: (x, width, height) of its bars, and {label: x} of its marks."""
        root = self.figure(self.out, name)
        bars = [tuple(float(bar.get(key)) for key in ("x", "width", "height"))
                for bar in root.findall(f"{SVG}g[@class='bars']/{SVG}rect")]
        marks = root.find(f"{SVG}g[@class='marks']")
        places = [float(line.get("x1")) for line in marks.findall(f"{SVG}line")]
        labels = [text.text for text in marks.findall(f"{SVG}text")]
        return bars, dict(zip(labels, places))

    def test_histograms_of_contacts_are_drawn_as_they_stand_in_the_file(self):
        """A bar from edge to edge for each bin that is not empty, as high as the logarithm of its rate."""
        for name in ("grain_contact_duration", "grain_contact_overlap", "wall_contact_overlap"):
            with h5py.File(self.out / "run.h5") as run:
                rates = run[f"histograms/{name}/rate"][()]
                edges = np.log(run[f"histograms/{name}/lower_edge"][()])
            filled = np.flatnonzero(rates > 0.0)
            self.assertGreater(len(filled), 3, name)
            x, width, height = np.array(self.bars_and_marks(name)[0]).T
            self.assertEqual(len(x), len(filled), name)
            for drawn, expected in ((x, edges[filled]), (x + width, edges[filled + 1]),
                                    (height, np.log(rates[filled]))):
                if np.ptp(expected) > 0.0:
                    slope, offset = np.polyfit(expected, drawn, 1)
                    self.assertGreater(slope, 0.0)
                    np.testing.assert_allclose(drawn, slope * expected + offset, atol=0.05)

    def test_marks_further_right_are_higher(self):
        """So that no line crosses a label. With few steps per t_col ten of them come last."""
        for steps, last in ((50, "t_col"), (6, "10 steps")):
            out = self.run_small_tube(f"marks_{steps}", "--set", f"run.steps_per_collision={steps}")
            self.assert_done(self.riesel("report", out))
            marks = self.figure(out, "wall_contact_duration").find(f"{SVG}g[@class='marks']")
            heights = [float(text.get("y")) for text in marks.findall(f"{SVG}text")]
            places = [float(line.get("x1")) for line in marks.findall(f"{SVG}line")]
            self.assertEqual(marks.findall(f"{SVG}text")[places.index(max(places))].text, last)
            by_place = [height for _, height in sorted(zip(places, heights, strict=True))]
            self.assertEqual(by_place, sorted(heights, reverse=True), steps)

    def test_t_col_and_the_thresholds_are_marked_where_they_are(self):
        summary = self.summary(self.out)
        t_col = summary["validity"]["t_col"]
        step = summary["time"] / summary["steps"]
        with h5py.File(self.out / "run.h5") as run:
            radius, wall = run["final/radius"][()], run["final/walls/radius"][0]
            edges = {name: run[f"histograms/{name}/lower_edge"][()] for name in run["histograms"]}
            filled = {name: np.flatnonzero(run[f"histograms/{name}/rate"][()] > 0.0)
                      for name in run["histograms"]}
        limits = {"suspect": 0.2, "unphysical": 0.5}
        of_grains, of_walls = radius.min() / (2 * radius.mean()), wall / (wall + radius.mean())
        for name, expected in {
                "grain_contact_duration": {"10 steps": 10 * step, "t_col": t_col["grains"]},
                "wall_contact_duration": {"10 steps": 10 * step, "t_col": t_col["walls"],
                                          "cut short below": 0.639 * t_col["walls"]},
                "grain_contact_overlap": {key: of_grains * limits[key] for key in limits},
                "wall_contact_overlap": {key: of_walls * limits[key] for key in limits}}.items():
            bars, marks = self.bars_and_marks(name)
            self.assertEqual(set(marks), set(expected), name)
            known = np.log(edges[name][filled[name]])
            values = np.concatenate([known, np.log(edges[name][filled[name] + 1])])
            places = np.concatenate([[bar[0] for bar in bars], [bar[0] + bar[1] for bar in bars]])
            slope, offset = np.polyfit(values, places, 1)
            for label, value in expected.items():
                self.assertAlmostEqual(marks[label], slope * np.log(value) + offset, delta=1.0,
                                       msg=f"{name}: {label}")
        self.assertAlmostEqual(t_col["walls"] / t_col["grains"], 2 ** 0.5, delta=0.02)
        for partners, told in (("between grains", "between two grains of the mean mass"),
                               ("of grains with walls", "of a grain of the mean mass with a wall")):
            self.assertIn(f"How long contacts {partners} last. t_col: a head-on contact {told}.", self.page.text)

    def test_the_braking_of_each_wall_is_told_and_drawn(self):
        braking = self.summary(self.out)["braking_force"]
        for wall in ("left", "right"):
            force = braking[wall]
            self.assertIn(f"braking force of the {wall} wall{with_error(force)} N",
                          self.page.text)
        curves = self.figure(self.out, "braking").findall(f"{SVG}g[@class='curve']/{SVG}polyline")
        self.assertEqual([len(curve.get("points").split()) for curve in curves], [5, 5, 5])

    def test_why_it_ended_is_told(self):
        self.assertIn("The run ended (duration): its duration was over.", self.page.text)

    def test_the_figures_stand_alone_too(self):
        for name in FIGURES:
            root = self.figure(self.out, name)
            self.assertEqual(root.tag, f"{SVG}svg")
            self.assertTrue(root.find(f"{SVG}title").text, name)

    def test_settings_and_origin_are_told(self):
        self.assertIn((self.out / "effective.yaml").read_text(encoding="utf-8"), self.page.text)
        with h5py.File(self.out / "run.h5", "r") as file:
            for name in ("date", "riesel_version", "git_commit", "command"):
                self.assertIn(file["provenance"][name][()].decode(), self.page.text)


class OtherRuns(Report):

    def test_the_same_run_gives_the_same_bytes_wherever_it_lies(self):
        one = self.run_small_tube("one", "--set", "run.duration=0.2 ms")
        self.report_on(one)
        first = bytes_of_files(one)
        shutil.copytree(one, self.home / "other")
        self.report_on(one)
        self.report_on(self.home / "other")
        for directory in (one, self.home / "other"):
            again = bytes_of_files(directory)
            for name in ["report.html"] + [f"figures/{figure}.svg" for figure in FIGURES]:
                self.assertEqual(first[name], again[name], name)

    def test_a_long_tube_is_cut_into_columns_and_the_page_says_so(self):
        out = self.run_small_tube("long", "--set", "run.duration=0.01 ms", "--set",
                                  "tube.length=60 mm")
        page = self.report_on(out)
        columns = int(re.search(r"cut into (\d+) columns", page.text).group(1))
        self.assertGreater(columns, 1)
        self.assertEqual(page.shapes["grains"], self.summary(out)["grains"])
        figure = self.figure(out, "state")
        self.assertLess(float(figure.get("width")), 1000.0)
        self.assertLess(float(figure.get("height")), 800.0)

    def test_of_a_very_long_tube_a_part_is_shown_and_the_page_says_which(self):
        out = self.run_small_tube("very-long", "--set", "run.duration=1 us", "--set",
                                  "tube.length=3 m")
        page = self.report_on(out)
        shown, drawn, grains = re.search(
            r"Only a part of the flow, ([\d.]+) mm of 3000 mm from y = 0 on: (\d+) of (\d+) grains",
            page.text).groups()
        with h5py.File(out / "run.h5", "r") as file:
            y = file["final/position"][:, 1]
        self.assertEqual(int(grains), len(y))
        self.assertEqual(page.shapes["grains"], int(drawn))
        self.assertLess(abs(int(drawn) - (y < float(shown) * 1e-3).sum()), 3)  # its digits
        self.assertLess(int(drawn), int(grains))
        self.assertGreater(int(drawn), 1000)

    def test_profiles_stay_within_their_axes_where_errors_are_not_known(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        self.report_on(out)
        with h5py.File(out / "run.h5") as run:
            self.assertTrue(np.isnan(run["profiles/mean_axial_velocity_error"][()]).all())
        for name in ("area_fraction", "velocity", "temperature", "stress"):
            root = self.figure(out, name)
            places = [float(disc.get("cy")) for disc in root.iter(f"{SVG}circle")]
            self.assertGreater(len(places), 5, name)
            self.assertGreaterEqual(min(places), 0.0, name)
            self.assertLessEqual(max(places), float(root.get("height")), name)

    def test_a_run_that_asked_for_precision_tells_why_it_ended(self):
        out = self.run_small_tube("out", "--set", "run.duration=", "--set",
                                  "run.until.relative_error=1 %", "--set", "run.until.at_most=0.2 ms")
        self.assertIn("The run ended (at_most): the time was up", self.report_on(out).text)

    def test_an_error_has_two_digits_also_where_rounding_carries(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        for error, told in ((0.0996, "1.50 ± 0.10 m/s"), (0.0994, "1.500 ± 0.099 m/s"), (0.996, "1.5 ± 1.0 m/s")):
            summary = {**self.summary(out), "mean_axial_velocity": {"value": 1.5, "error": error}}
            (out / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
            self.assertIn(f"Mean axial velocity {told} after", self.report_on(out).text)

    def test_figures_of_an_earlier_report_do_not_stay(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.2 ms")
        self.report_on(out)
        figures = out / "figures"
        shutil.copy(figures / "energy.svg", figures / "of_another_time.svg")
        mine = {"notes.txt": "mine", "drawn.svg": "<svg/>"}
        for name, text in mine.items():
            (figures / name).write_text(text, encoding="utf-8")
        self.report_on(out)
        self.assertEqual({path.name for path in figures.iterdir()},
                         {f"{name}.svg" for name in FIGURES} | set(mine))

    def test_pages_and_figures_of_others_are_not_overwritten(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.2 ms")
        (out / "figures").mkdir()
        for name in ("report.html", "figures/energy.svg"):
            with self.subTest(name):
                (out / name).write_text("mine", encoding="utf-8")
                before = bytes_of_files(out)
                self.assert_refused(self.riesel("report", out), f"out/{name}", "rename it")
                self.assertEqual(before, bytes_of_files(out) | {".lock": before[".lock"]})
                if name == "report.html":
                    self.resume_to_end(out, "--set", "run.duration=0.3 ms")
                    self.assertEqual((out / name).read_text(encoding="utf-8"), "mine")
                (out / name).unlink()
        self.report_on(out)

    def test_a_resumed_run_tells_of_both_parts(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        self.resume_to_end(out, "--set", "run.duration=0.2 ms")
        page = self.report_on(out)
        self.assertIn("resume 1: command", page.text)
        self.assertIn("run.duration=0.2 ms", page.text)  # in the command
        self.assertIn((out / "effective.yaml").read_text(encoding="utf-8"), page.text)


class OtherVersions(Report):

    def test_a_run_of_another_version_with_the_same_format_says_what_it_said(self):
        """The verdict is that of the file, although its thresholds and those of this version say otherwise."""
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        summary = {**self.summary(out), "version": "7.8.9"}
        finding = summary["validity"]["findings"][0]
        self.assertEqual(finding["verdict"], "valid")
        finding.update(suspect=0.4, verdict="suspect")
        summary["validity"]["verdict"] = "suspect"
        (out / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
        page = self.report_on(out)
        self.assertIn("Suspect:", page.text)
        self.assertIn("suspect: max_overlap_ratio = ", page.text)
        self.assertIn("above 0.4", page.text)
