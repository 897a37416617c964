"""The files of the paper's figures: each sweep can be run, and docs/paper.md says what they give."""

import subprocess

from riesel_command import SHIPPED, CommandTest, plain_number

DOCS = SHIPPED.parent / "docs"

# file: number of its points
POINTS = {
    "fig3": 3, "fig3_time_step": 7, "fig3_laws": 4, "fig4_5": 5, "fig6_short": 36, "fig6_slow": 54, "fig6_fast": 11,
    "fig6_above": 5, "fig6_stiff": 4, "fig6_checks": 9, "fig6_clipped": 15, "fig6_spacing": 27, "fig6_narrow": 22,
    "fig6_length": 12, "fig6_choices": 13, "fig6_hysteresis": 26, "fig6_map": 60, "fig6_curves": 4,
}


class Paper(CommandTest):

    def tables_of(self, figure):
        """The lines of the tables that figures.py prints of the sweeps in this home."""
        done = subprocess.run(["/usr/bin/python3", "-B", DOCS / "paper/figures.py", figure, "--out", "."],
                              cwd=self.home, timeout=60, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater((self.home / f"{figure}.svg").stat().st_size, 0)
        lines = [line for line in done.stdout.splitlines() if line.startswith("|")]
        self.assertGreater(len(lines), 5)
        return lines

    def assert_quoted(self, figure):
        manual = (DOCS / "paper.md").read_text(encoding="utf-8").splitlines()
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

    def test_the_numbers_of_fig_6_are_those_of_the_kept_tables(self):
        for figure in ("fig6", "fig6_fast", "fig6_thresholds", "fig6_short", "fig6_map"):
            with self.subTest(figure):
                self.assert_quoted(figure)

    def test_the_states_predicted_for_fig_6_are_those_of_the_manual(self):
        sweep = self.riesel("sweep", SHIPPED / "paper/fig6_curves.yaml")
        self.assertEqual(sweep.returncode, 0, sweep)  # on a slow machine it tells its progress
        self.assert_quoted("fig6_balance")

    def test_a_missing_result_is_told(self):
        done = subprocess.run(["/usr/bin/python3", "-B", DOCS / "paper/figures.py", "fig3"], cwd=self.home,
                              timeout=60, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assert_one_message(done.stderr.replace("figures.py:", "riesel:", 1), "reproduce.sh")
