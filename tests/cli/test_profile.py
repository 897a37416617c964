"""run --profile tells where the time went, and changes nothing."""

from riesel_command import SHIPPED, SMALL_TUBE, CommandTest

PHASES = ["fly", "build", "search", "forces", "receive", "appointments", "stepping, other",
          "measure", "output"]


# Long enough for each phase to be met.
LONGER = SMALL_TUBE.replace("5 ms", "50 ms")


class Profile(CommandTest):

    def profile(self, out, stepping):
        self.write("settings.yaml", LONGER)
        result = self.riesel("run", "settings.yaml", "--out", out, "--threads", 1, "--profile",
                             "--set", f"run.stepping={stepping}")
        self.assert_done(result)
        lines = result.stdout.splitlines()
        header = next(i for i, line in enumerate(lines) if line.startswith("phase"))
        rows = {}
        for line in lines[header + 1:header + 1 + len(PHASES)]:
            name, seconds, share, _ = line.rsplit(maxsplit=3)
            rows[name] = (float(seconds), float(share))
        self.assertEqual(list(rows), PHASES)
        self.assertAlmostEqual(sum(share for _, share in rows.values()), 100.0, delta=1.0)
        return rows, self.state_hash(self.home / out)

    def test_the_shares_belong_to_the_stepping_and_the_bits_to_the_run(self):
        plain, hash_of_plain = self.profile("plain", "plain")
        windows, hash_of_windows = self.profile("windows", "windows")
        self.assertEqual(plain["appointments"], (0.0, 0.0))
        self.assertEqual(windows["receive"], (0.0, 0.0))
        self.assertGreater(windows["appointments"][1], 0.0)
        unprofiled = self.state_hash(self.run_small_tube("unprofiled", "--set", "run.duration=50 ms"))
        self.assertEqual({hash_of_plain, hash_of_windows}, {unprofiled})

    def test_a_run_that_is_at_its_end_has_none(self):
        out = self.run_small_tube("out")
        result = self.riesel("resume", out, "--profile")
        self.assert_done(result)
        self.assertIn("no steps were done, so that there is no profile", result.stdout)
        self.assertNotIn("nan", result.stdout)

    def test_it_is_refused_where_nothing_is_profiled(self):
        for scenario in ("single_wall_grain", "bead_column"):
            with self.subTest(scenario):
                result = self.riesel("run", SHIPPED / f"{scenario}.yaml", "--out", "out", "--profile")
                self.assert_refused(result, "--profile", scenario, "no effect")
                self.assert_nothing_written({})
