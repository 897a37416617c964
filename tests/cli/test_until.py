"""Runs that ask for precision: they end when the mean is known well enough, at the same point whatever
happens on the way, or when the time is up."""

import csv
import itertools
import math
import random
import re
import signal
import time

import h5py
import numpy as np

from riesel_command import DONE, SHIPPED, SMALL_TUBE, CommandTest, data_of, saved_step

# Soft contacts take long steps. At 20 % the run ends with the look at 1438 rows.
UNTIL = "{until: {relative_error: 20 %, at_most: 3 s}}"
TUBE = "seed: 2\n" + SMALL_TUBE.replace("2000 N/m", "200 N/m").replace("{duration: 5 ms}", UNTIL)
ROWS = 1438

# What takes a duration out and asks for the same precision.
INSTEAD = ["--set", "run.duration=", "--set", "run.until.relative_error=20 %",
           "--set", "run.until.at_most=3 s"]


def looks():
    """The numbers of rows at which a run is looked at."""
    rows = 100
    while True:
        yield rows
        rows += rows // 4


def looks_until(last):
    return itertools.takewhile(lambda rows: rows <= last, looks())


def number_of_rows(out):
    return data_of(out)["/series/time"][1][0]


class UntilTest(CommandTest):

    def setUp(self):
        super().setUp()
        self.write("until.yaml", TUBE)

    def run_until(self, out, *options):
        return self.run_to_end("until.yaml", out, *options)

    def end_of(self, out):
        summary = self.summary(out)
        mean = summary["mean_axial_velocity"]
        relative_error = math.nan if mean["error"] is None else mean["error"] / mean["value"]
        return summary["ended_by"], summary["state"], relative_error


