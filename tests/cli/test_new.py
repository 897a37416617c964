"""riesel new: a settings file to begin with, which runs as it is, with all settings in it."""

import re

import yaml

from riesel_command import CommandTest, bytes_of_files

# The first one that a scenario knows keeps it short.
SHORT = ["run.duration=0.1 ms", "impact.axial_velocity=1 m/s", "column.gap_ratio=1"]


class New(CommandTest):

    def scenarios(self):
        return [line.split()[0] for line in self.riesel("scenarios").stdout.splitlines()]

    def test_it_runs_for_each_scenario(self):
        for scenario in self.scenarios():
            with self.subTest(scenario):
                self.assert_done(self.riesel("new", scenario))
                text = (self.home / f"{scenario}.yaml").read_text(encoding="utf-8")
                change = next(change for change in SHORT if f"{change.split('=')[0].split('.')[1]}:" in text)
                self.run_to_end(f"{scenario}.yaml", scenario, "--set", change)

    def test_what_it_tells_to_do_next_can_be_copied(self):
        result = self.riesel("new", "periodic_tube", "my tube.yaml")
        self.assert_done(result)
        for command in ("check", "run"):
            self.assertIn(f"riesel {command} 'my tube.yaml'", result.stdout)

    def test_with_all_comments_removed_it_has_every_setting(self):
        for scenario in self.scenarios():
            with self.subTest(scenario):
                self.assert_done(self.riesel("new", scenario, "new.yaml"))
                text = (self.home / "new.yaml").read_text(encoding="utf-8")
                (self.home / "new.yaml").unlink()
                whole = re.sub(r"^#(?! )|^#(?=  )", "", text, flags=re.MULTILINE)
                keys = set()

                def add(section, prefix=""):
                    for key, value in section.items():
                        if isinstance(value, dict) and "points" not in value:
                            add(value, f"{prefix}{key}.")
                        else:
                            keys.add(prefix + key)

                add(yaml.safe_load(whole))
                page = self.riesel("settings").stdout
                sections = re.split(r"^## ", page, flags=re.MULTILINE)[1:]
                own = "".join(section for section in sections
                              if section.startswith("All ") or f"`{scenario}`" in section.splitlines()[0])
                self.assertEqual(keys, set(re.findall(r"^\| `([a-z_.]+)` \|", own, re.MULTILINE)))

    def test_nothing_is_written_over(self):
        self.write("periodic_tube.yaml", "mine")
        before = bytes_of_files(self.home)
        self.assert_refused(self.riesel("new", "periodic_tube"), "periodic_tube.yaml", "exists already")
        self.assertEqual(bytes_of_files(self.home), before)

    def test_mistakes(self):
        for name, mention in {"periodic_tub": "did you mean 'periodic_tube'?", "x": "choose "}.items():
            self.assert_refused(self.riesel("new", name), f"{name}: unknown scenario", mention)
        self.assert_refused(self.riesel("new", "periodic_tube", "no/where.yaml"), "no: is no directory", "make it first")
        self.assert_nothing_written({})
