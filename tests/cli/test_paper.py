"""The files of the paper's figures: each sweep can be run, and the manual says what they give."""

import subprocess
import sys
import unittest

from riesel_command import PATIENCE, SHIPPED, CommandTest, plain_number

DOCS = SHIPPED.parent / "docs"
sys.path.insert(0, str(DOCS / "paper"))

from fig6 import fast_states  # noqa: E402
from fig6_thresholds import Threshold, ends_by, thresholds  # noqa: E402
from tube import Run, grouped, mean_text, plus_minus, runs_of, stay_cells  # noqa: E402

PAGE, LONG_TABLES = DOCS / "paper.md", DOCS / "paper-tables.md"

# file: number of its points
POINTS = {
    "fig3": 3, "fig3_time_step": 7, "fig3_laws": 4, "fig4_5": 5, "fig6_short": 36, "fig6_slow": 250, "fig6_fast": 42,
    "fig6_fast_long": 6, "fig6_stiff": 16, "fig6_checks": 39, "fig6_locking": 22, "fig6_clipped": 50,
    "fig6_clipped_fast": 33,
    "fig6_spacing": 190, "fig6_narrow": 210, "fig6_length": 100, "fig6_choices": 230, "fig6_hysteresis": 78,
    "fig6_lifetimes": 150, "fig6_map": 180, "fig6_curves": 4, "fig6_stiffer": 40,
}


