"""The program under test, and a folder of its own for every test."""

import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
PROGRAM = os.environ.get("MOREPRO", str(PROJECT / "build/host/bin/morepro"))
SHARED = pathlib.Path(os.environ.get("MOREPRO_SHARED_DIR", PROJECT.parent / "shared"))
TIME_LIMIT_S = 240


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *arguments):
        words = [PROGRAM, *(str(argument) for argument in arguments)]
        return subprocess.run(words, capture_output=True, cwd=self.folder, timeout=TIME_LIMIT_S, text=True)

    def must_do(self, *arguments):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def must_refuse(self, status, *arguments):
        """Status, one sentence on stderr, nothing on stdout."""
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, status, f"{arguments}: {done.stdout}{done.stderr}")
        errors = [line for line in done.stderr.splitlines() if not line.startswith("morepro: warning: ")]
        self.assertEqual(len(errors), 1, done.stderr)
        self.assertTrue(errors[0].startswith("morepro: "), done.stderr)
        return errors[0]

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())
