"""What the program says of its own speed, and what it tells a shell."""

import json
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest

ASK = """
source <("{program}" completion bash)
COMP_WORDS=({words}) COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
[ -n "{last}" ] || COMP_CWORD=${{#COMP_WORDS[@]}}
_morepro
printf '%s\\n' "${{COMPREPLY[@]}}"
"""


class Bench(ProgramTest):
    def test_every_unit_has_a_time_and_a_size(self):
        self.must_do("bench", "--seconds", 0.02, "--json", "bench.json")
        bench = json.loads((self.folder / "bench.json").read_text())
        self.assertEqual(bench["schema"], "morepro.bench/1")
        units = {unit["name"]: unit for unit in bench["units"]}
        for unit in units.values():
            self.assertGreater(unit["least_ns"], 0)
            self.assertGreaterEqual(unit["median_ns"], unit["least_ns"])
        # The monitor holds its parts.
        self.assertGreater(units["monitor"]["bytes"], units["gap_watch"]["bytes"] + units["bank"]["bytes"])
        self.assertGreater(units["monitor"]["least_ns"], units["decision"]["least_ns"])

    def test_the_table_goes_to_stdout_alone(self):
        done = self.must_do("bench", "--seconds", 0.02)
        self.assertIn("monitor", done.stdout)
        self.assertEqual(done.stderr, "")
        self.assertEqual(json.loads(self.must_do("bench", "--seconds", 0.02, "--json", "-").stdout)["units"][0]["name"],
                         "monitor")

    def test_no_time_is_refused(self):
        self.must_refuse(2, "bench", "--seconds", 0)


class Completion(ProgramTest):
    def offered(self, *words):
        """The last word is the one that is being typed."""
        script = ASK.format(program=PROGRAM, words=" ".join(words), last=words[-1])
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=60, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_gets_commands(self):
        self.assertEqual(self.offered("morepro", "di"), ["diff", "diagnose"])

    def test_bash_gets_the_options_of_a_command(self):
        self.assertIn("--bootstrap", self.offered("morepro", "diagnose", "run.csv", "--b"))
        self.assertNotIn("--profile", self.offered("morepro", "diagnose", "run.csv", "--"))

    def test_bash_gets_what_an_option_may_be(self):
        self.assertEqual(self.offered("morepro", "simulate", "--profile", "pro"), ["production"])
        self.assertEqual(self.offered("morepro", "diagnose", "run.csv", "--exclude", "feed_back"), ["feed_backlash"])

    def test_bash_gets_what_a_command_explains(self):
        self.assertEqual(self.offered("morepro", "effects", "feed_back"), ["feed_backlash"])
        self.assertEqual(self.offered("morepro", "help", "di"), ["diff", "diagnose"])
        self.assertEqual(self.offered("morepro", "completion", "z"), ["zsh"])
        self.assertIn("--json", self.offered("morepro", "effects", "--j"))

    def test_bash_gets_signals(self):
        self.assertEqual(self.offered("morepro", "diff", "--tol", "feed_f"), ["feed_force_n"])
        self.assertEqual(self.offered("morepro", "convert", "a.mat", "b.csv", "--map", "time"), ["time_s"])

    def test_files_are_left_to_the_shell(self):
        self.assertEqual(self.offered("morepro", "diagnose", "run.c"), [])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_takes_it(self):
        script = f'autoload -U compinit; source <("{PROGRAM}" completion zsh); whence -w _morepro'
        done = subprocess.run(["zsh", "-f", "-c", script], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "_morepro: function\n", ""))

    def test_another_shell_is_refused(self):
        self.must_refuse(2, "completion", "fish")


if __name__ == "__main__":
    unittest.main()
