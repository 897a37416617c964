"""The JSON Schema of settings: takes every file that riesel takes and ships, and marks the mistakes that a
schema can see."""

import json
import re
import subprocess

import jsonschema
import yaml

from riesel_command import COMMAND, SHIPPED, SMALL_TUBE, CommandTest
from test_mistakes import MISTAKES_IN_FILES

# What the parser of YAML finds, what is no number to begin with, and what depends on several settings.
BEYOND_A_SCHEMA = {
    "not a number", "infinite", "duplicate key", "duplicate section", "bracket not closed", "tab",
    "both damping and restitution", "neither damping nor restitution", "missing section", "too narrow",
    "too short", "too dense", "overdamped", "overdamped at the wall", "more steps than can be counted",
}
# A key, and values that are right or wrong for it.
VALUES = {
    "tube.width": (["20 mm", 0.02, "1e-2 m", ".5cm", "20000 µm", "2 meters", "20 mm^1"],
                   ["20 kg", "20 s", "mm", "-20 mm", -1, 0, "0,02 m", True, None, [1], "20 mm mm", "1 2"]),
    "contact.stiffness": (["2000 N/m", "2 kN/m", "2 kg/s^2", "2 N m-1", "2000 J/m^2", "2000 kg s^-2",
                           "2000 kg/s²", 2000],
                          ["2000 N", "2 m/N", "x", -2, "2000 J/m", "2000 kg/s"]),
    "gravity": (["9.81 m/s^2", "9.81 m/s2", "9.81 m s^-2", "981 cm/s2", "9.81 N/kg", "9.81 m/s/s",
                 "36 km/h/s", "9.81 m/s²", 0], ["9.81 m/s", "-1 m/s^2", "9.81 N/m", "9.81 m/s/kg"]),
    "start.axial_velocity": (["-1 m/s", "3.6 km/h", -2], ["1 m", "fast"]),
    "contact.damping": (["1e4 1/s", "10 kHz", "1e4 s^-1"], ["1e4 s", "-1 1/s"]),
    "grains.polydispersity": (["5 %", 0.05, "0.05"], ["5 mm", 0.4]),
    "run.threads": (["auto", 4], ["all", 0, 1.5, 2000]),
    "seed": ([7], [1.5, -1, "one"]),
    "contact.law": (["linear"], ["herz"]),
    "output.checkpoint_interval": (["5 min", "1 h", "1 day"], ["1 mile"]),
}


def validator(*options):
    text = subprocess.run([COMMAND, "schema", *options], capture_output=True, check=True).stdout
    schema = json.loads(text)
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def settings_with(key, value):
    """Those of the small tube, with the value at a dotted key."""
    settings = yaml.safe_load(SMALL_TUBE)
    *sections, name = key.split(".")
    place = settings
    for section in sections:
        place = place.setdefault(section, {})
    place[name] = value
    return settings


