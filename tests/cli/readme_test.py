"""The README's samples are what the program prints: its commands are run, what they print is compared.

A ```console block has commands after `$ ` and below each what it prints; a line of dots stands for any lines. Numbers
may differ by 1 %: other processors add in other orders, and a fit ends a little elsewhere."""

import math
import os
import pathlib
import re
import shlex
import subprocess
import unittest

from program import PROGRAM, PROJECT, TIME_LIMIT_S, ProgramTest

README = (PROJECT / "README.md").read_text()
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TOLERANCE = 0.01


def is_same(wanted, printed):
    """Two lines: the same words, and numbers within the tolerance."""
    if NUMBER.split(wanted) != NUMBER.split(printed):
        return False
    pairs = zip(NUMBER.findall(wanted), NUMBER.findall(printed))
    return all(math.isclose(float(a), float(b), rel_tol=TOLERANCE) for a, b in pairs)


def first_missing(wanted, printed):
    """The first wanted line that does not stand where it should; None: all do."""
    at, may_skip = 0, False
    for line in wanted:
        if line.strip() == "...":
            may_skip = True
            continue
        end = len(printed) if may_skip else min(at + 1, len(printed))
        found = next((i for i in range(at, end) if is_same(line, printed[i])), None)
        if found is None:
            return line
        at, may_skip = found + 1, False
    return None if may_skip or at == len(printed) else f"(nothing, but there is) {printed[at]}"


def sessions():
    """(command, lines that it prints) of every console block, in order."""
    for language, text in BLOCK.findall(README):
        if language == "console":
            for part in text.split("\n$ ") if text.startswith("$ ") else []:
                command, *wanted = part.removeprefix("$ ").rstrip("\n").split("\n")
                yield command, wanted


class Readme(ProgramTest):
    def shell(self, command):
        path = f"{pathlib.Path(PROGRAM).parent}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run(["bash", "-c", command], capture_output=True, cwd=self.folder,
                              timeout=TIME_LIMIT_S, text=True, env={**os.environ, "PATH": path})
        self.assertEqual(done.returncode, 0, f"{command}: {done.stderr}")
        return done.stdout.splitlines()

    def must_print(self, command, wanted):
        printed = self.shell(command)
        self.assertIsNone(first_missing(wanted, printed), f"{command} prints\n" + "\n".join(printed))

    def test_commands_print_what_stands_below_them(self):
        commands = list(sessions())
        self.assertGreaterEqual(len(commands), 8)
        for command, wanted in commands:
            self.must_print(command, wanted)

    def test_the_demonstration_prints_what_stands_there(self):
        script = (PROJECT / "sim_host/run").read_text()
        demonstrate = re.search(r"^demonstrate\(\) \{.*?^\}", script, re.MULTILINE | re.DOTALL).group(0)
        wanted = next(text for _, text in BLOCK.findall(README) if text.startswith("A simulated cut"))
        (self.folder / "build/host").mkdir(parents=True)
        self.must_print(f"{demonstrate}\nroot=. program={shlex.quote(PROGRAM)}\ndemonstrate",
                        [*wanted.splitlines(), "..."])

    def test_a_line_that_is_not_printed_is_found(self):
        printed = ["a 1.000", "b 2", "c"]
        self.assertIsNone(first_missing(["a 1.001", "...", "c"], printed))
        self.assertIsNone(first_missing(["...", "b 2", "..."], printed))
        for wrong in (["a 1.1", "..."], ["a 1", "c"], ["...", "d", "..."], ["a 1", "b 2"], ["b 2", "..."]):
            self.assertIsNotNone(first_missing(wrong, printed), wrong)


if __name__ == "__main__":
    unittest.main()