class Paper(CommandTest):

    def tables_of(self, figure):
        """The lines of the tables that figures.py prints of the sweeps in this home."""
        done = subprocess.run(["/usr/bin/python3", "-B", DOCS / "paper/figures.py", figure, "--out", "."],
                              cwd=self.home, timeout=PATIENCE, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater((self.home / f"{figure}.svg").stat().st_size, 0)
        lines = [line for line in done.stdout.splitlines() if line.startswith("|")]
        self.assertGreater(len(lines), 5)
        return lines

    def assert_quoted(self, figure):
        manual = [line for page in (PAGE, LONG_TABLES) for line in page.read_text(encoding="utf-8").splitlines()]
        for line in self.tables_of(figure):
            self.assertIn(line, manual)

    def test_each_file_is_a_sweep_that_can_be_run(self):
        self.assertEqual({path.stem for path in (SHIPPED / "paper").iterdir()}, set(POINTS))
        for name, points in POINTS.items():
            with self.subTest(name):
                result = self.riesel("sweep", SHIPPED / f"paper/{name}.yaml", "--dry-run")
                self.assert_done(result)
                self.assertEqual(plain_number(result.stdout, r"(\d+) points, "), points)
        self.assertEqual(list(self.home.iterdir()), [])

    def test_the_numbers_of_fig_3_are_those_of_the_manual(self):
        for name in ("fig3", "fig3_time_step", "fig3_laws"):
            self.assert_done(self.riesel("sweep", SHIPPED / f"paper/{name}.yaml"))
        self.assert_quoted("fig3")

    def test_the_numbers_of_figs_4_and_5_are_those_of_the_manual(self):
        self.assert_done(self.riesel("sweep", SHIPPED / "paper/fig4_5.yaml"))
        self.assert_quoted("fig4_5")

    def test_the_numbers_of_fig_6_are_those_of_the_kept_tables(self):
        for figure in ("fig6", "fig6_fast", "fig6_steps", "fig6_thresholds", "fig6_short", "fig6_map",
                       "fig6_rigid"):
            with self.subTest(figure):
                self.assert_quoted(figure)

    def test_the_states_predicted_for_fig_6_are_those_of_the_manual(self):
        sweep = self.riesel("sweep", SHIPPED / "paper/fig6_curves.yaml")
        self.assertEqual(sweep.returncode, 0, sweep)  # on a slow machine it tells its progress
        self.assert_quoted("fig6_balance")

    def test_a_missing_result_is_told(self):
        done = subprocess.run(["/usr/bin/python3", "-B", DOCS / "paper/figures.py", "fig3"], cwd=self.home,
                              timeout=PATIENCE, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assert_one_message(done.stderr.replace("figures.py:", "riesel:", 1), "reproduce.sh")


def slow_run(e_n, seed, **other):
    """A run on the slow branch, as a row of a kept table."""
    return Run({"e_n": str(e_n), "seed": str(seed), "state": "too_short", "share": "1.01", "share_error": "0.02",
                "share_5": "1.0", "brake_failure": "0.001"} | other)


def runaway(e_n, seed):
    return slow_run(e_n, seed, share_5="0.0", state="accelerating", share="0.01", brake_failure="1")


class ShortTables(unittest.TestCase):
    """Those of the page itself, which are not printed by figures.py."""

    def assert_told(self, cells):
        page = PAGE.read_text(encoding="utf-8")
        for cell in filter(None, cells):
            self.assertIn(f"| {cell} ", page)

    def test_slow_states(self):
        runs = runs_of(DOCS / "paper/fig6_slow.csv")
        self.assert_told(stay_cells(of_this)[1] for _, of_this in grouped(runs, "k_n", "e_n"))

    def test_ends_of_the_slow_branch(self):
        self.assert_told(end.text for (_, _, length, _, attraction), end in thresholds(DOCS / "paper")
                         if length == 48 and attraction == "keep")

    def test_fast_states(self):
        self.assert_told(state.text for state in fast_states(DOCS / "paper"))


class Thresholds(unittest.TestCase):

    def test_a_state_that_is_lost_in_the_last_fifth_does_not_stay(self):
        late = slow_run(0.84, 1, share_5="0.32")
        self.assertTrue(late.lost)
        self.assertFalse(late.stays)
        self.assertTrue(slow_run(0.84, 1, share_5="0.9").stays)

    def test_the_end_is_the_mean_place_where_starts_are_lost(self):
        end = Threshold([runaway(0.83, 1), runaway(0.83, 2), runaway(0.85, 1), runaway(0.85, 2), runaway(0.87, 1),
                         slow_run(0.87, 2), slow_run(0.9, 1), slow_run(0.9, 2), slow_run(0.95, 1)])
        self.assertEqual((end.all_lost, end.none_lost, end.seeds), (0.85, 0.9, [1, 2]))
        # Half of them between 0.85 and 0.87, half between 0.87 and 0.9.
        self.assertAlmostEqual(end.value, (0.86 + 0.885) / 2)
        of_places = (0.01**2 + 0.015**2) / 12
        of_seeds = 0.025**2 * 0.25
        self.assertAlmostEqual(end.error, (of_places + of_seeds) ** 0.5)
        self.assertEqual(end.text, plus_minus(end.value, end.error))

    def test_an_end_within_one_step_may_be_anywhere_in_it(self):
        end = Threshold([runaway(0.85, seed) for seed in range(10)] + [slow_run(0.86, seed) for seed in range(10)])
        self.assertAlmostEqual(end.value, 0.855)
        self.assertAlmostEqual(end.error, 0.01 / 12**0.5)

    def test_an_end_that_was_not_found_is_told_as_a_bound(self):
        self.assertEqual(Threshold([runaway(0.97, 1), runaway(0.99, 1)]).text, "above 0.99")
        self.assertEqual(Threshold([slow_run(0.65, 1), slow_run(0.8, 1)]).text, "below 0.65")
        self.assertEqual(Threshold([runaway(0.85, 1), runaway(0.87, 1), slow_run(0.87, 2)]).text, "above 0.85")

    def test_ends_of_shorter_times_count_what_is_lost_by_then(self):
        def run(e_n, *shares):
            return slow_run(e_n, 1, time="10", **{f"share_{i}": str(share) for i, share in enumerate(shares, start=1)})
        runs = [run(0.85, 0.1, 0, 0, 0, 0), run(0.86, 1, 1, 0.3, 0.1, 0), run(0.87, 1, 1, 1, 1, 1)]
        ends = dict(ends_by(runs))
        self.assertEqual((ends[4.0].all_lost, ends[4.0].none_lost), (0.85, 0.86))
        self.assertEqual((ends[6.0].all_lost, ends[6.0].none_lost), (0.86, 0.87))

    def test_seeds_give_a_mean_with_the_error_of_so_few(self):
        runs = [slow_run(0.9, seed, velocity=str(seed)) for seed in (1, 2, 3)]
        self.assertEqual(mean_text("velocity", runs), plus_minus(2.0, 1.32 / 3**0.5))
        self.assertEqual(mean_text("velocity", runs[:1]), "1")

    def test_the_own_errors_of_a_few_seeds_count_where_they_are_larger(self):
        def runs(number, own):
            return [slow_run(0.9, seed, velocity=str(2.0 + 0.001 * (seed % 2)), velocity_error=str(own))
                    for seed in range(number)]
        self.assertEqual(mean_text("velocity", runs(4, 0.2)), plus_minus(2.0005, 0.1))
        self.assertIn("± 0.000", mean_text("velocity", runs(4, 1e-6)))
        self.assertIn("± 0.000", mean_text("velocity", runs(10, 0.2)))  # ten know their scatter

    def test_a_share_that_is_hardly_known_settles_nothing(self):
        self.assertTrue(slow_run(0.9, 1, share="0.8", share_error="0.14").settled)
        self.assertFalse(slow_run(0.9, 1, share="0.8", share_error="0.16").settled)
