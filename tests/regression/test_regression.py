"""Velocities of the tube that a change of the program must not change beyond chance, hashes that it must
not change at all, and what stands between the two: the comparisons themselves. See README.md."""

import unittest

import numpy as np

import regression
from regression import CASES, FAST, HASH_CASES, KEPT_SEEDS, SLOW, TESTED_SEEDS, differ, differ_by_own_bars


class Velocities:
    """For a branch: its cases with new seeds against the kept ones."""

    CASES = {}

    def test_the_kept_velocities_are_met(self):
        rate = regression.rate_of_each()
        for name in self.CASES:
            with self.subTest(name):
                kept = regression.kept(regression.VELOCITIES)["cases"][name]["velocity"]
                runs = [regression.run(name, seed) for seed in TESTED_SEEDS]
                velocities = [result["velocity"] for result in runs]
                self.assertFalse(differ(kept, velocities, rate),
                                 f"{np.mean(velocities)} m/s, kept is {np.mean(kept)} m/s")
                self.check_own_bars(name, kept, runs, rate)

    def check_own_bars(self, name, kept, runs, rate):
        """Where runs come out as accelerating or too short, an error bar promises nothing."""


class SlowBranch(Velocities, unittest.TestCase):

    CASES = SLOW
    # Of the kept runs of these three of four are, or more; of the others a tenth.
    SOME_ARE_STEADY = {"slow soft", "slow", "slow power", "slow Hertz"}

    def check_own_bars(self, name, kept, runs, rate):
        steady = [result for result in runs if result["state"] == "steady"]
        if not steady:
            self.assertNotIn(name, self.SOME_ARE_STEADY)
            return
        self.check_balances(steady)
        means = [result["mean"] for result in steady]
        errors = [result["error"] for result in steady]
        self.assertFalse(differ_by_own_bars(kept, means, errors, rate),
                         f"{means} +- {errors} m/s, kept is {np.mean(kept)} m/s")

    def check_balances(self, steady):
        """n_dot dv_y = g, eq. (9). Five of its errors are no chance (README.md)."""
        for result in steady:
            balance = result["balance"]
            error = balance["errors"]["n_dot_dv_y"]
            self.assertLess(error, 0.02 * balance["gravity"])
            self.assertLess(abs(balance["n_dot_dv_y"] - balance["gravity"]), 5.0 * error)


class FastBranch(Velocities, unittest.TestCase):

    CASES = FAST


class AnotherFriction(unittest.TestCase):

    def test_it_is_noticed(self):
        """0.4 instead of 0.5: what a mistake in the physics would look like."""
        kept = regression.kept(regression.VELOCITIES)["cases"]["fast"]["velocity"]
        runs = [regression.run("fast", seed, friction=0.4) for seed in TESTED_SEEDS]
        self.assertTrue(differ(kept, [result["velocity"] for result in runs],
                               regression.rate_of_each()))


class Hashes(unittest.TestCase):

    def test_short_runs_have_the_kept_bits(self):
        kept = regression.kept(regression.HASHES)
        if kept["machine_type"] != regression.machine_type():
            self.skipTest(f"kept for {kept['machine_type']}, this is {regression.machine_type()}")
        found = {name: regression.run(name, 1, regression.HASH_DURATION)["hash"]
                 for name in HASH_CASES}
        self.assertEqual(found, kept["hashes"])
        self.assertEqual(len(set(found.values())), len(HASH_CASES))


class Comparisons(unittest.TestCase):

    def setUp(self):
        self.cases = regression.kept(regression.VELOCITIES)["cases"]

    def test_the_kept_values_are_of_these_cases(self):
        self.assertEqual(list(self.cases), list(CASES))
        for case in self.cases.values():
            self.assertEqual({len(column) for column in case.values()}, {len(KEPT_SEEDS)})

    def test_false_alarms_come_at_the_rate_that_is_stated(self):
        """The kept runs themselves: four of them, drawn at random, against the rest."""
        draws, rate = 400, 0.05
        random = np.random.default_rng(1)
        alarms = alarms_by_own_bars = by_own_bars = 0
        for name in CASES:
            case = {key: np.array(column) for key, column in self.cases[name].items()}
            for _ in range(draws):
                order = random.permutation(len(KEPT_SEEDS))
                four, rest = order[:len(TESTED_SEEDS)], order[len(TESTED_SEEDS):]
                alarms += differ(case["velocity"][rest], case["velocity"][four], rate)
                steady = four[case["state"][four] == "steady"]
                if name in SLOW and len(steady) > 0:
                    by_own_bars += 1
                    alarms_by_own_bars += differ_by_own_bars(
                        case["velocity"][rest], case["mean"][steady], case["error"][steady], rate)
        self.assertAlmostEqual(alarms / (draws * len(CASES)), rate, delta=0.015)
        self.assertLess(alarms_by_own_bars / by_own_bars, rate + 0.015)

    def test_a_shift_is_found(self):
        """As large as `show` says that it must be to be found in 95 % of cases."""
        rate, random = regression.rate_of_each(), np.random.default_rng(2)
        found = 0
        for _ in range(1000):
            kept = random.normal(1.0, 0.03, len(KEPT_SEEDS))
            shift = regression.smallest_shift(kept, rate)
            found += differ(kept, random.normal(1.0 + shift, 0.03, len(TESTED_SEEDS)), rate)
        self.assertGreater(found, 900)

    def test_a_shift_is_found_by_own_bars(self):
        case = self.cases["slow"]
        means, errors = np.array(case["mean"][:4]), case["error"][:4]
        rate = regression.rate_of_each()
        self.assertFalse(differ_by_own_bars(case["velocity"], means, errors, rate))
        self.assertTrue(differ_by_own_bars(case["velocity"], 1.1 * means, errors, rate))
        self.assertTrue(differ_by_own_bars(case["velocity"], 0.9 * means, errors, rate))

    def test_the_error_bars_of_the_kept_runs_cover_the_mean_of_all(self):
        """Of 90 steady runs: 68 and 93-95 % are expected, within three standard errors."""
        counts = np.sum([regression.coverage(self.cases[name]) for name in SLOW], axis=0)
        steady, once, twice = (int(count) for count in counts)
        self.assertGreater(steady, 80)
        self.assertGreater(once, 0.53 * steady)
        self.assertLess(once, 0.83 * steady)
        self.assertGreater(twice, 0.85 * steady)


if __name__ == "__main__":
    unittest.main()
