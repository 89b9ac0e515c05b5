"""Two recordings or two results, compared signal by signal: verdict, where first, how many, how much, what is missing."""

import json
import unittest

from program import ProgramTest

HEAD = "time_s,feed_force_n,feed_position_m\n"


def recording(rate_hz, seconds, force=lambda t: 10.0 + t, start_s=0.0, leave_out=()):
    times = [start_s + k / rate_hz for k in range(round(rate_hz * seconds)) if k not in leave_out]
    return HEAD + "".join(f"{t:.6f},{force(t):.6g},0.5\n" for t in times)


class DiffRecordings(ProgramTest):
    def diff(self, status, *words):
        done = self.run_program("diff", *words, "--json", "diff.json")
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        result = json.loads((self.folder / "diff.json").read_text())
        self.assertEqual(result["schema"], "morepro.diff/1")
        self.assertEqual(result["within_tolerance"], status == 0)
        self.text = done.stdout + done.stderr
        return result, {signal["name"]: signal for signal in result["signals"]}

    def test_a_recording_is_the_same_in_every_format(self):
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        for ending in ("mrec", "mat", "mcap"):
            self.must_do("convert", "run.csv", f"run.{ending}")
            result, signals = self.diff(0, "run.csv", f"run.{ending}")
            self.assertEqual(result["rows"], {"aligned": 2000, "only_in_a": 0, "only_in_b": 0})
            self.assertGreaterEqual(len(signals), 12)
            self.assertIn("the same within tolerance", self.text)

    def test_where_first_how_many_and_how_much_is_said(self):
        self.write("a.csv", recording(1000, 1))
        self.write("b.csv", recording(1000, 1, lambda t: 10.0 + t + (0.25 if 0.2995 < t < 0.3495 else 0.0)))
        result, signals = self.diff(1, "a.csv", "b.csv", "--abs-tol", "0.125")
        force = signals["feed_force_n"]
        self.assertEqual([force[key] for key in ("verdict", "compared", "out", "first_out_s")], ["out", 1000, 50, 0.3])
        self.assertAlmostEqual(force["largest"]["difference"], 0.25, delta=2e-6)
        # Fifty of a thousand samples differ by 0.25.
        self.assertAlmostEqual(force["rms_difference"], 0.25 * 0.05 ** 0.5, delta=1e-6)
        self.assertEqual(signals["feed_position_m"]["verdict"], "within")
        self.assertIn("1 of 2 signals are out of tolerance, first feed_force_n at 0.3 s", self.text)
        self.diff(0, "a.csv", "b.csv", "--rel-tol", "0.025")  # 0.25 of 10.3
        self.diff(1, "a.csv", "b.csv", "--rel-tol", "0.024")
        self.diff(0, "a.csv", "b.csv", "--tol", "feed_force_n=0.2501")
        self.diff(1, "a.csv", "b.csv", "--abs-tol", "1", "--tol", "feed_force_n=0.2,0.01")

    def test_rates_may_differ(self):
        self.write("slow.csv", recording(100, 1))
        self.write("fast.csv", recording(1000, 1))
        for words in (("slow.csv", "fast.csv"), ("fast.csv", "slow.csv")):
            result, _ = self.diff(0, *words, "--abs-tol", "1e-6")
            self.assertEqual(result["rows"], {"aligned": 100, "only_in_a": 0, "only_in_b": 0})

    def test_samples_belong_together_within_the_time_tolerance(self):
        self.write("a.csv", recording(1000, 1))
        self.write("b.csv", recording(1000, 1, start_s=0.0003, force=lambda t: 9.9997 + t))
        self.assertIn("give a larger --time-tol", self.must_refuse_diff("a.csv", "b.csv"))
        self.diff(1, "a.csv", "b.csv", "--abs-tol", "1e-5", "--time-tol", "0.0002")
        result, _ = self.diff(0, "a.csv", "b.csv", "--abs-tol", "1e-5", "--time-tol", "0.0004")
        self.assertEqual(result["rows"]["aligned"], 1000)

    def must_refuse_diff(self, *words):
        done = self.run_program("diff", *words)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stderr

    def test_missing_rows_samples_and_signals_are_said(self):
        self.write("a.csv", recording(1000, 1))
        self.write("b.csv", recording(1000, 1, leave_out=(500, 501)))
        result, _ = self.diff(1, "a.csv", "b.csv")
        self.assertEqual(result["rows"], {"aligned": 998, "only_in_a": 2, "only_in_b": 0})
        self.assertIn("2 row(s) are only in A", self.text)
        result, _ = self.diff(1, "b.csv", "a.csv")
        self.assertEqual(result["rows"], {"aligned": 998, "only_in_a": 0, "only_in_b": 2})
        self.write("hole.csv", recording(1000, 1).replace("\n0.700000,10.7,", "\n0.700000,,"))
        _, signals = self.diff(1, "a.csv", "hole.csv")
        force = signals["feed_force_n"]
        self.assertEqual([force[key] for key in ("verdict", "missing_in_b", "missing_in_a", "first_out_s")],
                         ["missing", 1, 0, 0.7])
        self.write("other.csv", recording(1000, 1).replace("feed_force_n", "contact"))
        _, signals = self.diff(1, "a.csv", "other.csv")
        self.assertEqual({name: s["verdict"] for name, s in signals.items()},
                         {"feed_force_n": "only_in_a", "contact": "only_in_b", "feed_position_m": "within"})

    def test_the_differences_are_a_recording(self):
        self.write("a.csv", recording(1000, 1))
        self.write("b.csv", recording(1000, 1, lambda t: 10.25 + t))
        self.must_do("diff", "a.csv", "b.csv", "--abs-tol", "1", "--out", "differences.csv")
        rows = [line.split(",") for line in (self.folder / "differences.csv").read_text().splitlines() if line[0] != "#"]
        self.assertEqual(rows[0], HEAD.strip().split(","))
        self.assertEqual(len(rows), 1001)
        self.assertTrue(all(abs(float(row[1]) - 0.25) < 2e-6 and row[2] == "0" for row in rows[1:]))
        self.must_do("convert", "differences.csv", "differences.mat")