class Schema(CommandTest):

    @classmethod
    def setUpClass(cls):
        cls.of_settings = validator()
        cls.of_sweeps = validator("--sweep")

    def mistakes(self, settings):
        return [error.message for error in self.of_settings.iter_errors(settings)]

    def test_every_file_that_is_shipped_is_right(self):
        settings = list(SHIPPED.glob("*.yaml"))
        sweeps = list(SHIPPED.glob("paper/*.yaml"))
        self.assertEqual((len(settings) > 2, len(sweeps) > 10), (True, True))
        for path in settings:
            with self.subTest(path.name):
                self.assertEqual(self.mistakes(yaml.safe_load(path.read_text(encoding="utf-8"))), [])
        for path in sweeps:
            with self.subTest(path.name):
                sweep = yaml.safe_load(path.read_text(encoding="utf-8"))
                self.assertEqual([error.message for error in self.of_sweeps.iter_errors(sweep)], [])

    def test_effective_settings_are_right(self):
        for name in ("periodic_tube", "wall_array", "single_wall_grain"):
            quick = ["run.duration=1 us"] if name == "periodic_tube" else ["impact.axial_velocity=1 m/s"]
            self.assertEqual(
                self.riesel("run", SHIPPED / f"{name}.yaml", "--out", name, "--set", *quick).returncode, 0)
            text = (self.home / name / "effective.yaml").read_text(encoding="utf-8")
            self.assertEqual(self.mistakes(yaml.safe_load(text)), [])

    def test_mistakes_are_marked(self):
        self.assertLess(BEYOND_A_SCHEMA, set(MISTAKES_IN_FILES))
        for name, (old, new, _, _) in MISTAKES_IN_FILES.items():
            if name in BEYOND_A_SCHEMA:
                continue
            with self.subTest(name):
                self.assertNotEqual(self.mistakes(yaml.safe_load(SMALL_TUBE.replace(old, new, 1))), [])

    def test_values(self):
        for key, (right, wrong) in VALUES.items():
            for values, are_right in ((right, True), (wrong, False)):
                for value in values:
                    with self.subTest(key=key, value=value):
                        self.assertEqual(self.mistakes(settings_with(key, value)) == [], are_right)

    def test_values_that_it_takes_are_taken(self):
        for key, (right, _) in VALUES.items():
            for number, value in enumerate(right):
                with self.subTest(key=key, value=value):
                    settings = settings_with(key, value)
                    if key == "contact.damping":
                        del settings["contact"]["restitution"]
                    self.write("tube.yaml", yaml.safe_dump(settings, allow_unicode=True))
                    result = self.riesel("run", "tube.yaml", "--out", f"{key}-{number}", "--set",
                                         "run.duration=1 us")
                    self.assert_done(result)

    def test_keys_that_hang_on_others(self):
        hertz = yaml.safe_load(SMALL_TUBE)
        hertz["contact"] = {"law": "hertz", "stiffness": 5e5, "damping": 4.1, "impact_speed": "1 m/s"}
        self.assertEqual(self.mistakes(hertz), [])
        for key, value in {"restitution": 0.9, "exponent_rate": 1, "stiffness": "2000 N/m"}.items():
            with self.subTest(key):
                wrong = {**hertz, "contact": {**hertz["contact"], key: value}}
                self.assertNotEqual(self.mistakes(wrong), [])
        del hertz["contact"]["damping"]
        self.assertTrue(any(re.search("damping.*required", text) for text in self.mistakes(hertz)))
        placed = {**yaml.safe_load(SMALL_TUBE), "grains": {"mass": "1 mg"},
                  "start": {"kind": "file", "from": "grains.csv"}}
        self.assertEqual(self.mistakes(placed), [])
        placed["grains"]["polydispersity"] = 0.1  # hangs on size_distribution, which hangs on start.kind
        self.assertNotEqual(self.mistakes(placed), [])
        viscous = settings_with("contact.slip", "viscous")
        self.assertNotEqual(self.mistakes(viscous), [])
        viscous["contact"]["slip_damping"] = "1e4 1/s"
        self.assertEqual(self.mistakes(viscous), [])

    def test_every_key_tells_what_it_means(self):
        tube = self.of_settings.schema["definitions"]["periodic_tube"]["properties"]
        self.assertIn("Unit: m.", tube["tube"]["properties"]["width"]["description"])
        self.assertEqual(tube["tube"]["properties"]["width"]["default"], "20 mm")
        self.assertEqual(tube["seed"]["default"], 1)

    def test_mistakes_in_sweeps(self):
        right = {"base": "tube.yaml", "axes": {"contact.friction": [0.1, 0.3]}, "seeds": 3}
        self.assertTrue(self.of_sweeps.is_valid(right))
        for change in ({"axis": {}}, {"axes": {"contact.fiction": [1]}}, {"axes": {"contact.friction": 1}},
                       {"seeds": 0}, {"seeds": 10_001}, {"set": {"tube.width": "1 kg"}}, {"base": None},
                       {"branches": {"": {}}}):
            with self.subTest(change):
                self.assertFalse(self.of_sweeps.is_valid({**right, **change}))

    def test_sweeps_that_are_right(self):
        """What the base lacks, the rest may give; keys and sections may be taken out."""
        tube = "base: {scenario: periodic_tube, grains: {area_fraction: 0.1}, tube: {width: 10 mm, length: 6 mm}, " \
               "run: {duration: 1 ms}, contact: {restitution: 0.9%s}%s}\n"
        for text in (tube % ("", "") + "axes: {contact.stiffness: [2000, 2 kN/m]}\n",
                     tube % ("", "") + "set: {contact.stiffness: 2000 N/m}\n",
                     tube % ("", "") + "branches: {soft: {contact.stiffness: 2000 N/m}}\n",
                     tube % (", stiffness: 2000, slip: viscous", "") + "set: {contact.slip_damping: 1e4 1/s}\n",
                     tube % (", stiffness: 2000", ", wall: {spacing: 2 mm}") + "set: {wall: }\n",
                     tube % (", stiffness: 2000, friction: 0.3", "") + "axes: {contact.friction: [0.1, null]}\n"):
            with self.subTest(text):
                self.assertEqual([error.message for error in self.of_sweeps.iter_errors(yaml.safe_load(text))], [])
                self.write("sweep.yaml", text)
                self.assert_done(self.riesel("sweep", "sweep.yaml", "--dry-run"))

    def test_sweeps_that_are_wrong(self):
        self.write("tube.yaml", SMALL_TUBE)
        for text in ("seeds: [-1]", "axes: {}", "axes: [{}]", "axes: {contact: [1]}", "set: {contact: 1}",
                     "set: {tube.width: 1 kg}"):
            with self.subTest(text):
                text = f"base: tube.yaml\n{text}\n"
                self.assertFalse(self.of_sweeps.is_valid(yaml.safe_load(text)))
                self.write("sweep.yaml", text)
                self.assert_refused(self.riesel("sweep", "sweep.yaml", "--dry-run"))

    def test_more_values_than_the_program_takes(self):
        right = {"from": "0.1 m/s", "to": "2 m/s", "points": 10_000, "spacing": "linear"}
        impact = yaml.safe_load((SHIPPED / "wall_array.yaml").read_text(encoding="utf-8"))
        for value, is_right in ((right, True), ({**right, "points": 10_001}, False),
                                ([1.0] * 10_000, True), ([1.0] * 10_001, False)):
            with self.subTest(is_right=is_right):
                impact["impact"]["axial_velocity"] = value
                self.assertEqual(self.mistakes(impact) == [], is_right)
        for points, is_right in ((10_000, True), (10_001, False)):
            axis = {"from": 0.1, "to": 0.3, "points": points, "spacing": "linear"}
            self.assertEqual(self.of_sweeps.is_valid({"base": "a.yaml", "axes": {"contact.friction": axis}}),
                             is_right)