class Until(UntilTest):

    def test_the_run_ends_when_it_is_precise(self):
        out = self.run_until("out")
        ended_by, state, relative_error = self.end_of(out)
        self.assertEqual((ended_by, state), ("precision", "steady"))
        self.assertLess(relative_error, 0.2)
        self.assertEqual(number_of_rows(out), ROWS)
        self.assertIn(ROWS, looks_until(ROWS))

    def test_the_error_is_told_with_each_look(self):
        result = self.riesel("run", "until.yaml", "--out", "out", "--verbose")
        self.assertEqual(result.returncode, DONE, result)
        told = [float(error) for error in re.findall(r"^t = \S+ s:  error (\S+) % of 20 %$", result.stderr, re.MULTILINE)]
        self.assertEqual(len(told), list(looks_until(ROWS)).index(ROWS) + 1, result.stderr)
        self.assertAlmostEqual(told[-1], 100 * self.end_of(self.home / "out")[2], delta=0.06 * told[-1])

    def test_it_is_the_run_of_that_duration(self):
        out = self.run_until("out")
        duration = self.summary(out)["time"]
        same = self.run_to_end(self.write("tube.yaml", TUBE.replace(UNTIL, f"{{duration: {duration}}}")),
                               "same")
        self.assertEqual(self.state_hash(same), self.state_hash(out))
        self.assertEqual(data_of(same), data_of(out))
        self.assertEqual(self.summary(same)["ended_by"], "duration")

    def test_a_precision_that_is_not_reached_ends_at_the_limit(self):
        out = self.run_until("out", "--set", "run.until.relative_error=0.1 %", "--set",
                             "run.until.at_most=0.4 s")
        self.assertEqual(self.end_of(out)[0], "at_most")
        self.assertAlmostEqual(self.summary(out)["time"], 0.4, delta=1e-5)

    def test_a_precision_that_is_reached_just_at_the_limit_counts(self):
        precise = self.summary(self.run_until("out"))
        out = self.run_until("limited", "--set", f"run.until.at_most={precise['time']!r}")
        self.assertEqual(self.summary(out)["ended_by"], "precision")
        self.assertEqual(self.state_hash(out), precise["state_hash"])

    def test_a_runaway_goes_on_to_the_limit(self):
        out = self.run_until("out", "--set", "start.axial_velocity=20 m/s", "--set",
                             "run.until.relative_error=100 %", "--set", "run.until.at_most=0.5 s")
        self.assertEqual(self.end_of(out)[:2], ("at_most", "accelerating"))

    def test_a_runaway_has_no_error_bar_wherever_its_mean_is_told(self):
        out = self.run_until("out", "--set", "start.axial_velocity=20 m/s", "--set", "run.until.at_most=0.5 s")
        mean = self.summary(out)["mean_axial_velocity"]
        self.assertGreater(mean["value"], 20.0)
        self.assertIsNone(mean["error"])
        self.assert_done(self.riesel("report", out))
        page = (out / "report.html").read_text(encoding="utf-8")
        self.assertIn(f"Mean axial velocity {mean['value']:.4g} (error not known) m/s after ", page)
        self.assertIn("Orange: the mean after the transient; its error is not known.", page)
        self.assertNotRegex(page, r"m/s after \S+ s \(68 % error bar\)")

    def test_of_a_runaway_in_a_sweep_the_table_has_no_error(self):
        self.write("sweep.yaml", "base: until.yaml\nset: {run.until.at_most: 0.5 s}\n"
                                 "axes: {start.axial_velocity: [20 m/s, 25 m/s]}\n")
        result = self.riesel("sweep", "sweep.yaml", "--out", "out")
        self.assert_done(result)
        self.assertRegex(result.stdout, r"\n  flows: 2 accelerating and \w+ \(ended at run\.until\.at_most\)\n")
        with open(self.home / "out/sweep.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["state"] for row in rows], ["accelerating"] * 2)
        self.assertEqual([row["mean_axial_velocity.error"] for row in rows], [""] * 2)
        self.assertGreater(float(rows[0]["mean_axial_velocity.value"]), 20.0)
        with h5py.File(self.home / "out/sweep.h5", "r") as file:
            self.assertTrue(np.isnan(file["points/mean_axial_velocity.error"][()]).all())
        self.assert_done(self.riesel("report", "out"))
        page = (self.home / "out/report.html").read_text(encoding="utf-8")
        self.assertIn("2 of them ended at run.until.at_most", page)
        self.assertRegex(page, r"[0-9.]+ \(error not known\)</td><td[^>]*>accelerating")
        self.assertRegex(page, r"[0-9.]+ \(error not known\) m/s, accelerating")

    def test_the_screen_tells_how_it_ended(self):
        result = self.riesel("run", "until.yaml", "--out", "out")
        self.assertRegex(result.stdout, r"\n  ended +the mean is known as well as was asked for\n")
        result = self.riesel("run", "until.yaml", "--out", "short", "--set", "run.until.at_most=9 ms")
        self.assertRegex(result.stdout, r"\n  ended +the time was up before ")
        self.assertRegex(result.stdout, r"\n  go on by +riesel resume short --set run.until.at_most='\S+ s'\n")
        result = self.riesel("run", self.write("tube.yaml", SMALL_TUBE), "--out", "plain")
        self.assertNotIn("  ended", result.stdout)
        self.assertRegex(result.stdout, r"\n  go on by +riesel resume plain --set run.duration='\S+ s'\n")

    def test_the_screen_has_no_error_bar_of_a_runaway_and_does_not_propose_to_go_on(self):
        result = self.riesel("run", "until.yaml", "--out", "out", "--set", "start.axial_velocity=20 m/s",
                             "--set", "run.until.at_most=0.5 s")
        self.assertRegex(result.stdout, r"\n  mean axial velocity +[0-9.]+ \(error not known\) m/s \(after \S+ s\)\n")
        self.assertNotIn("  go on by", result.stdout)

    def test_check_tells_that_it_may_end_earlier(self):
        result = self.riesel("check", "until.yaml")
        self.assert_done(result)
        self.assertRegex(result.stdout, r"ends +when the mean is known to 20 %\n")
        self.assertRegex(result.stdout, r"steps +at most \d+\n  expected time +at most ")


class UntilInPieces(UntilTest):
    """However the run is cut, it ends where the uncut one does."""

    def test_killed_again_and_again(self):
        whole = self.run_until("whole")
        moments = random.Random(2)
        self.riesel("run", "until.yaml", "--out", "out", "--set", "run.until.at_most=10 ms")
        slower = ["--set", "run.until.at_most=3 s", "--set", "output.checkpoint_interval=0.001 s"]
        kills, out = 0, self.home / "out"
        for _ in range(20):
            saved = saved_step(out)
            process = self.start("resume", "out", "--threads", 1, *slower)
            self.wait_until(lambda: process.poll() is not None or saved_step(out) > saved, "a checkpoint")
            time.sleep(moments.uniform(0.0, 0.05))
            process.send_signal(signal.SIGKILL)
            process.communicate()
            kills += process.returncode == -signal.SIGKILL
            if process.returncode == 0:
                break
        self.assertGreater(kills, 0)
        self.resume_to_end(out, "--set", "output.checkpoint_interval=60 s", *slower[:2])
        self.assert_same_result(whole, out)

    def test_with_another_number_of_threads_at_the_end(self):
        whole = self.run_until("whole")
        out = self.run_until("out", "--set", "run.until.at_most=1.43 s")
        self.resume_to_end(out, "--threads", 2, "--set", "run.until.at_most=3 s", "--set", "run.stepping=plain")
        self.assert_same_result(whole, out)

    def test_a_run_that_is_over_stays_as_it_is(self):
        out = self.run_until("out")
        before = data_of(out), self.state_hash(out)
        self.resume_to_end(out)
        self.assertEqual((data_of(out), self.state_hash(out)), before)
        self.assertEqual(self.end_of(out)[0], "precision")

    def test_to_a_later_limit(self):
        whole = self.run_until("whole")
        out = self.run_until("out", "--set", "run.until.at_most=0.9 s")
        self.assertEqual(self.end_of(out)[0], "at_most")
        self.resume_to_end(out, "--set", "run.until.at_most=3 s")
        self.assert_same_result(whole, out)
        self.assertEqual((whole / "effective.yaml").read_bytes(), (out / "effective.yaml").read_bytes())

    def test_to_a_higher_precision(self):
        precise = ["--set", "run.until.relative_error=2 %"]
        whole = self.run_until("whole", *precise)
        out = self.run_until("out")
        self.resume_to_end(out, *precise)
        self.assert_same_result(whole, out)
        self.assertGreater(number_of_rows(out), ROWS)

    def test_from_a_duration_to_a_precision_and_back(self):
        whole = self.run_until("whole")
        short = TUBE.replace(UNTIL, "{duration: 5 ms}")
        out = self.run_to_end(self.write("short.yaml", short), "out")
        self.resume_to_end(out, *INSTEAD)
        self.assert_same_result(whole, out)
        result = self.riesel("resume", out, "--set", "run.duration=4 s")
        self.assert_refused(result, "run.duration: cannot be given together with run.until", "--set run.until=")
        self.resume_to_end(out, "--set", "run.until=",
                           "--set", "run.duration=1.5 s")
        self.assertEqual(self.end_of(out)[0], "duration")

    def test_a_limit_that_is_over_already_is_refused(self):
        out = self.run_until("out")
        self.assert_refused(self.riesel("resume", out, "--set", "run.until.at_most=1 s"),
                            "run.until.at_most: the run has come to 1.4", "choose a longer time")


class UntilInSweeps(UntilTest):

    def test_a_sweep_over_the_precision(self):
        self.write("tube.yaml", TUBE.replace(UNTIL, "{duration: 5 ms}"))
        self.write("sweep.yaml", "base: tube.yaml\n"
                   "set: {run.duration: , run.until.at_most: 1.5 s}\n"
                   "axes: {run.until.relative_error: [20 %, 0.1 %]}\n")
        self.assertEqual(self.riesel("sweep", "sweep.yaml", "--out", "out").returncode, 0)
        with open(self.home / "out" / "sweep.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["ended_by"] for row in rows], ["precision", "at_most"])
        whole = self.run_until("whole", "--set", "run.until.at_most=1.5 s")
        self.assertEqual(rows[0]["state_hash"], self.state_hash(whole))

    def test_a_chain_continues_from_where_each_run_ended(self):
        self.write("sweep.yaml", "base: until.yaml\nset: {run.until.at_most: 20 ms}\n"
                   "axes: {run.until.relative_error: [20 %, 10 %]}\n"
                   "continue_along: run.until.relative_error\n")
        self.assertEqual(self.riesel("sweep", "sweep.yaml", "--out", "out").returncode, 0)
        with open(self.home / "out/sweep.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["parent"] for row in rows], [""] + [row["point"] for row in rows[:-1]])
        energies = [self.summary(self.home / "out/points" / row["point"])["energy"] for row in rows]
        self.assertEqual(len(energies), 3)  # forward and back
        for before, after in itertools.pairwise(energies):
            left = before["kinetic"] + before["elastic"]
            self.assertAlmostEqual(after["initial"] / left, 1.0, delta=1e-12)


class UntilMistakes(CommandTest):

    MISTAKES = {
        "{duration: 1 s, until: {relative_error: 1 %, at_most: 2 s}}":
            ["6:7: run.duration: cannot be given together with run.until", "remove one"],
        "{duration: 1 s, until: {at_most: 2 s}}": ["6:7: run.duration: cannot be given together with run.until"],
        "{until: {relative_error: 1 %}}": ["6:7: run.until.at_most: is missing", "'20 s'"],
        "{until: {at_most: 2 s}}": ["6:7: run.until.relative_error: is missing", "'1 %'"],
        "{until: {}}": ["run.duration: is missing", "run.until"],
        "{until: 2 s}": ["6:14: run.until:", "section", "run: {until: {relative_error: ...}}"],
        "{until: {relative_eror: 1 %}}": ["6:15: run.until.relative_eror: unknown key",
                                          "run.until.relative_error"],
        "{until: {relative_error: 0}}": ["6:31: run.until.relative_error: must be above 0"],
        "{until: {relative_error: 1 s}}": ["run.until.relative_error:", "a pure number"],
        "{until: {relative_error: 1 %, at_most: 1e30 s}}": ["run.until.at_most: more time steps"],
        "{relative_error: 1 %}": ["'relative_error' belongs in the section run.until"],
        "{until.at_most: 1 s}": ["dotted keys", "run: {until: {at_most: ...}}"],
    }

    def test_each_is_told_with_its_place_and_remedy(self):
        for run, mentions in self.MISTAKES.items():
            with self.subTest(run):
                self.write("tube.yaml", SMALL_TUBE.replace("{duration: 5 ms}", run))
                for command in ("run", "check"):
                    self.assert_refused(self.riesel(command, "tube.yaml"), "tube.yaml:", *mentions)
        self.assertEqual([path.name for path in self.home.iterdir()], ["tube.yaml"])

    def test_a_shipped_file_takes_a_precision_instead_of_its_duration(self):
        self.assert_done(self.riesel("check", SHIPPED / "periodic_tube.yaml", *INSTEAD))
        self.assert_refused(self.riesel("check", SHIPPED / "periodic_tube.yaml", *INSTEAD[2:]),
                            "run.duration: cannot be given together with run.until", "--set run.duration=")
