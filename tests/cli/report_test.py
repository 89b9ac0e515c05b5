"""Reports as files: there whole or not at all, and in nobody's way."""

import json
import re
import unittest

from program import ProgramTest

NO_PAGES = "built without its report pages"


class Report(ProgramTest):
    def setUp(self):
        super().setUp()
        self.must_do("simulate", "--profile", "rich", "--duration", "2", "--out", "run.csv", "--progress", "off")

    def data_of(self, command, *options, inputs=("run.csv",), status=0):
        """The page's data; skips where the program has no pages, after looking at what it says."""
        before = self.files()
        done = self.run_program(command, *inputs, "--report", "page.html", "--progress", "off", *options)
        if NO_PAGES in done.stderr:
            self.assertEqual((done.returncode, self.files()), (1, before))
            self.skipTest("the program has no pages")
        self.assertEqual(done.returncode, status, done.stderr)
        page = (self.folder / "page.html").read_text()
        self.assertNotRegex(page, r"(src|href)=[\"']?http")
        return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.S)[1])

    def test_the_page_holds_what_json_writes(self):
        for command in ("replay", "identify"):
            with self.subTest(command):
                data = self.data_of(command, "--json", "result.json")
                self.assertEqual(data["result"], json.loads((self.folder / "result.json").read_text()))
                self.assertEqual(data["command"], command)

    def test_the_result_is_the_same_with_and_without_a_report(self):
        self.data_of("replay", "--json", "with.json", "--health-out", "with.bin")
        self.must_do("replay", "run.csv", "--json", "without.json", "--health-out", "without.bin")
        results = [json.loads((self.folder / name).read_text()) for name in ("with.json", "without.json")]
        for result in results:
            del result["timing"]
        self.assertEqual(results[0], results[1])
        self.assertEqual((self.folder / "with.bin").read_bytes(), (self.folder / "without.bin").read_bytes())

    def test_it_names_the_command_as_a_shell_takes_it_and_the_files(self):
        (self.folder / "run.csv").rename(self.folder / "it's a run.csv")
        done = self.run_program("replay", "it's a run.csv", "--report", "page.html", "--progress", "off")
        if NO_PAGES in done.stderr:
            self.skipTest("the program has no pages")
        page = (self.folder / "page.html").read_text()
        self.assertIn(r"morepro replay 'it'\\''s a run.csv' --report page.html --progress off", page)
        self.assertRegex(page, r'"crc32":"[0-9a-f]{8}"')

    def test_half_a_machine_and_a_hole_of_an_hour(self):
        rows = "".join(f"{0.001 * k + (3600 if k > 1500 else 0):.3f},{k % 7},{1e-5 * k}\n" for k in range(3000))
        self.write("run.csv", f"# rate_hz: 1000\ntime_s,feed_force_n,feed_position_m\n{rows}")
        data = self.data_of("replay", "--machine", "reference")
        titles = {chart["title"] for chart in data["charts"] if chart["section"] == "model"}
        self.assertEqual(titles, {"Feed position"})
        self.assertIsNone(data["phases"]["runs"])
        self.assertEqual(data["missing"]["rows"], 3600000)
        self.assertEqual([value for _, value in data["missing"]["runs"]], [0, None, 1, 0])
        self.assertLess((self.folder / "page.html").stat().st_size, 3e6)

    def test_the_trend_of_wear_is_that_of_the_tool(self):
        slopes = []
        for ramp in (0, 0.0005, 0.001):
            self.must_do("simulate", "--profile", "production", "--duration", "3", "--effect", f"tool_wear_ramp={ramp}",
                         "--out", "run.csv", "--progress", "off")
            trend = self.data_of("replay")["wear_trend"]
            slopes.append((trend["slope_per_s"], trend["standard_error_per_s"]))
        (none, error), (half, half_error), (whole, whole_error) = slopes
        self.assertLess(abs(none), 3 * error)
        self.assertGreater(half, 5 * half_error)
        # Twice the wear, twice the slope; the law of the cut bends by some percent.
        self.assertLess(abs(whole - 2 * half), 3 * (whole_error + 2 * half_error) + 0.03 * whole)

    def rows_of(self, *options):
        self.must_do("simulate", "--profile", "production", "--duration", "2", "--out", "part.csv", "--progress", "off",
                     *options)
        lines = [line.split(",") for line in (self.folder / "part.csv").read_text().splitlines() if line[0] != "#"]
        (self.folder / "part.csv").unlink()
        return lines[0], lines[1:]

    def test_the_trend_begins_anew_where_the_tool_may_have_been_changed(self):
        head, worn = self.rows_of("--effect", "tool_wear_ramp=0.002")
        _, sharp = self.rows_of("--seed", "2")
        for stop_s, begins_s in ((1, 0), (2.5, 2 + 2.5)):
            stop = [worn[0]] * round(stop_s * 10000)
            with self.subTest(stop_s=stop_s):
                self.write("run.csv", ",".join(head) + "\n" + "".join(
                    ",".join([f"{k / 10000:.4f}", *row[1:]]) + "\n" for k, row in enumerate(worn + stop + sharp)))
                trend = self.data_of("replay", "--machine", "reference")["wear_trend"]
                self.assertEqual(trend["from_s"] >= begins_s, True)
                self.assertEqual(trend["from_s"] < 2, begins_s == 0)

    def test_events_say_what_to_do_and_the_page_which_program_it_was(self):
        data = self.data_of("replay")
        self.assertTrue(all(event["cause"] and event["next_step"] for event in data["events"]["listed"]))
        self.assertEqual(data["origin"]["program"], "morepro " + self.must_do("--version").stdout.strip())

    def write_axis(self, name, rate_hz, rows, more_n=0.0, start_s=0.0):
        self.write(name, "time_s,feed_force_n\n" + "".join(
            f"{start_s + k / rate_hz:.6f},{k % 7 + more_n}\n" for k in range(rows)))

    def test_a_comparison_of_recordings_that_begin_late_and_have_different_rates(self):
        self.write_axis("a.csv", 100, 300, start_s=50)
        self.write_axis("b.csv", 1000, 3000, start_s=50)
        data = self.data_of("diff", "--json", "diff.json", "--tol", "feed_force_n=1.5,0.5", inputs=("a.csv", "b.csv"),
                            status=1)
        self.assertEqual(data["result"], json.loads((self.folder / "diff.json").read_text()))
        self.assertEqual(data["span"], {"start_s": 50.0, "duration_s": 3.0, "rate_hz": 100.0})
        first = data["result"]["signals"][0]["first_out_s"]
        for chart in data["charts"]:
            self.assertAlmostEqual(chart["marks"][0]["x"], first - 50)
        # Of the greater tolerance: 1.5 up to a force of 3, half of it above.
        self.assertEqual([data["series"]["allowed.feed_force_n"][key] for key in ("low", "high")], [-3, 3])

    def test_a_comparison_without_a_common_row_or_signal_and_one_of_results(self):
        self.write_axis("a.csv", 100, 300)
        self.write_axis("late.csv", 100, 300, start_s=3600)
        data = self.data_of("diff", inputs=("a.csv", "late.csv"), status=1)
        self.assertEqual(data["result"]["signals"][0]["verdict"], "missing")
        self.assertNotIn("difference.feed_force_n", data["series"])
        self.write("speed.csv", (self.folder / "a.csv").read_text().replace("feed_force_n", "spindle_speed_rad_s"))
        data = self.data_of("diff", inputs=("a.csv", "speed.csv"), status=1)
        self.assertEqual([s["verdict"] for s in data["result"]["signals"]], ["only_in_a", "only_in_b"])
        self.assertEqual(sorted(name for name in data["series"] if "." in name),
                         ["a.feed_force_n", "b.spindle_speed_rad_s"])
        self.write("a.json", '{"schema": "x", "value": 1, "word": "<b>&</script>"}')
        data = self.data_of("diff", inputs=("a.json", "a.json"))
        self.assertEqual((data["span"], data["charts"], data["result"]["within_tolerance"]), (None, [], True))

    def test_nothing_is_left_of_a_failed_job(self):
        self.write("bad.csv", "time_s,feed_force_n\n0,1\n0.001,text\n")
        for command in ("replay", "diagnose", "identify"):
            with self.subTest(command):
                self.must_refuse(1, command, "bad.csv", "--report", "page.html")
                self.must_refuse(2, command, "run.csv", "--report", "run.csv")
                self.must_refuse(2, command, "run.csv", "--report", "a", "--json", "a")
        self.must_refuse(1, "diff", "run.csv", "bad.csv", "--report", "page.html")
        self.must_refuse(2, "diff", "run.csv", "run.csv", "--report", "run.csv")
        self.assertEqual(self.files(), ["bad.csv", "run.csv"])


if __name__ == "__main__":
    unittest.main()
