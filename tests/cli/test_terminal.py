"""What is told where: results on standard output, all else on standard error, and lines that renew
themselves on a terminal only."""

import fcntl
import os
import pty
import re
import signal
import struct
import termios
import time

from riesel_command import IMPACT, PATIENCE, SMALL_TUBE, CommandTest

LONG_TUBE = SMALL_TUBE.replace("5 ms", "1000 s")


class Terminal(CommandTest):

    def test_away_from_a_terminal_there_are_plain_lines_only(self):
        self.write("tube.yaml", SMALL_TUBE)
        process = self.start("run", "tube.yaml", "--out", "out", "--threads", 1, text=False)
        stdout, stderr = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(stderr, b"")
        for sign in (b"\r", b"\x1b", b"\b"):
            self.assertNotIn(sign, stdout)

    def test_standard_output_holds_the_result_and_nothing_else(self):
        self.write("tube.yaml", SMALL_TUBE)
        result = self.riesel("run", "tube.yaml", "--out", "out", "--threads", 1)
        lines = result.stdout.splitlines()
        summary = self.summary(self.home / "out")
        self.assertRegex(lines[0], rf"\Aperiodic_tube: {summary['grains']} grains, .* steps\Z")
        for line in lines[1:]:
            self.assertRegex(line, r"\A  \S.*\S\Z")
        self.assertIn(summary["state_hash"], result.stdout)
        self.assertIn(summary["state"], result.stdout)
        self.assertIn("out/summary.json", result.stdout)

    def test_unknown_collisions_are_told_once(self):
        self.write("tube.yaml", SMALL_TUBE)
        result = self.riesel("run", "tube.yaml", "--set", "run.duration=1 us")
        self.assertRegex(result.stdout, r"(?m)^  wall collisions +not known, gravity 10 m/s\^2$")

    def test_that_there_are_no_collisions_is_told(self):
        self.write("tube.yaml", SMALL_TUBE.replace("area_fraction: 0.3", "area_fraction: 0.01"))
        result = self.riesel("run", "tube.yaml", "--set", "run.duration=30 us", "--set", "output.interval=1 us",
                             "--set", "start.random_velocity=0.01 m/s")
        self.assertRegex(result.stdout, r"(?m)^  wall collisions +none after the transient, gravity 10 m/s\^2$")

    def test_what_cannot_be_printed_is_told(self):
        self.write("tube.yaml", SMALL_TUBE)
        for arguments in (["scenarios"], ["settings"], ["check", "tube.yaml"], ["run", "tube.yaml", "--out", "out"]):
            with self.subTest(arguments), open("/dev/full", "wb") as full:
                process = self.start(*arguments, stdout=full)
                _, stderr = process.communicate(timeout=PATIENCE)
                self.assertEqual(process.returncode, 1)
                self.assert_one_message(stderr)
        self.assertTrue((self.home / "out" / "summary.json").exists())

    def open_terminal(self, columns=0):
        """The side of the user, and that of the program."""
        try:
            keyboard, screen = pty.openpty()
        except OSError as error:  # a bare chroot or container without /dev/pts
            self.skipTest(str(error))
        self.addCleanup(os.close, keyboard)
        fcntl.ioctl(screen, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        return keyboard, screen

    def test_a_line_is_not_wider_than_the_terminal(self):
        self.write("tube.yaml", LONG_TUBE)
        for columns in (30, 120):
            with self.subTest(columns):
                keyboard, screen = self.open_terminal(columns)
                process = self.start("run", "tube.yaml", "--out", f"out{columns}", "--threads", 1,
                                     stderr=screen, text=False)
                os.close(screen)
                shown = self.read_until(keyboard, lambda text: text.count(b"\r") >= 3)
                process.kill()
                self.assertEqual({len(line) for line in shown.split(b"\r")[1:-1]}, {columns - 1})

    def test_quiet_is_quiet(self):
        self.write("tube.yaml", SMALL_TUBE)
        self.write("impact.yaml", IMPACT)
        for command in (["run", "tube.yaml", "--out", "out", "-q"], ["resume", "out", "--quiet"],
                        ["run", "impact.yaml", "--out", "impact", "--quiet"]):
            with self.subTest(command):
                result = self.riesel(*command)
                self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        self.assert_refused(self.riesel("run", "nowhere.yaml", "-q"), "nowhere.yaml", "No such file")
        keyboard, screen = self.open_terminal()
        self.write("long.yaml", LONG_TUBE)
        process = self.start("run", "long.yaml", "--out", "long", "-q", stderr=screen, text=False)
        os.close(screen)
        time.sleep(1.0)
        process.send_signal(signal.SIGTERM)
        shown = self.read_until(keyboard, lambda text: b"goes on from there" in text)
        self.assertTrue(shown.startswith(b"interrupted at"), shown)

    def test_verbose_tells_the_beginning_and_the_checkpoints(self):
        self.write("tube.yaml", SMALL_TUBE)
        result = self.riesel("run", "tube.yaml", "--out", "out", "--threads", 1, "--verbose")
        first, *others = result.stderr.splitlines()
        self.assertRegex(first, r"\Aout: 39 grains, 0 to 5271 steps of \S+ s on 1 thread\Z")
        self.assertEqual(len(others), 2)
        self.assertRegex(others[1], r"\Acheckpoint at t = 0.0050\d+ s, 6 rows, in \S+ s\Z")
        quiet = self.riesel("run", "tube.yaml", "--out", "other", "--threads", 1)
        self.assertEqual(*(re.sub(r"(?m)^  (speed|files|go on by) .*$", "", r.stdout) for r in (result, quiet)))
        both = self.riesel("run", "tube.yaml", "--out", "both", "-v", "-q")
        self.assertEqual((both.returncode, both.stdout), (2, ""))

    def test_colours_are_for_terminals_and_those_who_want_them(self):
        self.write("tube.yaml", SMALL_TUBE)
        for number, (environment, are_wanted) in enumerate([
                ({"TERM": "xterm"}, True), ({"TERM": "xterm", "NO_COLOR": "1"}, False),
                ({"TERM": "dumb"}, False), ({"TERM": "xterm", "NO_COLOR": ""}, True)]):
            with self.subTest(environment):
                keyboard, screen = self.open_terminal()
                process = self.start("run", "tube.yaml", "--out", f"out{number}", "--threads", 1,
                                     stdout=screen, text=False,
                                     env={**os.environ, "NO_COLOR": "", **environment})
                os.close(screen)
                shown = self.read_until(keyboard, lambda text: b"files " in text)
                process.communicate(timeout=60)
                self.assertEqual(b"validity              \x1b[33msuspect\x1b[0m" in shown, are_wanted, shown)
                self.assertEqual(b"\x1b" in shown, are_wanted)

    def test_on_a_terminal_one_line_renews_itself_on_standard_error(self):
        self.write("tube.yaml", LONG_TUBE)
        keyboard, screen = self.open_terminal()
        process = self.start("run", "tube.yaml", "--out", "out", "--threads", 1, stderr=screen,
                             text=False)
        os.close(screen)
        shown = self.read_until(keyboard, lambda text: text.count(b"\r") >= 3)
        self.assertRegex(shown, rb"\r +\d+\.\d %  t = \S+ s  mean v_y = \S+ m/s  \S+ left")
        self.assertNotIn(b"\n", shown)
        process.send_signal(signal.SIGINT)
        after = self.read_until(keyboard, lambda text: b"riesel resume" in text)
        self.assertIn(b"\r\ninterrupted at", after)  # on a line of its own
        self.assertEqual(process.communicate(timeout=PATIENCE)[0], b"")
        self.assertEqual(process.returncode, 130)

    def test_the_line_shows_what_the_flow_is_judged_by(self):
        self.write("tube.yaml", LONG_TUBE)
        keyboard, screen = self.open_terminal()
        process = self.start("run", "tube.yaml", "--out", "out", "--threads", 1, "--set", "tube.tilt=90 degrees",
                             stderr=screen, text=False)
        os.close(screen)
        shown = self.read_until(keyboard, lambda text: text.count(b"\r") >= 3)
        self.assertRegex(shown, rb"\r +\d+\.\d %  t = \S+ s  T = \S+ m\^2/s\^2  \S+ left")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)

    def test_days_that_are_left_are_told_in_hours(self):
        self.write("tube.yaml", SMALL_TUBE.replace("5 ms", "1e8 s"))
        keyboard, screen = self.open_terminal()
        process = self.start("run", "tube.yaml", "--out", "out", "--threads", 1, stderr=screen, text=False)
        os.close(screen)
        shown = self.read_until(keyboard, lambda text: text.count(b"\r") >= 4)
        process.kill()
        left = re.findall(rb"(\d+):(\d+):(\d+) left", shown)
        self.assertGreater(len(left), 0, shown)
        for hours, minutes, seconds in left:
            self.assertGreater(int(hours), 24)
            self.assertLess(max(int(minutes), int(seconds)), 60)
        self.assertRegex(shown, rb"\d left")

    def read_until(self, terminal, enough):
        deadline = time.monotonic() + PATIENCE
        text = b""
        while not enough(text):
            self.assertLess(time.monotonic(), deadline, text)
            text += os.read(terminal, 4096)
        return text
