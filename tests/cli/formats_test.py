"""A recording goes through every format and comes back as it was; SciPy reads what we write as MATLAB; a published
MATLAB data set opens as a recording."""

import json
import os
import pathlib
import subprocess
import sys
import unittest

from program import HERE, SHARED, ProgramTest

CSV_HEAD = "# machine: Fr\u00e4se \u00bd\n# note: a: b\n# rate_hz: 1000\n"
COLUMNS = "time_s,feed_force_n,contact,feed_position_m\n"
# A missing sample, an infinity, a missing row, the smallest and the largest float32, a minus zero.
ROWS = ("0.500000,1.1754944e-38,0,-0\n0.501000,,1,3.4028235e+38\n0.502000,-inf,1,0.1\n0.504000,1e-45,0,16777216\n"
        "0.505000,0.3,0,\n")
SCIPY = """
import json, scipy.io, sys
file = scipy.io.loadmat(sys.argv[1])
metadata = [[str(key[0]), str(value[0])] for key, value in file["morepro_info"]["metadata"][0, 0]]
columns = {name: [str(v.dtype), list(v.shape), [repr(x) for x in v[:, 0].tolist()]]
           for name, v in file.items() if v is not None and name[0] != "_" and name != "morepro_info"}
print(json.dumps({"metadata": metadata, "columns": columns}))
"""


def python_with_scipy():
    """The interpreter that runs this test, or the system's, for which the package list installs SciPy."""
    for python in (sys.executable, "/usr/bin/python3"):
        if pathlib.Path(python).exists() and subprocess.run([python, "-c", "import scipy.io"],
                                                            capture_output=True).returncode == 0:
            return python
    return None


class RoundTrips(ProgramTest):
    def test_every_format_gives_back_what_it_can_hold(self):
        original = self.write("run.csv", CSV_HEAD + COLUMNS + ROWS)
        for ending in ("mat", "mcap", "mrec", "csv"):
            with self.subTest(ending):
                self.must_do("convert", original, f"there.{ending}", "--machine", "reference")
                self.must_do("convert", f"there.{ending}", "back.csv")
                self.assertEqual((self.folder / "back.csv").read_text(), original.read_text())

    def test_a_replay_of_any_format_gives_the_same_answer(self):
        self.must_do("simulate", "--duration", "1", "--out", "run.csv")
        self.must_do("replay", "run.csv", "--json", "csv.json", "--health-out", "csv.bin")
        for ending in ("mat", "mcap"):
            with self.subTest(ending):
                self.must_do("convert", "run.csv", f"run.{ending}")
                self.must_do("replay", f"run.{ending}", "--json", f"{ending}.json", "--health-out", f"{ending}.bin")
                self.assertEqual((self.folder / f"{ending}.bin").read_bytes(), (self.folder / "csv.bin").read_bytes())

    def test_a_simulation_writes_every_format(self):
        for ending in ("csv", "mat", "mcap"):
            self.must_do("simulate", "--duration", "0.1", "--out", f"run.{ending}")
        for ending in ("mat", "mcap"):
            self.must_do("convert", f"run.{ending}", "back.csv")
            self.assertEqual((self.folder / "back.csv").read_text(), (self.folder / "run.csv").read_text())

    def test_mcap_refuses_a_time_below_zero(self):
        early = self.write("early.csv", "time_s,contact\n-0.001,1\n0,1\n")
        self.assertIn("MCAP has none below zero", self.must_refuse(1, "convert", early, "early.mcap"))
        self.assertEqual(self.files(), ["early.csv"])
        self.must_do("convert", early, "early.mat")


