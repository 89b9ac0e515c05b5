"""Real measurements of half a machine: what can be evaluated is, what cannot is said, and no wear is invented.

The recordings are not part of this project: MOREPRO_SHARED_DIR names the folder that holds data/."""

import json
import unittest

from program import HERE, SHARED, ProgramTest

MACHINES = HERE / "machines"


class MeasuredRecording(ProgramTest):
    def results(self, folder, machine):
        recordings = sorted((SHARED / "data" / folder).glob("*.csv"))
        if not recordings:
            print(f"skipped: {SHARED / 'data' / folder} is not there; set MOREPRO_SHARED_DIR")
            self.skipTest("the measured recordings are not there")
        for recording in recordings:
            with self.subTest(recording.name):
                done = self.must_do("replay", recording, "--machine", MACHINES / machine, "--json", "-")
                result = json.loads(done.stdout)
                self.assertEqual(result["frames"]["accepted"], result["recording"]["rows"])
                self.assert_no_wear(result)
                yield result

    def assert_no_wear(self, result):
        self.assertEqual(result["health"]["state"], "NOT_ENOUGH_DATA")
        self.assertEqual(result["chip_load_mm"]["state"], "undetermined")
        self.assertIsNone(result["chip_load_mm"]["estimate"])
        self.assertIsNone(result["bank"]["selected"])

    @staticmethod
    def evaluated(result):
        return {part["part"] for part in result["evaluation"] if part["evaluated"]}

    def test_a_feed_axis_alone_gives_the_feed_balance_only(self):
        for result in self.results("emps", "emps.toml"):
            self.assertEqual(self.evaluated(result), {"feed force balance"})

    def test_voltage_and_speed_alone_give_the_spindle_response_only(self):
        for result in self.results("motorxplorer", "motorxplorer.toml"):
            self.assertEqual(self.evaluated(result), {"spindle response (both balances in one)"})
            objections = [part["reason"] for part in result["evaluation"] if part["evaluated"]]
            self.assertIn("does not behave as its model says", objections[0], "the motor has stiction, its model none")

    def test_what_the_machine_file_does_not_describe_has_no_datasheet_value(self):
        for result in self.results("emps", "emps.toml"):
            values = {entry["name"]: entry["datasheet"] for entry in result["parameters"]}
            self.assertEqual(values["mass_kg"], 95.109)
            self.assertIsNone(values["resistance_ohm"])


if __name__ == "__main__":
    unittest.main()
