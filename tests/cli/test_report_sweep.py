"""riesel report of a sweep: its points in figures and in a table, with the way to their runs."""

import json
import math
import re
import shutil

from report_files import SVG, Report
from riesel_command import SHIPPED, SMALL_TUBE, bytes_of_files, with_error
from sweep_command import ONE_FAILS

GRID = """\
base: tube.yaml
set: {run.duration: 1 ms}
axes:
  contact.restitution: [0.7, 0.8, 0.9]
branches:
  slow: {start.axial_velocity: 1 m/s}
  fast: {start.axial_velocity: 4 m/s}
seeds: 2
"""

CHAIN = """\
base: tube.yaml
set: {run.duration: 1 ms}
axes:
  contact.friction: [0.1, 0.2, 0.3, 0.4]
  contact.restitution: [0.7, 0.8, 0.9]
continue_along: contact.restitution
"""

# Nine curves over the damping: one too many for a figure.
MANY = """\
base:
  scenario: periodic_tube
  grains: {area_fraction: 0.1}
  tube: {width: 5 mm, length: 5 mm}
  run: {duration: 5 us}
axes:
  contact.stiffness: [1000 N/m, 2000 N/m, 3000 N/m]
  contact.friction: [0.1, 0.2, 0.3]
  contact.damping: [1 1/s, 10 1/s, 100 1/s, 1000 1/s]
"""

SHEAR_CELL = """\
base:
  scenario: shear_cell
  contact: {stiffness: 2000 N/m, restitution: 0.9}
  grains: {area_fraction: 0.3}
  cell: {width: 10 mm, length: 10 mm}
  run: {duration: 5 ms}
axes: {cell.velocity: [1 m/s, 2 m/s]}
"""

IMPACTS = """\
base: wall.yaml
set: {impact.axial_velocity: {from: 0.3 m/s, to: 30 m/s, points: 5, spacing: log}}
axes: {contact.stiffness: [2000 N/m, 200 kN/m]}
"""


class SweepReport(Report):

    def sweep(self, text, out="out", status=0):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("wall.yaml",
                   (SHIPPED / "single_wall_grain.yaml").read_text(encoding="utf-8"))
        self.write("sweep.yaml", text)
        result = self.riesel("sweep", "sweep.yaml", "--out", out)
        self.assertEqual(result.returncode, status, result)
        return self.home / out

    def points(self, sweep):
        return json.loads((sweep / "manifest.json").read_text(encoding="utf-8"))["points"]

    def point_directories(self, sweep):
        return [sweep / "points" / point["name"] for point in self.points(sweep)]

    def change(self, point, **values):
        """Of the summary of a point."""
        summary = {**self.summary(point), **values}
        (point / "summary.json").write_text(json.dumps(summary), encoding="utf-8")

    def links(self, sweep, figure="mean_axial_velocity"):
        """The points of a figure: {name of the run: (element, what is said of it)}."""
        return {re.search("points/([0-9a-f]{16})/", link.get("href")).group(1):
                (link, link.find(f"{SVG}title").text)
                for link in self.figure(sweep, figure).iter(f"{SVG}a")}


def centre_of(link):
    """Of the symbol in a link; error bars are lines."""
    shape = next(child for child in link if child.tag in (f"{SVG}circle", f"{SVG}rect"))
    if shape.tag == f"{SVG}circle":
        return float(shape.get("cx")), float(shape.get("cy"))
    return tuple(float(shape.get(place)) + 0.5 * float(shape.get(size))
                 for place, size in (("x", "width"), ("y", "height")))