class Matlab(ProgramTest):
    def test_scipy_reads_what_we_write(self):
        python = python_with_scipy()
        if python is None:
            self.assertNotIn("MOREPRO_REQUIRE_TARGETS", os.environ, "install the package python3-scipy")
            print("skipped: SciPy is not there; install the package python3-scipy")
            self.skipTest("SciPy is not there")
        self.must_do("convert", self.write("run.csv", CSV_HEAD + COLUMNS + ROWS), "run.mat")
        read = json.loads(subprocess.run([python, "-c", SCIPY, self.folder / "run.mat"], check=True,
                                         capture_output=True, text=True).stdout)
        self.assertEqual(read["metadata"], [["machine", "Fr\u00e4se \u00bd"], ["note", "a: b"], ["rate_hz", "1000"]])
        columns = read["columns"]
        self.assertEqual(list(columns), COLUMNS.strip().split(","))
        self.assertEqual(columns["time_s"], ["float64", [5, 1], ["0.5", "0.501", "0.502", "0.504", "0.505"]])
        kind, shape, force = columns["feed_force_n"]
        self.assertEqual([kind, shape], ["float32", [5, 1]])
        self.assertEqual([float(x) for x in force][::2], [1.1754943508222875e-38, float("-inf"), 0.30000001192092896])
        self.assertEqual(force[1], "nan")

    def test_a_published_data_set_opens_as_a_recording(self):
        data = SHARED / "data" / "emps" / "DATA_EMPS.mat"
        if not data.exists():
            print(f"skipped: {data} is not there; set MOREPRO_SHARED_DIR")
            self.skipTest("the data set is not there")
        words = ["convert", data, "axis.csv", "--map", "time_s=t", "--map", "feed_position_m=qm"]
        done = self.must_do(*words, "--map", "feed_force_n=gtau*vir")
        self.assertIn("'qg' is not used", done.stderr)
        theirs = (SHARED / "data" / "emps" / "train.csv").read_text().splitlines()
        theirs = [line.split(",") for line in theirs if line[0].isdigit()]
        ours = [line.split(",") for line in (self.folder / "axis.csv").read_text().splitlines()[1:]]
        self.assertEqual(len(ours), len(theirs))
        for mine, other in zip(ours, theirs):  # the CSV has six decimals of the force, eight of the position
            self.assertAlmostEqual(float(mine[0]), float(other[0]), delta=1.1e-6)
            self.assertAlmostEqual(float(mine[1]), float(other[1]), delta=1e-6 + 1e-7 * abs(float(other[1])))
            self.assertAlmostEqual(float(mine[2]), float(other[2]), delta=1e-8 + 1e-7 * abs(float(other[2])))
        replayed = self.must_do("replay", "axis.csv", "--machine", HERE / "machines" / "emps.toml", "--json", "-")
        self.assertEqual(json.loads(replayed.stdout)["frames"]["accepted"], len(theirs))
        self.assertIn("--map feed_force_n=VARIABLE", self.must_refuse(1, "replay", data))

    def test_wrong_usage_of_the_mapping_is_said(self):
        recording = self.write("run.csv", COLUMNS + ROWS)
        self.must_do("convert", recording, "run.mat")
        for words, said in [(("run.csv", "--map", "contact=c"), "for .mat files"), (("run.csv", "--rate", "10"), ".mat"),
                            (("run.mat", "--map", "contact"), "COLUMN=VARIABLE"),
                            (("run.mat", "--map", "contakt=c"), "did you mean 'contact'?"),
                            (("run.mat", "--rate", "10"), "--rate is for files without"),
                            (("run.mat", "--rate", "nan"), "Hz")]:
            with self.subTest(words):
                self.assertIn(said, self.must_refuse(2, "convert", words[0], "out.csv", *words[1:]))

    def test_what_is_no_such_file_is_refused(self):
        for ending, said in (("mat", "no MATLAB file"), ("mcap", "no MCAP file")):
            for content in (b"", b"time_s,contact\n0,1\n1,1\n", bytes(range(256)) * 20):
                with self.subTest(ending):
                    self.assertIn(said, self.must_refuse(1, "replay", self.write(f"bad.{ending}", content)))


if __name__ == "__main__":
    unittest.main()