class DiffResults(ProgramTest):
    def setUp(self):
        super().setUp()
        self.result = {"schema": "morepro.replay/1", "recording": {"file": "a"}, "timing": {"frames_per_s": 1},
                       "health": {"state": "HEALTHY"}, "chip_load_mm": {"estimate": 0.05, "standard_error": None},
                       "parameters": [{"name": "mass_kg", "estimate": 3.0}, {"name": "inertia_kgm2", "estimate": 0.1}]}
        self.write("a.json", json.dumps(self.result))

    def differences(self, status, *words, **changes):
        self.write("b.json", json.dumps(self.result | changes))
        done = self.run_program("diff", "a.json", "b.json", "--json", "diff.json", *words)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        result = json.loads((self.folder / "diff.json").read_text())
        return {s["name"]: s for s in result["signals"] if s["verdict"] != "within"}

    def test_speed_and_file_names_are_not_compared(self):
        self.assertEqual(self.differences(0, recording={"file": "b"}, timing={"frames_per_s": 2}), {})

    def test_numbers_have_tolerances_and_words_none(self):
        moved = {"estimate": 0.0505, "standard_error": None}
        out = self.differences(1, "--rel-tol", "0.001", chip_load_mm=moved, health={"state": "WATCH"})
        self.assertEqual(list(out), ["health.state", "chip_load_mm.estimate"])
        self.assertEqual([out["health.state"]["a"], out["health.state"]["b"]], ['"HEALTHY"', '"WATCH"'])
        self.assertAlmostEqual(out["chip_load_mm.estimate"]["largest"]["difference"], 0.0005)
        self.differences(0, "--tol", "chip_load_mm.estimate=0.001", chip_load_mm=moved)
        self.assertEqual(list(self.differences(1, "--abs-tol", "9", chip_load_mm={"estimate": 0.05, "standard_error": 1})),
                         ["chip_load_mm.standard_error"])

    def test_things_with_names_are_compared_by_name(self):
        turned = list(reversed(self.result["parameters"]))
        self.differences(0, parameters=turned)
        turned[0] = {"name": "inertia_kgm2", "estimate": 0.2}
        self.assertEqual(list(self.differences(1, parameters=turned)), ["parameters[inertia_kgm2].estimate"])
        only = self.differences(1, parameters=turned[1:])
        self.assertEqual(only["parameters[inertia_kgm2].estimate"]["verdict"], "only_in_a")

    def test_a_replay_is_the_same_as_itself(self):
        self.must_do("simulate", "--duration", "1", "--out", "run.csv")
        self.must_do("convert", "run.csv", "run.mrec")
        for name in ("csv", "mrec"):
            self.must_do("replay", f"run.{name}", "--json", f"{name}.json")
        self.must_do("diff", "csv.json", "mrec.json")


class DiffUsage(ProgramTest):
    def test_wrong_usage_has_status_2_and_bad_files_1(self):
        self.write("a.csv", recording(100, 1))
        self.write("a.json", '{"schema": "x"}')
        self.write("b.json", '{"schema": "y"}')
        self.write("list.json", "[1]")
        for status, words, said in [
                (2, ("a.csv", "a.json"), "two recordings or two results"), (2, ("a.csv",), "B is required"),
                (2, ("a.csv", "a.csv", "--tol", "feed_forse_n=1"), "did you mean 'feed_force_n'?"),
                (2, ("a.csv", "a.csv", "--tol", "feed_force_n"), "SIGNAL=ABSOLUTE"),
                (2, ("a.csv", "a.csv", "--abs-tol", "-1"), "--abs-tol"), (2, ("a.csv", "a.csv", "--rel-tol", "nan"), "--rel-tol"),
                (2, ("a.csv", "a.csv", "--out", "a.csv"), "write to another one"),
                (2, ("a.json", "a.json", "--out", "x.csv"), "for recordings"),
                (1, ("a.json", "b.json"), "schema 'x'"), (1, ("a.json", "list.json"), "no JSON result"),
                (1, ("a.csv", "nothing.csv"), "No such file")]:
            with self.subTest(words):
                before = self.files()
                self.assertIn(said, self.must_refuse(status, "diff", *words))
                self.assertEqual(self.files(), before)


if __name__ == "__main__":
    unittest.main()
