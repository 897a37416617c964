"""riesel report: a page that stands alone, shows what the run left, and is refused where there is
nothing to show."""

import html.parser
import re
import shutil
import xml.etree.ElementTree

import h5py

from riesel_command import SHIPPED, CommandTest, bytes_of_files

VOID_ELEMENTS = {"meta", "br", "hr", "img", "link", "input"}
FIGURES = {"state", "mean_vy", "granular_temperature", "contacts", "max_overlap", "energy"}
SVG = "{http://www.w3.org/2000/svg}"


class Page(html.parser.HTMLParser):
    """Elements and text of a page; an element that is not closed in its place is a mistake."""

    def __init__(self, text):
        super().__init__()
        self.elements, self.open, self.text, self.mistakes = [], [], "", []
        self.shapes = {}  # class of the group: number of shapes
        self.feed(text)
        self.close()
        self.mistakes += [f"<{name}> is left open" for name, _ in self.open]

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        groups = [given.get("class") for name, given in self.open if name == "g"]
        if groups and tag in ("circle", "line"):
            self.shapes[groups[-1]] = self.shapes.get(groups[-1], 0) + 1
        if tag not in VOID_ELEMENTS:
            self.open.append((tag, attributes))

    def handle_endtag(self, tag):
        if not self.open or self.open[-1][0] != tag:
            self.mistakes.append(f"</{tag}> closes nothing")
        else:
            self.open.pop()

    def handle_data(self, data):
        self.text += data


class Report(CommandTest):

    def page_of(self, directory):
        return Page((directory / "report.html").read_text(encoding="utf-8"))

    def report_on(self, directory):
        self.assert_done(self.riesel("report", directory))
        return self.page_of(directory)

    def figure(self, directory, name):
        return xml.etree.ElementTree.parse(directory / "figures" / f"{name}.svg").getroot()

    def discs(self, directory):
        """Number of discs of grains in the figure of the state."""
        return len(self.figure(directory, "state").findall(f"{SVG}g[@class='grains']/{SVG}circle"))


class FinishedRun(Report):

    @classmethod
    def setUpClass(cls):
        """One run and its report for all that only look at them."""
        maker = Report()
        maker.setUp()
        cls.addClassCleanup(maker.doCleanups)
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
        self.assertIn(f"{mean['value']:.4g} ± {mean['error']:.2g} m/s", self.page.text)
        self.assertIn("too_short: too few independent samples", self.page.text)
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
        self.assertEqual(self.discs(self.out), self.page.shapes["grains"])
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
            r"Only a part of the tube, ([\d.]+) mm of 3000 mm from y = 0 on: (\d+) of (\d+) grains",
            page.text).groups()
        with h5py.File(out / "run.h5", "r") as file:
            y = file["final/position"][:, 1]
        self.assertEqual(int(grains), len(y))
        self.assertEqual(page.shapes["grains"], int(drawn))
        self.assertLess(abs(int(drawn) - (y < float(shown) * 1e-3).sum()), 3)  # its digits
        self.assertLess(int(drawn), int(grains))
        self.assertGreater(int(drawn), 1000)

    def test_a_resumed_run_tells_of_both_parts(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        self.resume_to_end(out, "--set", "run.duration=0.2 ms")
        page = self.report_on(out)
        self.assertIn("resume 1: command", page.text)
        self.assertIn("run.duration=0.2 ms", page.text)  # in the command
        self.assertIn((out / "effective.yaml").read_text(encoding="utf-8"), page.text)


class Refused(Report):

    def assert_no_report(self, directory, *mentions):
        before = bytes_of_files(self.home)
        before.pop(f"{directory}/.lock", None)
        self.assert_refused(self.riesel("report", directory), *mentions)
        after = bytes_of_files(self.home)
        after.pop(f"{directory}/.lock", None)
        self.assertEqual(before, after)

    def test_where_there_is_no_run(self):
        self.assert_no_report("nowhere", "nowhere", "holds no run", "riesel run")
        (self.home / "empty").mkdir()
        self.assert_no_report("empty", "holds no run")

    def test_a_sweep(self):
        (self.home / "sweep").mkdir()
        (self.home / "sweep" / "manifest.json").write_text("{}", encoding="utf-8")
        self.assert_no_report("sweep", "holds a sweep", "points/")

    def test_a_run_of_impacts(self):
        self.run_to_end(SHIPPED / "single_wall_grain.yaml", "wall")
        self.assert_no_report("wall", "wall/summary.json", "impact")

    def test_a_run_that_is_not_over(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        (out / "summary.json").unlink()
        self.assert_no_report("out", "has not come to its end", "riesel resume out")

    def test_files_that_are_damaged_or_not_of_one_run(self):
        short = self.run_small_tube("short", "--set", "run.duration=0.1 ms")
        longer = self.run_small_tube("longer", "--set", "run.duration=0.2 ms")
        run_file, summary = short / "run.h5", short / "summary.json"
        whole = {path: path.read_bytes() for path in (run_file, summary)}
        for path, content, mention in (
                (run_file, whole[run_file][:len(whole[run_file]) // 2], "short/run.h5: is damaged"),
                (run_file, b"", "short/run.h5: is damaged"),
                (run_file, (longer / "run.h5").read_bytes(), "short/run.h5: is of another run"),
                (summary, whole[summary][:100], "short/summary.json: is damaged"),
                (summary, b"{}", "short/summary.json: is damaged")):
            with self.subTest(mention):
                path.write_bytes(content)
                self.assert_no_report("short", mention)
                path.write_bytes(whole[path])

    def test_a_report_that_cannot_be_written_is_a_failure_and_leaves_the_run_alone(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        (out / "figures").write_text("in the way", encoding="utf-8")
        before = bytes_of_files(out)
        result = self.riesel("report", out)
        self.assert_failed(result, "out/figures")
        after = bytes_of_files(out)
        del before[".lock"], after[".lock"]
        self.assertEqual(before, after)

