"""The pages of riesel report in a real browser, loaded from the disk: they fetch nothing and complain of nothing, all
figures are laid out, and nothing sticks out of its place, in a wide and in a narrow window, by day and by night.

Skipped where there is no Chromium (./setup.sh browser installs it)."""

import io
import sys
import unittest
from urllib.parse import unquote, urlparse

import matplotlib.image

import browser
from report_files import Report
from riesel_command import SHIPPED

SWEEP = """\
base: tube.yaml
set: {run.duration: 1 ms}
axes:
  contact.restitution: [0.7, 0.8, 0.9]
  contact.stiffness: [200 N/m, 2000 N/m]
branches:
  slow: {start.axial_velocity: 1 m/s}
  fast: {start.axial_velocity: 8 m/s}
"""

FIGURES = """
[...document.querySelectorAll("figure > svg")].map(svg => {
  const outer = svg.getBoundingClientRect();
  const texts = [...svg.querySelectorAll("text")].map(text => {
    const r = text.getBoundingClientRect();
    return {text: text.textContent, left: r.left - outer.left, top: r.top - outer.top,
            right: outer.right - r.right, bottom: outer.bottom - r.bottom};
  });
  const shapes = svg.querySelectorAll("circle, rect, line, polyline, polygon").length;
  return {title: svg.querySelector("title").textContent, width: outer.width,
          height: outer.height, texts: texts, shapes: shapes};
})"""

# Of labels that belong to one axis or legend: those that run into each other.
COLLISIONS = """
[...document.querySelectorAll("g.axes, g.legend, g.colour_bar, g.marks")].flatMap(group => {
  const places = [...group.querySelectorAll("text")].map(text =>
    ({text: text.textContent, box: text.getBoundingClientRect()}));
  return places.flatMap((a, i) => places.slice(i + 1).filter(b =>
    a.box.left < b.box.right && b.box.left < a.box.right &&
    a.box.top < b.box.bottom && b.box.top < a.box.bottom).map(b => [a.text, b.text]));
})"""

WIDTHS = "[innerWidth, document.documentElement.scrollWidth]"
LINKS = "[...document.querySelectorAll('a')].map(a => a.href.baseVal ?? a.getAttribute('href'))"


def setUpModule():
    if browser.PROGRAM is None:
        message = "skipped: there is no Chromium; ./setup.sh browser installs it"
        print(message, file=sys.stderr)
        raise unittest.SkipTest(message)


class InBrowser(Report):

    @classmethod
    def setUpClass(cls):
        """{a page: the number of its figures}, and the browser."""
        maker = cls.maker()
        run = maker.run_small_tube("run")
        impacts = maker.run_to_end(
            SHIPPED / "wall_array.yaml", "impacts", "--set",
            "impact.axial_velocity={from: 0.3, to: 40, points: 9, spacing: log}")
        maker.write("sweep.yaml", SWEEP)
        maker.assert_done(maker.riesel("sweep", "sweep.yaml", "--out", "sweep"))
        sweep = maker.home / "sweep"
        for directory in (run, impacts, sweep):
            maker.assert_done(maker.riesel("report", directory))
        cls.pages = {run / "report.html": 16, impacts / "report.html": 4, sweep / "report.html": 1}
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def on_each_page(self, check, width=1000, dark=False):
        """Calls check(page, number of its figures) when the page is shown."""
        for page, figures in self.pages.items():
            with self.subTest(page=page.parent.name, width=width, dark=dark):
                self.browser.show(page, width, dark)
                check(page, figures)

    def test_nothing_is_fetched_and_nothing_is_complained_of(self):
        def check(page, _):
            self.assertEqual(self.browser.requests(), [page.as_uri()])
            self.assertEqual(self.browser.complaints(), [])

        self.on_each_page(check)

    def test_a_page_that_fetches_or_complains_would_be_caught(self):
        page = self.write("bad.html", "<!DOCTYPE html><link rel='icon' href='data:,'>"
                          "<img src='missing.png'><script>console.log('here')</script>")
        self.browser.show(page)
        self.assertEqual(len(self.browser.requests()), 2)
        self.assertTrue(any("here" in str(complaint) for complaint in self.browser.complaints()))

    def test_all_figures_are_laid_out_and_their_texts_are_within(self):
        def check(_, number):
            figures = self.browser.value_of(FIGURES)
            self.assertEqual(len(figures), number)
            for figure in figures:
                self.assertGreater(figure["width"], 200.0, figure["title"])
                self.assertGreater(figure["height"], 100.0, figure["title"])
                self.assertGreater(figure["shapes"], 5, figure["title"])
                for text in figure["texts"]:
                    for side in ("left", "top", "right", "bottom"):
                        self.assertGreaterEqual(text[side], -0.5, (figure["title"], text))

        self.on_each_page(check)

    def test_labels_do_not_run_into_each_other(self):
        self.on_each_page(lambda *_: self.assertEqual(self.browser.value_of(COLLISIONS), []))

    def test_the_page_is_not_wider_than_its_window(self):
        for width in (360, 1600):
            self.on_each_page(
                lambda *_, width=width: self.assertEqual(self.browser.value_of(WIDTHS), [width, width]),
                width)

    def test_links_lead_to_files_that_are_there(self):
        links = []

        def check(page, _):
            for link in self.browser.value_of(LINKS):
                self.assertTrue((page.parent / unquote(urlparse(link).path)).exists(), link)
                links.append(link)

        self.on_each_page(check)
        self.assertEqual(len(links), 2 * 12)  # each point of the sweep: in the figure, in the table

    def test_the_pixels_are_not_blank(self):
        def check_with(is_paper):
            def check(*_):
                pixels = matplotlib.image.imread(io.BytesIO(self.browser.screenshot()))[..., :3]
                paper = pixels[-2, 2].mean()
                self.assertTrue(is_paper(paper), paper)
                coloured = pixels.max(axis=2) - pixels.min(axis=2) > 0.25
                self.assertGreater(coloured.mean(), 1e-4)
                ink = abs(pixels.mean(axis=2) - paper) > 0.5
                self.assertGreater(ink.mean(), 5e-3)

            return check

        self.on_each_page(check_with(lambda paper: paper > 0.9))
        self.on_each_page(check_with(lambda paper: paper < 0.2), dark=True)