class FinishedSweep(SweepReport):

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        cls.sweep_directory = maker.sweep(GRID)
        cls.reported = maker.point_directories(cls.sweep_directory)[3]
        maker.report_on(cls.reported)
        cls.before = bytes_of_files(cls.sweep_directory)
        cls.page = maker.report_on(cls.sweep_directory)

    def test_it_adds_a_page_and_a_figure_and_changes_nothing_else(self):
        after = bytes_of_files(self.sweep_directory)
        self.assertEqual(set(after) - set(self.before),
                         {"report.html", "figures/mean_axial_velocity.svg"})
        self.assertEqual({name: after[name] for name in self.before}, self.before)

    def test_the_page_is_well_formed_and_leads_to_files_that_are_there(self):
        self.assertEqual(self.page.mistakes, [])
        raw = (self.sweep_directory / "report.html").read_text(encoding="utf-8")
        self.assertNotRegex(raw, r"https?://|url\(|@import|<script|<img|<link")
        links = [given["href"] for name, given in self.page.elements if name == "a"]
        self.assertEqual(len(links), 12 + 12 + 1)  # in the figure, in the table, and the report
        roles = [given["role"] for name, given in self.page.elements if name == "svg"]
        self.assertEqual(roles, ["group"])  # an image would hide its links from a screen reader
        for link in links:
            self.assertTrue((self.sweep_directory / link).exists(), link)
        self.assertEqual(sum(link.endswith(f"{self.reported.name}/report.html") for link in links), 2)

    def test_every_point_is_in_the_table_with_its_error_and_its_verdicts(self):
        for point in self.points(self.sweep_directory):
            summary = self.summary(self.sweep_directory / "points" / point["name"])
            mean, settings = summary["mean_axial_velocity"], point["settings"]
            self.assertIn(point["name"] + f"{settings['contact.restitution']:g}"
                          f"{settings['start.axial_velocity']:g}{settings['seed']:g}"
                          + point["branch"] + with_error(mean)
                          + summary["state"] + summary["validity"]["verdict"], self.page.text)

    def test_each_point_of_the_figure_is_where_its_velocity_is(self):
        """On linear axes, that is up to a scale and a shift for each axis."""
        seen = []
        links = self.links(self.sweep_directory)
        for point in self.points(self.sweep_directory):
            link, tip = links[point["name"]]
            mean = self.summary(self.sweep_directory / "points" / point["name"])[
                "mean_axial_velocity"]
            self.assertIn(f"restitution {point['settings']['contact.restitution']:g}", tip)
            self.assertIn(f"{point['branch']}: {with_error(mean)} m/s", tip)
            seen.append((point["settings"]["contact.restitution"], mean["value"], *centre_of(link)))
        low, high = min(seen, key=lambda p: p[1]), max(seen, key=lambda p: p[1])
        left, right = min(seen), max(seen)
        for x, velocity, across, down in seen:
            self.assertAlmostEqual((across - left[2]) / (right[2] - left[2]),
                                   (x - left[0]) / (right[0] - left[0]), delta=1e-3)
            self.assertAlmostEqual((down - low[3]) / (high[3] - low[3]),
                                   (velocity - low[1]) / (high[1] - low[1]), delta=1e-3)

    def test_error_bars_are_as_long_as_the_errors(self):
        """On the scale of the velocities."""
        links = self.links(self.sweep_directory)
        lengths, errors = [], []
        for point in self.points(self.sweep_directory):
            bar = links[point["name"]][0].find(f"{SVG}line")
            lengths.append(abs(float(bar.get("y2")) - float(bar.get("y1"))))
            errors.append(self.summary(self.sweep_directory / "points" / point["name"])[
                "mean_axial_velocity"]["error"])
        for length, error in zip(lengths, errors):
            self.assertAlmostEqual(length / max(lengths), error / max(errors), delta=0.01)

    def test_a_curve_for_each_branch_and_a_line_for_each_seed(self):
        root = self.figure(self.sweep_directory, "mean_axial_velocity")
        legend = [text.text for text in root.findall(f"{SVG}g[@class='legend']/{SVG}text")]
        self.assertEqual(legend, ["slow", "fast"])
        lines = root.findall(f"{SVG}g[@class='curve']/{SVG}polyline")
        self.assertEqual([len(line.get("points").split()) for line in lines], [3, 3, 3, 3])
        self.assertEqual(len({line.get("stroke") for line in lines}), 2)

    def test_it_stands_wherever_it_lies(self):
        elsewhere = self.home / "elsewhere"
        shutil.copytree(self.sweep_directory, elsewhere)
        self.report_on(elsewhere)
        for name in ("report.html", "figures/mean_axial_velocity.svg"):
            self.assertEqual((elsewhere / name).read_bytes(),
                             (self.sweep_directory / name).read_bytes(), name)


