"""A user's mistakes in a settings file or an override: exit status 2, a message for each that says where,
which key, what is wrong and what to do, and nothing written."""

from riesel_command import BAD_INPUT, SMALL_TUBE, CommandTest, bytes_of_files

# What is replaced in SMALL_TUBE, by what, where the message points to, and what it mentions.
MISTAKES_IN_FILES = {
    "unknown key": (
        "area_fraction", "area_fracton", "3:10",
        ["grains.area_fracton: unknown key", "did you mean 'grains.area_fraction'?"]),
    "unknown section": (
        "grains:", "grain:", "3:1", ["grain: unknown key", "did you mean 'grains'?"]),
    "key of another scenario": (
        "run:", "impact: {starts: 3}\nrun:", "6:1",
        ["impact: unknown key", "only single_wall_grain or wall_array"]),
    "key in the wrong section": (
        "width: 10 mm,", "width: 10 mm, friction: 0.1,", "4:22",
        ["tube.friction: unknown key", "belongs in the section contact"]),
    "unit of another dimension": (
        "width: 10 mm", "width: 10 kg", "4:15", ["tube.width:", "a length", "'10 kg'"]),
    "unknown unit": (
        "5 ms", "5 blinks", "6:17", ["run.duration:", "a time", "'5 blinks'"]),
    "text for a number": (
        "0.3}", "plenty}", "3:25", ["grains.area_fraction:", "a pure number", "'plenty'"]),
    "list for a number": (
        "0.3}", "[0.3, 0.4]}", "3:25", ["grains.area_fraction:", "a pure number"]),
    "not a number": (
        "5 ms", ".nan", "6:17", ["run.duration:", "finite"]),
    "infinite": (
        "5 ms", ".inf", "6:17", ["run.duration:", "finite"]),
    "number for a section": (
        "{area_fraction: 0.3}", "0.3", "3:9", ["grains:", "a section", "'0.3'"]),
    "above the range": (
        "0.3}", "0.95}", "3:25", ["grains.area_fraction:", "from 0.001 to 0.9", "'0.95'"]),
    "negative length": (
        "width: 10 mm", "width: -10 mm", "4:15", ["tube.width:", "above 0", "'-10 mm'"]),
    "no value": (
        "5 ms}", "}", "6:7", ["run.duration:", "has no value"]),
    "duplicate key": (
        "0.3}", "0.3, area_fraction: 0.4}", "3:30",
        ["grains.area_fraction:", "given twice", "tube.yaml:3:10"]),
    "duplicate section": (
        "run:", "grains: {diameter: 1 mm}\nrun:", "6:1", ["grains:", "given twice"]),
    "both damping and restitution": (
        "restitution: 0.9", "restitution: 0.9, damping: 1e4", "2:32",
        ["contact.restitution:", "contact.damping", "remove one"]),
    "neither damping nor restitution": (
        ", restitution: 0.9", "", "2:1", ["contact.damping", "contact.restitution", "missing"]),
    "missing stiffness": (
        "stiffness: 2000 N/m, ", "", "2:1", ["contact.stiffness:", "missing", "2000 N/m"]),
    "missing section": (
        "run: {duration: 5 ms}", "", "1:1", ["run.duration:", "missing"]),
    "unknown choice": (
        "stiffness:", "law: herz, stiffness:", "2:16",
        ["contact.law:", "linear, power or hertz", "did you mean 'hertz'?"]),
    "unknown scenario": (
        "periodic_tube", "periodic_pipe", "1:11",
        ["scenario:", "periodic_tube, shear_cell, single_wall_grain or wall_array", "'periodic_pipe'"]),
    "missing scenario": (
        "scenario: periodic_tube\n", "", "1:1", ["scenario:", "missing", "periodic_tube"]),
    "integer with a fraction": (
        "run:", "seed: 1.5\nrun:", "6:7", ["seed:", "an integer", "'1.5'"]),
    "bracket not closed": (
        "area_fraction: 0.3}", "area_fraction: 0.3", "4:5", ["not valid YAML"]),
    "tab": ("grains:", "\tgrains:", "3:1", ["tab"]),
    "too narrow": ("width: 10 mm", "width: 1 mm", "4:8", ["tube.width:", "too narrow", "0.00171"]),
    "too short": (
        "length: 10 mm", "length: 3 mm", "4:22", ["tube.length:", "too short", "0.0042"]),
    "too dense": (
        "0.3}", "0.9}", "3:10", ["grains.area_fraction:", "more than a start can place", "0.847"]),
    "overdamped": (
        "restitution: 0.9", "damping: 1e9", "2:32", ["contact.damping:", "do not rebound"]),
    "overdamped at the wall": (
        "restitution: 0.9", "restitution: 0.01, restitution_of: grains", "2:32",
        ["contact.restitution:", "wall", "do not rebound"]),
    "more steps than can be counted": (
        "5 ms", "1e30 s", "6:7", ["run.duration:"]),
}

