"""Other projects with MOREPRO: each builds as its users would, runs, and gives the bits of this build's monitor."""

import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
INSTALLED = pathlib.Path(os.environ["MOREPRO_INSTALLED"])
REFERENCE = os.environ["MOREPRO_REFERENCE"]
EIGEN = os.environ["MOREPRO_EIGEN"]
CMAKE = os.environ.get("CMAKE", "cmake")
TIME_LIMIT_S = 240
# The sums of the golden derivatives cancel to no less than 1/100 of their largest summand.
DERIVATIVE_TOLERANCE = 1.0e-12


class ConsumerTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.program = self.folder / "program"

    def must_do(self, *words, **options):
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=TIME_LIMIT_S,
                              **options)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}{done.stderr}")
        return done.stdout

    def build_with_cmake(self, example, *options):
        configured = self.must_do(CMAKE, "-G", "Ninja", "-S", HERE / example, "-B", self.folder,
                                  "-DCMAKE_BUILD_TYPE=Release", *options)
        self.must_do(CMAKE, "--build", self.folder)
        return configured

    def must_give_the_same_bits(self):
        wanted = self.must_do(REFERENCE)
        self.assertEqual(self.must_do(self.program), wanted)
        lines = wanted.splitlines()
        self.assertEqual(len(lines), 7, wanted)
        self.assertEqual(len({line.split()[3] for line in lines[:6]}), 6, "a hash that stands still")
        words = lines[5].split()
        chip_load_mm, standard_error_mm = float(words[8]), float(words[12])
        self.assertLess(abs(chip_load_mm - 0.05), 4 * standard_error_mm)
        self.assertIn("The tool needs the torque that its chip load should need.", lines[6])


class CProgram(ConsumerTest):
    def test_pkg_config_is_all_that_it_needs(self):
        packages = [str(found.parent) for found in INSTALLED.rglob("morepro.pc")]
        self.must_do(HERE / "c_program/build.sh", self.program,
                     env={**os.environ, "PKG_CONFIG_PATH": ":".join(packages)})
        self.must_give_the_same_bits()
        needed = self.must_do("readelf", "-d", self.program)
        self.assertNotIn("libstdc++", needed)


class CmakePackage(ConsumerTest):
    def test_a_cpp_program_finds_the_headers(self):
        self.build_with_cmake("cmake_package", f"-DCMAKE_PREFIX_PATH={INSTALLED}")
        self.must_give_the_same_bits()


class Subdirectory(ConsumerTest):
    def test_a_project_that_adds_it_gets_the_library_alone(self):
        configured = self.build_with_cmake("subdirectory", f"-DMOREPRO_SOURCE={PROJECT}")
        self.must_give_the_same_bits()
        self.assertIn("targets of MOREPRO: morepro_c;morepro_monitor\n", configured)
        self.assertIn("Total Tests: 0", self.must_do("ctest", "-N", "--test-dir", self.folder))
        commands = json.loads((self.folder / "compile_commands.json").read_text())
        for command in commands:
            self.assertNotIn("-Werror", command["command"])
            self.assertNotIn("-march", command["command"])
        careless = [one["command"] for one in commands if one["file"].endswith("careless.c")]
        self.assertEqual(len(careless), 1)
        self.assertNotIn(" -f", careless[0])
        self.must_do(CMAKE, "--install", self.folder, "--prefix", self.folder / "installed")
        self.assertEqual(list((self.folder / "installed").rglob("*morepro*")), [])


class LibraryOnly(ConsumerTest):
    def test_installing_it_takes_no_program_and_no_tests(self):
        self.must_do(CMAKE, "-G", "Ninja", "-S", PROJECT, "-B", self.folder, "-DMOREPRO_LIBRARY_ONLY=ON")
        targets = self.must_do(CMAKE, "--build", self.folder, "--target", "help")
        self.assertIn("libmorepro.a", targets)
        self.assertNotIn("unit_tests", targets)
        self.assertNotIn("morepro_host", targets)


class FileList(ConsumerTest):
    def test_four_files_and_their_flags_are_enough(self):
        self.must_do(HERE / "file_list/build.sh", PROJECT, EIGEN, self.program)
        self.must_give_the_same_bits()


class Simulink(ConsumerTest):
    """A stand-in: Simulink itself is not run."""

    def test_its_c_caller_gives_the_golden_derivatives(self):
        self.build_with_cmake("simulink", f"-DCMAKE_PREFIX_PATH={INSTALLED}")
        with open(PROJECT / "tests/golden/plant_deriv.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 100)
        inputs = "".join(
            f"{int(row['set'] == 'THESIS')} {row['w']} {row['v']} {row['i']} {row['V']} {row['F1']} {row['Fc']} 1 "
            f"{row['CL']} {row['T']}\n" for row in rows)
        answers = self.must_do(self.program, input=inputs).splitlines()
        self.assertEqual(len(answers), len(rows))
        for row, answer in zip(rows, answers):
            numbers = [float(word) for word in answer.split()]
            for got, name, summand in zip(numbers, ("dw", "dv", "di"), self.summands(row)):
                self.assertLessEqual(abs(got - float(row[name])), DERIVATIVE_TOLERANCE * summand, (row, name))
            # The feed axis is linear and slow, so the step is the first terms of its series.
            moved = numbers[4] - float(row["v"])
            slowing = 0.5e-4 * 1.0e-4 * self.feed_rate(row) * numbers[1]
            self.assertAlmostEqual(moved, 1.0e-4 * numbers[1] - slowing, delta=1.0e-5 * abs(moved) + 1e-12)

    @staticmethod
    def feed_rate(row):
        return 0.0 if row["set"] == "THESIS" else 200.0 / 3.0

    @staticmethod
    def summands(row):
        """The largest summand of each balance: what the rounding of a derivative is relative to."""
        thesis = row["set"] == "THESIS"
        torque_constant, inertia = (1.5, 1.0e-3) if thesis else (0.08, 1.2e-4)
        resistance, inductance = (0.6, 1.0e-4) if thesis else (0.8, 0.5e-3)
        current = abs(float(row["i"]))
        return (max(current * torque_constant / inertia, abs(float(row["dw"]))),
                max(abs(float(row["F1"])) / 3.0, 10.0),
                (abs(float(row["V"])) + current * resistance) / inductance)


if __name__ == "__main__":
    unittest.main()
