"""No report where there is nothing to show."""

import json

from report_files import Report
from riesel_command import IMPACT, SMALL_TUBE, bytes_of_files


class Refused(Report):

    def assert_no_report(self, directory, *mentions):
        before = bytes_of_files(self.home)
        before.pop(f"{directory}/.lock", None)
        self.assert_refused(self.riesel("report", directory), *mentions)
        after = bytes_of_files(self.home)
        after.pop(f"{directory}/.lock", None)
        self.assertEqual(before, after)

    def test_where_there_is_no_run(self):
        self.assert_no_report("nowhere", "nowhere", "holds no run", "riesel run")
        (self.home / "empty").mkdir()
        self.assert_no_report("empty", "holds no run")

    def test_a_summary_of_another_format(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        summary = self.summary(out)
        for other, told in ((None, "has format 1"), (99, "has format 99")):
            changed = {"format": other, **{k: v for k, v in summary.items() if k != "format"},
                       "version": "7.8.9"}
            if other is None:
                del changed["format"]
            (out / "summary.json").write_text(json.dumps(changed), encoding="utf-8")
            self.assert_no_report("out", "out/summary.json", told, "riesel 7.8.9")

    def test_a_run_that_is_not_over(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        (out / "summary.json").unlink()
        self.assert_no_report("out", "its run has not finished", "riesel resume out")
        (out / "post_mortem.h5").touch()
        self.assert_no_report("out", "it failed", "out/post_mortem.h5", "if it has been resumed since",
                              "riesel resume out")

    def test_what_cannot_be_resumed_is_not_to_be_resumed(self):
        for name, text in (("tube", SMALL_TUBE), ("impact", IMPACT)):
            with self.subTest(name):
                out = self.run_to_end(self.write(f"{name}.yaml", text), name)
                for path in [out / "summary.json", *out.glob("checkpoint*")]:
                    path.unlink()
                start_again = "remove it and start the run again"
                self.assert_no_report(name, "has not finished", start_again)
                self.assert_refused(self.riesel("resume", name), start_again)

    def test_files_that_are_damaged_or_not_of_one_run(self):
        short = self.run_small_tube("short", "--set", "run.duration=0.1 ms")
        longer = self.run_small_tube("longer", "--set", "run.duration=0.2 ms")
        run_file, summary = short / "run.h5", short / "summary.json"
        whole = {path: path.read_bytes() for path in (run_file, summary)}
        for path, content, mention in (
                (run_file, whole[run_file][:len(whole[run_file]) // 2], "short/run.h5: is damaged"),
                (run_file, b"", "short/run.h5: is damaged"),
                (run_file, (longer / "run.h5").read_bytes(), "short/run.h5: is of another run"),
                (summary, whole[summary][:100], "short/summary.json: is not complete JSON"),
                (summary, b"{}", "short/summary.json: is damaged")):
            with self.subTest(mention):
                path.write_bytes(content)
                self.assert_no_report("short", mention)
                path.write_bytes(whole[path])

    def test_a_report_that_cannot_be_written_is_a_failure_and_leaves_the_run_alone(self):
        out = self.run_small_tube("out", "--set", "run.duration=0.1 ms")
        (out / "figures").write_text("in the way", encoding="utf-8")
        before = bytes_of_files(out)
        result = self.riesel("report", out)
        self.assert_failed(result, "out/figures")
        after = bytes_of_files(out)
        del before[".lock"], after[".lock"]
        self.assertEqual(before, after)