# The value of --set, and what the message mentions.
MISTAKES_IN_OVERRIDES = {
    "nonsense": ["--set nonsense:", "key=value"],
    "": ["key=value"],
    "=3": ["--set =3:", "key=value"],
    " =3": ["--set  =3:", "key=value"],
    "seed=": ["seed:", "has no value"],
    "seed=x": ["--set seed=x: seed:", "an integer", "'x'"],
    "seed=-1": ["seed:", "0", "'-1'"],
    "sed=3": ["sed: unknown key", "did you mean 'seed'?"],
    "weather.rain=1": ["weather.rain: unknown key", "grains"],
    "run=3": ["run:", "is a section", "--set run."],
    "run.duration=5 kg": ["run.duration:", "a time", "'5 kg'"],
    "gravity=1e6": ["gravity:", "too strong for this tube", "choose less than"],
    "grains.area_fraction=2": ["grains.area_fraction:", "from 0.001 to 0.9", "'2'"],
    "seed=[1": ["not valid YAML"],
    "contact.damping=1e4": ["contact.", "damping", "restitution", "remove one"],
    "tube.tilt=20": ["must be from 0", "'20'", "did you mean '20 degrees'?"],
    "tube.tilt=20 deg": ["an angle", "write 'degrees'"],
    "wall.shake_amplitude=1 mm": ["wall.shake_amplitude: has no effect", "give wall.shake_frequency"],
    "start.axial_velocity=1000 km/s": ["start.axial_velocity:", "too fast", "m/s"],
}


