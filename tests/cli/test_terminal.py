"""What is told where: results on standard output, all else on standard error, and lines that renew
themselves on a terminal only."""

import os
import pty
import signal
import time

from riesel_command import PATIENCE, SMALL_TUBE, CommandTest

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

    def test_on_a_terminal_one_line_renews_itself_on_standard_error(self):
        self.write("tube.yaml", LONG_TUBE)
        try:
            keyboard, screen = pty.openpty()
        except OSError as error:  # a bare chroot or container without /dev/pts
            self.skipTest(str(error))
        self.addCleanup(os.close, keyboard)
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

    def read_until(self, terminal, enough):
        deadline = time.monotonic() + 30
        text = b""
        while not enough(text):
            self.assertLess(time.monotonic(), deadline, text)
            text += os.read(terminal, 4096)
        return text
