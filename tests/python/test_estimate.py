"""Estimates: how they are told, what can be done with them, and means of values."""

import math
import unittest

import numpy as np
import riesel


class Told(unittest.TestCase):

    def test_an_estimate_is_told_as_far_as_its_error_lets(self):
        for value, error, text in (
                (1.534, 0.05, "1.534 +- 0.050"), (1234.0, 12.0, "1234 +- 12"),
                (1534.2, 123.4, "1530 +- 120"), (-6.54e6, 1.23e4, "-6540000 +- 12000"),
                (1.2345678, 5e-6, "1.2345678e+00 +- 5.0e-06"),
                (1.2e-7, 3.4e-9, "1.200e-07 +- 3.4e-09"),
                (0.0, 1e-9, "0.0e+00 +- 1.0e-09"), (2.0, math.nan, "2 +- nan"), (math.nan, 1e-9, "nan +- 1e-09"), (math.inf, 1e-9, "inf +- 1e-09")):
            self.assertEqual(str(riesel.Estimate(value, error)), text)

    def test_an_error_that_rounds_up_to_the_next_order_has_two_digits(self):
        for value, error, text in (
                (1.5, 0.0996, "1.50 +- 0.10"), (1.5, 0.0994, "1.500 +- 0.099"),
                (15.0, 0.996, "15.0 +- 1.0"), (150.0, 9.96, "150 +- 10"),
                (1.5, 9.96e-6, "1.500000 +- 0.000010"),
                (1.5, 9.96e-8, "1.50000000e+00 +- 1.0e-07")):
            self.assertEqual(str(riesel.Estimate(value, error)), text)


class Arithmetic(unittest.TestCase):
    """Of independent means and exact numbers; 3, 4 and 5 are errors in quadrature."""

    three, four = riesel.Estimate(1.0, 3.0), riesel.Estimate(7.0, 4.0)

    def test_sums_and_differences_of_two(self):
        self.assertEqual(self.three + self.four, (8.0, 5.0))
        self.assertEqual(self.three - self.four, (-6.0, 5.0))
        self.assertEqual(sum([self.three, self.four]), (8.0, 5.0))
        self.assertTrue(math.isnan((self.three + riesel.Estimate(1.0, math.nan)).error))

    def test_numbers_are_exact(self):
        for number in (2, 2.0, np.float64(2.0), np.float32(2.0), np.uint8(2)):
            for result, expected in (
                    (self.three + number, (3.0, 3.0)), (number + self.three, (3.0, 3.0)),
                    (self.three - number, (-1.0, 3.0)), (number - self.three, (1.0, 3.0)),
                    (self.three * number, (2.0, 6.0)), (number * self.three, (2.0, 6.0)),
                    (-1.0 * number * self.three, (-2.0, 6.0)), (self.three / number, (0.5, 1.5)),
                    (-self.three / (-1.0 * number), (0.5, 1.5))):
                self.assertIsInstance(result, riesel.Estimate)
                self.assertEqual(result, expected)

    def test_nothing_else(self):
        for other in ((1.0, 2.0), "1", None, np.ones(2), 1j):
            for operation in ("__add__", "__sub__", "__mul__", "__truediv__"):
                self.assertIs(getattr(self.three, operation)(other), NotImplemented)
            for operation in (lambda: other + self.three, lambda: other - self.three,
                              lambda: other * self.three):
                with self.assertRaises(TypeError):
                    operation()
        for operation in (lambda: self.three * self.four, lambda: 1.0 / self.three):
            with self.assertRaises(TypeError):
                operation()

    def test_no_function_of_numpy_takes_error_bars_for_values(self):
        for function in (np.mean, np.std, np.array):
            with self.assertRaisesRegex(TypeError, "estimate.value for estimate"):
                function([self.three, self.four])

    def test_a_form_is_that_of_both_numbers(self):
        self.assertEqual(f"{self.three:.3f}, {self.three}", "1.000 +- 3.000, 1.0 +- 3.0")


class Mean(unittest.TestCase):

    def test_its_error_covers_the_truth_as_often_as_it_says(self):
        numbers = np.random.default_rng(1)
        for n in (2, 3, 5, 10):
            means = [riesel.mean_of(sample) for sample in numbers.normal(size=(20000, n))]
            covered = sum(abs(mean.value) <= mean.error for mean in means) / len(means)
            self.assertAlmostEqual(covered, 0.6827, delta=0.01)  # three standard deviations

    def test_of_a_few(self):
        self.assertEqual(riesel.mean_of([1.0, 3.0]).value, 2.0)
        for few in ([], [5.0]):
            self.assertTrue(math.isnan(riesel.mean_of(few).error))

    def test_of_what_are_no_numbers(self):
        estimates = [riesel.Estimate(1.0, 0.1), riesel.Estimate(2.0, 0.1)]
        for values in (estimates, [1.0, estimates[1]], np.ones((2, 2)), [1.0, None], ["1", "2"]):
            with self.assertRaisesRegex(TypeError, "takes numbers; pass the values of estimates"):
                riesel.mean_of(values)
