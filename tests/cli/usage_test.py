"""What a user types wrong is said in one sentence, with what was probably meant; what --help shows works as it stands."""

import os
import pathlib
import re
import subprocess
import unittest

from program import PROGRAM, TIME_LIMIT_S, ProgramTest

COMMANDS = ["simulate", "replay", "identify", "convert", "diff", "config", "diagnose", "effects", "kinematics", "thesis",
            "bench", "completion"]
NO_PAGES = "built without its report pages"
# Wrong words -> what the sentence has to hold.
WRONG = {
    ("simulate", "--profle", "rich", "--out", "x.csv"): "option '--profle' is not known (did you mean '--profile'?)",
    ("simulate", "--seeds=3", "--out", "x.csv"): "option '--seeds' is not known (did you mean '--seed'?)",
    ("simulate", "--profile", "rch", "--out", "x.csv"): "'rch' is none of rich, commissioning, production, cutting, step, prbs "
                                                        "(did you mean 'rich'?)",
    ("replay", "x.csv", "--rule", "markow"): "(did you mean 'markov'?)",
    ("completion", "zhs"): "'zhs' is none of bash, zsh",
    ("simulate", "--seed", "-1", "--out", "x.csv"): "--seed: '-1' is no whole number from 0",
    ("simulate", "--seed", "1.5", "--out", "x.csv"): "--seed: '1.5' is no whole number",
    ("thesis", "--bank", "--seed", "18446744073709551616"): "no whole number from 0 to 18446744073709551615",
    ("simulate", "--rate", "nan", "--out", "x.csv"): "nan is not a number in 100 .. 20000 Hz",
    ("replay", "x.csv", "y.csv"): "'y.csv' is not expected",
    ("replay", "x.csv", "--json"): "--json: its value is missing",
    ("kinematics", "--forward", "a"): "--forward: 'a' is not understood; write numbers",
    ("thesis", "--runs", "5"): "--runs requires --bank",
    ("simlate",): "did you mean 'simulate'?",
    ("help", "simlate"): "did you mean 'simulate'?",
    ("effects", "feed_coulomb_fricton"): "did you mean 'feed_coulomb_friction'?",
    ("effects", "--machine", "refrence"): "did you mean 'reference'?",
    ("diagnose", "x.csv", "--exclude", "drive_lags"): "did you mean 'drive_lag'?",
    (): "a command is missing; one of simulate, replay",
    ("--nothing",): "option '--nothing' is not known",
}


class WrongWords(ProgramTest):
    def test_the_sentence_says_what_was_meant(self):
        self.write("x.csv", "time_s,feed_force_n\n0,1\n0.001,1\n")
        for words, wanted in WRONG.items():
            with self.subTest(words):
                sentence = self.must_refuse(2, *words)
                self.assertIn(wanted, sentence)
                self.assertLess(len(sentence), 300)
                self.assertEqual(self.files(), ["x.csv"])

    def test_nothing_goes_to_stdout_with_it(self):
        for words in (("effects", "--machine", "nowhere"), ("effects", "feed_spring", "--machine", "nowhere")):
            self.assertEqual(self.run_program(*words).stdout, "")

    def test_bytes_of_a_file_do_not_reach_the_terminal(self):
        self.write("path.csv", b"x_m,\x1b[31m\x07\xff\xc2\x9b\xc3\xa9" + b"z" * 5000 + b"\n0,0\n")
        done = self.run_program("kinematics", "path.csv", "--out", "-")
        self.assertEqual(done.returncode, 1)
        self.assertIn(r"'\x1b[31m\x07\xff\xc2\x9b" + "\u00e9" + "zzz", done.stderr)
        self.assertLess(len(done.stderr), 1200)


class Help(ProgramTest):
    def examples_of(self, command):
        text = self.must_do(command, "--help").stdout
        self.assertEqual(text, self.must_do("help", command).stdout)
        found = re.search(r"^Examples:\n((?:  .*\n?)+)", text, re.MULTILINE)
        self.assertIsNotNone(found, text)
        return found.group(1).replace("\\\n", " ").splitlines()

    def test_every_command_has_one_line_in_the_list(self):
        listed = re.findall(r"^  (\w+) {2,}\S", self.must_do("--help").stdout.split("Subcommands:")[1], re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(COMMANDS))

    def run_examples(self, command):
        path = f"{pathlib.Path(PROGRAM).parent}{os.pathsep}{os.environ['PATH']}"
        examples = self.examples_of(command)
        self.assertTrue(any(command in line for line in examples))
        for line in examples:
            done = subprocess.run(["bash", "-c", line], capture_output=True, cwd=self.folder, text=True,
                                  timeout=TIME_LIMIT_S, env={**os.environ, "PATH": path})
            if "--report" not in line or NO_PAGES not in done.stderr:
                self.assertEqual(done.returncode, 0, f"{line}: {done.stderr}")
                self.assertNotIn("warning", done.stderr, line)


for _command in COMMANDS:
    def _test(self, command=_command):
        self.run_examples(command)
    setattr(Help, f"test_examples_of_{_command}_work_in_an_empty_folder", _test)


if __name__ == "__main__":
    unittest.main()
