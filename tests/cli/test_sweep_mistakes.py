"""Mistakes in sweep files and on their command lines."""

from riesel_command import BAD_INPUT, SHIPPED, SMALL_TUBE, bytes_of_files
from sweep_command import GRID, SweepTest


class Mistakes(SweepTest):
    """One message that says where, which key, what is wrong and what to do; nothing written."""

    MISTAKES = {
        "": ["sweep.yaml:1:1:", "empty", "base:"],
        SMALL_TUBE: ["sweep.yaml:1:1: scenario: unknown key", "riesel run"],
        "axes: {seed: [1]}": ["sweep.yaml:1:1: base: is missing"],
        "base: nix.yaml": ["sweep.yaml:1:7: base: nix.yaml", "No such file", "relative to"],
        "base: tube.yaml\naxis: {seed: [1]}": [":2:1: axis: unknown key", "'axes'"],
        "base: tube.yaml\naxes: {contact.frictoin: [1]}": [
            ":2:8: contact.frictoin: unknown key", "'contact.friction'"],
        "base: tube.yaml\naxes: {contact.friction: []}": [":2:26: contact.friction:", "empty"],
        "base: tube.yaml\naxes: {contact.friction: 0.5}": [
            ":2:26: contact.friction: expected a list", "'set'"],
        "base: tube.yaml\naxes: {tube.width: [10 mm, 9 kg]}": [
            ":2:28: tube.width: expected a length", "'9 kg'"],
        "base: tube.yaml\naxes: {tube.width: [10 mm, 0.1 mm]}": [
            ":2:8: tube.width: the tube is too narrow", "tube.width above"],
        "base: tube.yaml\naxes: {tube.width: {from: 1 cm, to: 2, points: 3, spacing: lgo}}": [
            ":2:60: tube.width.spacing:", "did you mean 'log'?"],
        "base: tube.yaml\naxes: {contact: {friction: [1]}}": [":2:8: contact: is a section"],
        "base: tube.yaml\naxes: {scenario: [wall_array]}": [":2:8: scenario: cannot be changed"],
        "base: tube.yaml\naxes: [{seed: [1, 2], contact.friction: [0, 1, 2]}]": [
            ":2:41: contact.friction: has 3 values, but seed, which varies with it, has 2"],
        "base: tube.yaml\naxes: [{seed: [1]}, {seed: [2]}]": [
            "seed: is set twice", "sweep.yaml:2:9"],
        "base: tube.yaml\nset: {gravity: 0}\naxes: {gravity: [1]}": ["gravity: is set twice"],
        "base: tube.yaml\naxes: {limits.speed: [9 m/s]}\nbranches: {free: {limits: }}": [
            ":3:19: limits: is set twice, first at sweep.yaml:2:8"],
        "base: tube.yaml\naxes: {}": [":2:7: axes: expected keys"],
        "base: tube.yaml\naxes: {run.stepping: [plain, windows]}": [
            ":2:8: run.stepping: changes no result", "leave it out"],
        "base: tube.yaml\nseeds: 0": [":2:8: seeds: must be from 1"],
        "base: tube.yaml\nseeds: []": [":2:8: seeds: the list is empty"],
        "base: tube.yaml\nseeds: [1, x]": [":2:12: seed: expected an integer"],
        "base: tube.yaml\nbranches: {slow: 1}": [":2:18: branches.slow: expected keys"],
        'base: tube.yaml\nbranches: {"": {}}': [":2:12: branches: a branch has no name"],
        "base: tube.yaml\nbranches: {slow: {start.axial: 1}}": [
            ":2:19: start.axial: unknown key"],
        "base: tube.yaml\nset: {contact: 1}": [":2:7: contact: is a section"],
        "base: tube.yaml\nset: {contact.impact_speed: 1}": [
            ":2:7: contact.impact_speed: has no effect when contact.law is linear"],
        "base: tube.yaml\ncontinue_along: seed": [":2:17: continue_along:", "an axis"],
        "base: tube.yaml\naxes: {tube.width: [1 cm, 2 cm]}\ncontinue_along: tube.width": [
            ":3:17: continue_along:", "tube.width", "the grains"],
        "base: tube.yaml\naxes: {seed: {from: 1, to: 3, points: 3, spacing: linear}}": [
            ":2:14: seed: only quantities"],
        "base: tube.yaml\nseeds: 2000\naxes: {gravity: [1, 2, 3, 4, 5, 6]}": [
            "more than 10000 points"],
    }

    def test_in_the_sweep_file(self):
        for text, mentions in self.MISTAKES.items():
            with self.subTest(text):
                self.write("sweep.yaml", text)
                before = bytes_of_files(self.home)
                self.assert_refused(self.riesel("sweep", "sweep.yaml"), *mentions)
                self.assert_nothing_written(before)

    def test_a_plan_too_large_to_be_read_again(self):
        """The lists of its points are in the manifest."""
        self.write("impacts.yaml", (SHIPPED / "single_wall_grain.yaml").read_text(encoding="utf-8"))
        velocities = ", ".join(f"{1 + i / 1000:.3f}" for i in range(700))
        self.write("sweep.yaml", f"base: impacts.yaml\naxes:\n  impact.axial_velocity: [[{velocities}]]\n"
                                 "  contact.friction: {from: 0.1, to: 0.5, points: 4000, spacing: linear}\n")
        before = bytes_of_files(self.home)
        self.assert_refused(self.riesel("sweep", "sweep.yaml", "--prepare"), "sweep.yaml: axes:",
                            "4000 points", "MB", "split the sweep")
        self.assert_nothing_written(before)

    def test_in_the_base(self):
        self.write("tube.yaml", SMALL_TUBE.replace("area_fraction", "area_fracton"))
        result = self.sweep(GRID)
        self.assert_refused(result, "tube.yaml:3:10: grains.area_fracton: unknown key")

    def test_on_the_command_line(self):
        self.write("sweep.yaml", GRID)
        for arguments, mention in ((["sweep"], "FILE"), (["sweep", "x.yaml"], "x.yaml"),
                                   (["sweep", "sweep.yaml", "--jobs", 0], "--jobs"),
                                   (["status"], "DIR"), (["sweep-task", "out"], "INDEX")):
            with self.subTest(arguments):
                result = self.riesel(*arguments)
                self.assertEqual(result.returncode, BAD_INPUT)
                self.assertIn(mention, result.stderr)
        self.assertFalse((self.home / "sweeps").exists())

    def test_options_of_running_are_refused_where_nothing_is_run(self):
        self.write("sweep.yaml", GRID)
        for options in (["--jobs", 2], ["--retry-failed"], ["--max-walltime", "1 h"]):
            self.assert_sweep_refuses(["--prepare"], options)

    def test_help_names_the_options(self):
        for command, options in {"sweep": ["FILE", "--out", "--jobs", "--dry-run", "--prepare",
                                           "--retry-failed"],
                                 "sweep-task": ["DIR", "INDEX", "--threads", "--retry-failed"],
                                 "status": ["DIR"], "collect": ["DIR"]}.items():
            result = self.riesel(command, "--help")
            self.assert_done(result)
            for option in options:
                self.assertIn(option, result.stdout)
            self.assertIn(f"  {command} ", self.riesel("--help").stdout)