class Marks(SweepReport):
    """What verdicts look like, in summaries that say so."""

    @classmethod
    def setUpClass(cls):
        cls.made = cls.maker().sweep(GRID)

    def copy(self):
        return shutil.copytree(self.made, self.home / "out")

    def test_error_bars_larger_than_what_they_belong_to_are_whole(self):
        sweep = self.copy()
        point, *others = self.point_directories(sweep)
        for other in others:
            self.change(other, mean_axial_velocity={"value": 1.0, "error": 0.5})
        self.change(point, mean_axial_velocity={"value": 1.0, "error": 2.0})
        self.report_on(sweep)
        lengths = {name: abs(float(bar.get("y2")) - float(bar.get("y1")))
                   for name, (link, _) in self.links(sweep).items() if (bar := link.find(f"{SVG}line")) is not None}
        self.assertAlmostEqual(lengths.pop(point.name) / max(lengths.values()), 4.0, delta=0.05)

    def test_full_open_arrow_and_cross(self):
        sweep = self.copy()
        directories = self.point_directories(sweep)
        steady, accelerating, unphysical = directories[:3]
        self.change(steady, state="steady")
        mean = {**self.summary(accelerating)["mean_axial_velocity"], "error": None}
        self.change(accelerating, state="accelerating", mean_axial_velocity=mean)
        for point in directories:
            verdict = "unphysical" if point == unphysical else "valid"
            self.change(point, validity={**self.summary(point)["validity"], "verdict": verdict})
        page = self.report_on(sweep)
        self.assertIn("1 accelerating, 1 steady, 10 too_short", page.text)
        self.assertIn("1 unphysical, 11 valid", page.text)
        self.assertIn(f"{mean['value']:.4g} (error not known)accelerating", page.text)
        links = self.links(sweep)
        for point in directories:
            link, _ = links[point.name]
            symbol = next(child for child in link if child.tag in (f"{SVG}circle", f"{SVG}rect"))
            self.assertEqual(symbol.get("fill") == symbol.get("stroke"), point == steady)
            self.assertEqual(link.find(f"{SVG}polygon") is not None, point == accelerating)
            crosses = [line for line in link.findall(f"{SVG}line")
                       if line.get("x1") != line.get("x2") and line.get("y1") != line.get("y2")]
            self.assertEqual(len(crosses), 2 if point == unphysical else 0)
            bars_and_arrows = [line for line in link.findall(f"{SVG}line")
                               if line.get("x1") == line.get("x2")]
            self.assertEqual(len(bars_and_arrows), 1)  # an arrow has no bar beside it

    def test_velocities_of_different_size_have_a_logarithmic_axis(self):
        sweep = self.copy()
        directories = self.point_directories(sweep)
        for i, point in enumerate(directories):
            self.change(point, mean_axial_velocity={"value": 0.1 * 10.0**(i % 3), "error": None})
        self.report_on(sweep)
        links = self.links(sweep)
        places = [centre_of(links[point.name][0])[1] for point in directories[:3]]
        self.assertAlmostEqual(places[0] - places[1], places[1] - places[2], delta=0.02)
        self.assertGreater(places[0] - places[1], 50.0)
        self.assertIsNone(links[directories[0].name][0].find(f"{SVG}line"))  # error not known

    def test_a_velocity_that_is_not_known_is_in_the_table_alone(self):
        sweep = self.copy()
        point = self.point_directories(sweep)[0]
        self.change(point, mean_axial_velocity={"value": None, "error": None})
        page = self.report_on(sweep)
        link, tip = self.links(sweep)[point.name]
        self.assertEqual([child.tag for child in link], [f"{SVG}title"])
        self.assertIn("not known", tip)
        self.assertRegex(page.text, point.name + "[^\n]*not known")

    def test_a_point_that_cannot_be_read_is_told_and_the_others_are_shown(self):
        sweep = self.copy()
        point = self.point_directories(sweep)[0]
        self.change(point, format=99)
        page = self.report_on(sweep)
        self.assertIn("has format 99", page.text)
        self.assertEqual(len(self.links(sweep)), 11)


