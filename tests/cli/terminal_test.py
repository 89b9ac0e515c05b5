"""What a terminal gets and what a log gets: progress, colour, and standard output that holds the result alone."""

import json
import os
import pty
import re
import subprocess
import threading
import time
import unittest

from program import PROGRAM, TIME_LIMIT_S, ProgramTest

# The program shows progress after its first second: the reader of its output keeps it waiting that long.
STALL_S = 1.3
ESCAPE = b"\x1b"
LINE = re.compile(rb"simulate: \d+ %, \d+ frames/s, \d+ s left")


class Terminal(ProgramTest):
    def in_terminal(self, descriptor, *arguments, **environment):
        """What the terminal behind one descriptor of the program receives; its other output, when it reads late."""
        own, theirs = pty.openpty()
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL, descriptor: theirs}
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder,
                                   env={**os.environ, "TERM": "xterm", **environment}, **streams)
        os.close(theirs)
        shown = bytearray()
        reader = threading.Thread(target=self.drain, args=(own, shown))
        reader.start()
        if process.stdout:
            time.sleep(STALL_S)
            process.stdout.read()
            process.stdout.close()
        self.assertEqual(process.wait(TIME_LIMIT_S), 0)
        reader.join(TIME_LIMIT_S)
        os.close(own)
        return bytes(shown)

    @staticmethod
    def drain(descriptor, into):
        try:
            while block := os.read(descriptor, 65536):
                into += block
        except OSError:
            pass  # how a terminal ends when nobody has it open any more

    def in_one_terminal(self, *arguments):
        """What a terminal shows that both outputs go to."""
        own, theirs = pty.openpty()
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=theirs, stderr=theirs,
                                   env={**os.environ, "TERM": "xterm"})
        os.close(theirs)
        shown = bytearray()
        self.drain(own, shown)
        self.assertEqual(process.wait(TIME_LIMIT_S), 0)
        os.close(own)
        return bytes(shown)

    def in_log(self, *arguments):
        """stderr of the program as a file would have it."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        time.sleep(STALL_S)
        _, errors = process.communicate(timeout=TIME_LIMIT_S)
        self.assertEqual(process.returncode, 0)
        return errors


class Progress(Terminal):
    LONG = ("simulate", "--duration", 20, "--out", "-")

    def test_a_terminal_has_one_line_with_rate_and_time_left_which_is_gone_at_the_end(self):
        shown = self.in_terminal("stderr", *self.LONG)
        lines = shown.split(b"\r\x1b[K")
        self.assertEqual((lines[0], lines[-1]), (b"", b""), shown)
        self.assertGreaterEqual(len(lines), 3, shown)
        for line in lines[1:-1]:
            self.assertRegex(line, LINE)
        self.assertNotIn(b"\n", shown)

    def test_the_line_is_gone_before_the_result_is_printed(self):
        self.must_do("simulate", "--profile", "rich", "--duration", 20, "--effect", "brush_voltage_drop=1",
                     "--out", "run.csv")
        shown = self.in_one_terminal("diagnose", "run.csv")
        self.assertIn(b"diagnose: ", shown)  # slow enough to show progress at all
        self.assertRegex(shown, rb"\r\x1b\[Krecording ")

    def test_a_log_of_a_long_search_has_a_line_a_second_at_most(self):
        self.must_do("simulate", "--profile", "rich", "--duration", 20, "--effect", "feed_coulomb_friction=6",
                     "--datasheet-error", "0.1", "--machine-out", "sheet.toml", "--out", "run.csv")
        for command in ("identify", "diagnose"):
            start = time.monotonic()
            lines = self.in_log(command, "run.csv", "--machine", "sheet.toml").splitlines()
            self.assertLessEqual(len(lines), time.monotonic() - start + 1, lines)
            if command == "diagnose":  # the other one may be done before a line is due
                self.assertGreaterEqual(len(lines), 1)
            for line in lines:
                self.assertRegex(line, rb"^" + command.encode() + rb": [a-z]+(, pass \d+|(, \d+ %, \d+ s left)?)$")

    def test_a_log_has_plain_lines_in_tenths(self):
        errors = self.in_log(*self.LONG)
        self.assertNotIn(ESCAPE, errors)
        self.assertNotIn(b"\r", errors)
        lines = errors.splitlines()
        self.assertTrue(1 <= len(lines) <= 10, errors)
        for line in lines:
            self.assertRegex(line, LINE)

    def test_a_terminal_that_knows_lines_only_gets_lines(self):
        self.assertNotIn(ESCAPE, self.in_terminal("stderr", *self.LONG, TERM="dumb"))

    def test_off_is_off(self):
        self.assertEqual(self.in_terminal("stderr", *self.LONG, "--progress", "off"), b"")


class Colour(Terminal):
    def shown(self, **environment):
        self.must_do("simulate", "--duration", 0.2, "--out", "run.csv")
        return self.in_terminal("stdout", "replay", "run.csv", **environment)

    def test_only_a_terminal_gets_colours_unless_nobody_wants_them(self):
        self.assertIn(ESCAPE, self.shown())
        self.assertIn(ESCAPE, self.shown(NO_COLOR=""))
        self.assertNotIn(ESCAPE, self.shown(NO_COLOR="1"))
        self.assertNotIn(ESCAPE, self.shown(TERM="dumb"))
        self.assertNotIn("\x1b", self.must_do("replay", "run.csv").stdout)


class Pipes(ProgramTest):
    def test_json_alone_is_on_standard_output(self):
        self.must_do("simulate", "--profile", "rich", "--duration", 0.5, "--out", "run.csv")
        for words in (("replay", "run.csv"), ("identify", "run.csv"),
                      ("diagnose", "run.csv", "--bootstrap", 0, "--progress", "off"),
                      ("effects",), ("effects", "feed_spring"), ("diff", "run.csv", "run.csv"), ("thesis",),
                      ("bench", "--seconds", 0.01), ("kinematics", "--forward", 0.1, 0.2, 0.3, 1),
                      ("kinematics", "--inverse", 0.57, 0.3, 0.5, 1.57)):
            with self.subTest(words):
                done = self.must_do(*words, "--json", "-")
                self.assertIsInstance(json.loads(done.stdout), dict)
                self.assertEqual(done.stderr, "")
        self.assertEqual(self.files(), ["run.csv"])

    def test_a_difference_is_whole_json_with_status_1(self):
        self.must_do("simulate", "--duration", 0.1, "--out", "a.csv")
        self.must_do("simulate", "--duration", 0.1, "--seed", 2, "--out", "b.csv")
        done = self.run_program("diff", "a.csv", "b.csv", "--json", "-")
        self.assertEqual(done.returncode, 1)
        self.assertFalse(json.loads(done.stdout)["within_tolerance"])


if __name__ == "__main__":
    unittest.main()