class Mistakes(CommandTest):

    def assert_mistake(self, *arguments, mentions):
        """Both by `run` and by `check`."""
        before = bytes_of_files(self.home)
        for subcommand in ("run", "check"):
            self.assert_refused(self.riesel(subcommand, *arguments), *mentions)
            self.assert_nothing_written(before)

    def test_in_a_file(self):
        for name, (old, new, place, mentions) in MISTAKES_IN_FILES.items():
            with self.subTest(name):
                self.move_to_an_empty_home()
                self.assertIn(old, SMALL_TUBE)
                self.write("tube.yaml", SMALL_TUBE.replace(old, new, 1))
                self.assert_mistake("tube.yaml", mentions=[f"tube.yaml:{place}: ", *mentions])

    def test_in_an_override(self):
        for override, mentions in MISTAKES_IN_OVERRIDES.items():
            with self.subTest(override):
                self.move_to_an_empty_home()
                self.write("tube.yaml", SMALL_TUBE)
                self.assert_mistake("tube.yaml", "--set", override, mentions=mentions)

    def assert_told(self, lines, *arguments):
        result = self.riesel("check", *arguments)
        self.assertEqual(result.returncode, BAD_INPUT, result)
        told = result.stderr.splitlines()
        self.assertEqual(len(told), len(lines), told)
        for one, expected in zip(told, lines):
            self.assertRegex(one, rf"\Ariesel: {expected}.*; ")

    def test_several_are_told_at_once(self):
        self.write("tube.yaml", SMALL_TUBE.replace("width: 10 mm", "width: 10 kg").replace("0.3}", "2}")
                   .replace("restitution:", "restitutoin:") + "weather: {rain: 1}\n")
        self.assert_told([r"tube.yaml:2:32: contact.restitutoin: unknown key",
                          r"tube.yaml:3:25: grains.area_fraction: must be from 0.001 to 0.9",
                          r"tube.yaml:4:15: tube.width: expected a length",
                          r"tube.yaml:7:1: weather: unknown key",
                          r"--set seed=x: seed: expected an integer"], "tube.yaml", "--set", "seed=x")

    def test_what_follows_from_another_mistake_is_not_told(self):
        self.write("tube.yaml", SMALL_TUBE.replace("stiffness:", "law: herz, stifness:"))
        self.assert_told([r"tube.yaml:2:16: contact.law: ", r"tube.yaml:2:22: contact.stifness: unknown key"],
                         "tube.yaml")

    def test_another_scenario_does_not_have_the_settings_of_this_one(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.assert_told([r"tube.yaml:3:10: grains.area_fraction: unknown key",
                          r"tube.yaml:4:1: tube: unknown key",
                          r"tube.yaml:5:1: start: unknown key", r"tube.yaml:6:7: run.duration: unknown key"],
                         "tube.yaml", "--set", "scenario=wall_array")

    def test_more_than_a_screen_of_them_is_cut(self):
        self.write("tube.yaml", SMALL_TUBE + "".join(f"k{i}: 1\n" for i in range(1000)))
        result = self.riesel("check", "tube.yaml")
        self.assertEqual(result.returncode, BAD_INPUT)
        *told, rest = result.stderr.splitlines()
        self.assertEqual(len(told), 20)
        self.assertEqual(rest, "riesel: ... and perhaps more: these are the first 20")

    def test_in_the_number_of_threads(self):
        self.write("tube.yaml", SMALL_TUBE)
        for threads in ("0", "-1", "1.5", "many", "100000"):
            with self.subTest(threads):
                self.assert_mistake("tube.yaml", f"--threads={threads}",
                                    mentions=["threads", threads])

    def test_a_missing_file(self):
        self.assert_mistake("tube.yaml", mentions=["tube.yaml: ", "No such file", "check the path"])

    def test_an_empty_file(self):
        self.write("tube.yaml", "")
        self.assert_mistake("tube.yaml", mentions=["tube.yaml:1:1: ", "empty", "scenario:"])

    def test_a_file_of_bytes(self):
        (self.home / "tube.yaml").write_bytes(bytes(range(256)) * 4)
        self.assert_mistake("tube.yaml", mentions=["tube.yaml:1:"])

    def test_a_file_that_is_no_settings(self):
        for text in ("hello", "[1, 2]"):
            with self.subTest(text):
                self.write("tube.yaml", text)
                self.assert_mistake("tube.yaml", mentions=["tube.yaml:1:1: ", "scenario:"])

    def test_a_directory_as_a_file(self):
        for subcommand in ("run", "check"):
            result = self.riesel(subcommand, ".")
            self.assert_refused(result, ".: ", "is a directory", "YAML file")
        self.assert_nothing_written({})


class Courtesies(CommandTest):

    def test_json_and_files_from_other_systems_are_settings_too(self):
        json = ('{"scenario": "single_wall_grain", "contact": {"stiffness": 2000,'
                ' "damping": 10000}, "impact": {"axial_velocity": [1, 2]}}')
        for name, text in {"json": json, "mark": "\ufeff" + json,
                           "line ends": json.replace(", ", ",\r\n ")}.items():
            with self.subTest(name):
                self.write("one.json", text)
                self.assert_done(self.riesel("check", "one.json"))

    def test_the_last_override_of_a_key_wins_with_or_without_blanks(self):
        tube = self.write("tube.yaml", SMALL_TUBE)
        short = ["--set", "run.duration=10 us"]
        one = self.run_to_end(tube, "one", *short, "--set", "seed=5", "--set", " seed = 7")
        other = self.run_to_end(tube, "other", *short, "--set", "seed=7")
        self.assert_same_result(one, other)