class OtherSweeps(SweepReport):

    def test_a_continuation_shows_both_legs_along_its_axis(self):
        """Although the friction has more values."""
        sweep = self.sweep(CHAIN)
        page = self.report_on(sweep)
        root = self.figure(sweep, "mean_axial_velocity")
        lines = root.findall(f"{SVG}g[@class='curve']/{SVG}polyline")
        self.assertEqual(sorted((line.get("stroke-dasharray") or "", len(line.get("points").split()))
                                for line in lines), [("", 3)] * 4 + [("5 4", 2)] * 4)
        self.assertIn("contact.restitution", [text.text for text in root.iter(f"{SVG}text")])
        self.assertIn("dashed: the way back", page.text)

    def test_curves_that_are_too_many_for_one_figure_are_parted(self):
        sweep = self.sweep(MANY)
        page = self.report_on(sweep)
        names = sorted(path.name for path in (sweep / "figures").iterdir())
        self.assertEqual(names, [f"mean_axial_velocity_{i}.svg" for i in (1, 2, 3)])
        for i, stiffness in ((1, 1000), (2, 2000), (3, 3000)):
            self.assertIn(f"\nstiffness {stiffness} N/m\n", page.text)
            legend = self.figure(sweep, f"mean_axial_velocity_{i}").findall(
                f"{SVG}g[@class='legend']/{SVG}text")
            self.assertEqual([text.text for text in legend],
                             [f"stiffness {stiffness} N/m"]
                             + [f"friction {mu}" for mu in (0.1, 0.2, 0.3)])

    def test_points_that_failed_are_told_with_their_reason(self):
        sweep = self.sweep(ONE_FAILS, status=1)
        page = self.report_on(sweep)
        self.assertIn("3 points: 2 done, 1 failed.", page.text)
        self.assertRegex(page.text, "failed: .*grain")
        self.assertEqual(len(self.links(sweep)), 2)

    def test_flows_without_gravity_are_told_by_what_is_judged(self):
        sweep = self.sweep(SHEAR_CELL)
        page = self.report_on(sweep)
        self.assertEqual([path.name for path in (sweep / "figures").iterdir()], ["granular_temperature.svg"])
        links = self.links(sweep, "granular_temperature")
        for point in self.points(sweep):
            summary = self.summary(sweep / "points" / point["name"])
            temperature = with_error(summary["fluctuations"]["granular_temperature"])
            self.assertIn(f"{temperature} m^2/s^2, {summary['state']}", links[point["name"]][1])
            self.assertIn(temperature + summary["state"], page.text)

    def test_without_gravity_nothing_is_compared_with_it(self):
        sweep = self.sweep(SHEAR_CELL)
        page = self.report_on(sweep)
        self.assertEqual(page.mistakes, [])
        self.assertIn("brake failure", page.text)
        self.assertNotIn("n_dot dv_y / g", page.text)
        self.assertNotIn("inf ±", page.text)

    def test_a_sweep_file_with_line_ends_of_windows_is_shown_without_them(self):
        text = "base: tube.yaml\nset: {run.duration: 0.1 ms}\naxes: {contact.friction: [0.1, 0.2]}\n"
        page = self.report_on(self.sweep(text.replace("\n", "\r\n")))
        self.assertIn(text, page.text)
        self.assertNotIn("\N{REPLACEMENT CHARACTER}", page.text)

    def test_impacts_are_drawn_as_in_the_paper(self):
        sweep = self.sweep(IMPACTS)
        page = self.report_on(sweep)
        self.assertEqual(page.mistakes, [])
        self.assertEqual({path.name for path in (sweep / "figures").iterdir()},
                         {"dv_y.svg", "contacts.svg"})
        root = self.figure(sweep, "dv_y")
        legend = [text.text for text in root.findall(f"{SVG}g[@class='legend']/{SVG}text")]
        self.assertEqual(legend, ["v_x 0 m/s", "stiffness 2000 N/m", "stiffness 200000 N/m"])
        for point in self.point_directories(sweep):
            verdicts = [p["verdict"] for p in self.summary(point)["curve"]]
            self.assertRegex(page.text, rf"{point.name}\d+(5|15)0{verdicts.count('valid')} valid")
        self.assertIn("errors of the time step", page.text)
        drawn = [tuple(map(float, place.split(",")))
                 for line in root.findall(f"{SVG}g[@class='curve']/{SVG}polyline")
                 for place in line.get("points").split()]
        across = sorted({x for x, _ in drawn})
        self.assertEqual(len(across), 5)  # equally far apart on a logarithmic axis
        for a, b in zip(across, across[1:]):
            self.assertTrue(math.isclose(b - a, across[1] - across[0], rel_tol=1e-3))

    def test_a_branch_without_a_name_has_a_curve_too(self):
        sweep = self.sweep(GRID)
        manifest = json.loads((sweep / "manifest.json").read_text(encoding="utf-8"))
        for point in manifest["points"]:
            if point["branch"] == "slow":
                point["branch"] = ""
        (sweep / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
        self.report_on(sweep)
        legend = self.figure(sweep, "mean_axial_velocity").findall(f"{SVG}g[@class='legend']/{SVG}text")
        self.assertEqual({text.text.split(", ")[-1] for text in legend}, {"-", "fast"})

    def test_a_sweep_without_results_is_refused(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("sweep.yaml", GRID)
        self.assert_done(self.riesel("sweep", "sweep.yaml", "--out", "out", "--prepare"))
        before = bytes_of_files(self.home)
        self.assert_refused(self.riesel("report", "out"), "has no point with a result",
                            "riesel status out")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_a_manifest_that_is_damaged_is_refused(self):
        (self.home / "out").mkdir()
        (self.home / "out" / "manifest.json").write_text("{}", encoding="utf-8")
        self.assert_refused(self.riesel("report", "out"), "out/manifest.json")
