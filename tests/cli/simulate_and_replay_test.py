"""The main job: a simulated recording goes in, chip load and health come out."""

import json
import re
import unittest

from program import ProgramTest

REPLAY_KEYS = {"schema", "frames", "chip_load_mm", "bank", "parameters", "gap", "health", "timing"}
GAP_KEYS = {"verdict", "where", "effect", "alias_set", "confidence", "evidence"}
OWN_SETTINGS = {"hypotheses": 5, "first_hypothesis_mm": 0.03, "hypothesis_step_mm": 0.0075,
                "speed_process_noise_rad_s": 0.5, "switch_probability": 0.002}


class SimulateAndReplay(ProgramTest):
    def replay(self, *arguments):
        return json.loads(self.must_do("replay", *arguments, "--json", "-").stdout)

    def test_the_chip_load_after_the_change_is_found(self):
        # Two steps of the continuous estimate's own standard error, and never a neighbouring hypothesis.
        for machine, chip_load_mm, selected in (("reference", 0.04, 2), ("thesis", 0.3, 2)):
            with self.subTest(machine):
                self.must_do("simulate", "--machine", machine, "--duration", "2", "--out", "run.csv")
                result = self.replay("run.csv")
                self.assertEqual(result["machine"], machine)
                self.assertEqual(result["frames"]["accepted"], 20000)
                self.assertEqual(result["chip_load_mm"]["state"], "valid")
                self.assertAlmostEqual(result["chip_load_mm"]["estimate"], chip_load_mm,
                                       delta=4 * result["chip_load_mm"]["standard_error"])
                self.assertEqual(result["bank"]["selected"], selected)
                self.assertEqual(result["health"]["state"], "HEALTHY")

    def test_json_has_the_keys_of_the_contract(self):
        self.must_do("simulate", "--duration", "0.5", "--out", "run.csv")
        result = self.replay("run.csv")
        self.assertLessEqual(REPLAY_KEYS, set(result))
        self.assertLessEqual({"accepted", "rejected", "missing", "reasons"}, set(result["frames"]))
        self.assertLessEqual({"estimate", "standard_error", "state"}, set(result["chip_load_mm"]))
        self.assertLessEqual({"hypotheses_mm", "probability", "selected", "rule"}, set(result["bank"]))
        self.assertLessEqual({"state", "reason"}, set(result["health"]))
        self.assertEqual(GAP_KEYS, set(result["gap"]))
        self.assertEqual(result["gap"], {"verdict": "not_enough_data", "where": None, "effect": None, "alias_set": [],
                                         "confidence": None, "evidence": None})
        self.assertAlmostEqual(sum(result["bank"]["probability"]), 1.0, delta=1e-5)
        for entry in result["parameters"]:
            self.assertLessEqual({"name", "datasheet", "refit", "standard_error", "identifiable", "reason"}, set(entry))

    def test_the_board_names_the_effect_of_a_machine(self):
        self.must_do("simulate", "--profile", "rich", "--duration", "8", "--seed", "5", "--effect", "feed_force_offset=2",
                     "--out", "run.mrec")
        result = self.replay("run.mrec")
        self.assertEqual(result["gap"]["verdict"], "effect")
        self.assertEqual(result["gap"]["where"], "feed_force")
        self.assertEqual(result["gap"]["effect"], "feed_force_offset")
        self.assertEqual(result["gap"]["alias_set"][0], "feed_force_offset")
        self.assertGreater(result["gap"]["confidence"], 0.9)
        self.assertGreater(result["gap"]["evidence"], 25)
        self.assertEqual(result["health"]["state"], "MODEL_GAP")
        self.assertIn("MODEL_EFFECT", result["health"]["reason"])
        self.assertIn("Gap         feed_force_offset", self.must_do("replay", "run.mrec").stdout)

    def test_the_board_finds_no_gap_in_a_machine_like_its_datasheet(self):
        self.must_do("simulate", "--profile", "rich", "--duration", "8", "--seed", "5", "--out", "run.mrec")
        result = self.replay("run.mrec")
        self.assertEqual(result["gap"]["verdict"], "no_gap")
        self.assertEqual(result["gap"]["alias_set"], [])
        self.assertIn("Gap         none", self.must_do("replay", "run.mrec").stdout)

    def simulate_with(self, *effects, out="run.csv", seed=5):
        options = [word for effect in effects for word in ("--effect", effect)]
        self.must_do("simulate", "--profile", "rich", "--duration", "8", "--seed", seed, *options, "--out", out)

    def chip_load_error_mm(self, result):
        """Of the last step of the commanded chip load."""
        rows = [line.split(",") for line in (self.folder / "run.csv").read_text().splitlines() if line[0] != "#"]
        column = rows[0].index("chip_load_mm")
        time_s = result["chip_load_mm"]["time_s"]
        commanded = [float(row[column]) for row in rows[1:] if float(row[0]) <= time_s]
        return abs(result["chip_load_mm"]["estimate"] - commanded[-1])

    def test_the_board_knows_what_a_diagnosis_has_found(self):
        self.simulate_with("spindle_coulomb_friction=0.03", "feed_force_offset=2")
        plain = self.replay("run.csv")
        self.assertEqual(plain["health"]["state"], "MODEL_GAP")
        self.must_do("diagnose", "run.csv", "--bootstrap", 20, "--apply", "found.toml")
        known = self.replay("run.csv", "--machine", "found.toml")
        self.assertEqual(known["gap"]["verdict"], "no_gap")
        self.assertNotEqual(known["health"]["state"], "MODEL_GAP")
        error = self.chip_load_error_mm(known)
        self.assertLess(error, 3 * known["chip_load_mm"]["standard_error"])
        self.assertLess(error, 0.2 * self.chip_load_error_mm(plain))
        for entry in known["parameters"]:
            self.assertTrue(entry["identifiable"], entry["name"])
            self.assertAlmostEqual(entry["refit"] / entry["datasheet"], 1.0, delta=0.01, msg=entry["name"])

    def test_a_clock_that_is_known_to_jitter_and_a_link_that_loses_are_no_gap(self):
        machine = self.must_do("config").stdout
        for effect, size, duration in ("clock_jitter", 2e-5, 20), ("sample_dropout", 0.02, 8):
            with self.subTest(effect):
                self.must_do("simulate", "--profile", "rich", "--duration", duration, "--seed", "5",
                             "--effect", f"{effect}={size}", "--out", "run.csv")
                self.assertEqual(self.replay("run.csv")["gap"]["effect"], effect)
                self.write("known.toml", f'{machine}[[effects]]\nname = "{effect}"\nsize = {size}\n')
                self.assertNotEqual(self.replay("run.csv", "--machine", "known.toml")["gap"]["verdict"], "effect")

    def test_a_native_recording_keeps_the_effects_of_its_machine(self):
        self.simulate_with("feed_force_offset=2")
        self.must_do("diagnose", "run.csv", "--bootstrap", 20, "--apply", "found.toml")
        self.must_do("convert", "run.csv", "run.mrec", "--machine", "found.toml")
        self.must_do("replay", "run.csv", "--machine", "found.toml", "--health-out", "csv.answers")
        self.assertEqual(self.replay("run.mrec", "--health-out", "mrec.answers")["gap"]["verdict"], "no_gap")
        self.assertEqual((self.folder / "csv.answers").read_bytes(), (self.folder / "mrec.answers").read_bytes())

    def test_effects_that_a_board_cannot_hold_are_named(self):
        machine = self.must_do("config").stdout
        five = ("spindle_windage", "drive_lag", "feed_force_offset", "current_bias", "supply_voltage_offset")
        tables = (f'[[effects]]\nname = "{name}"\nsize = 1e-6\n' for name in five)
        self.write("five.toml", machine + "".join(tables))
        self.write("slow.toml", machine + '[[effects]]\nname = "current_delay"\nsize = 2e-3\n')
        for file, name, why in (("five.toml", "supply_voltage_offset", "at most 4 effects"),
                                ("slow.toml", "current_delay", "up to 12 sampling intervals")):
            done = self.must_do("simulate", "--machine", file, "--duration", "0.5", "--out", "run.csv")
            self.assertEqual(done.stderr, "")
            done = self.must_do("replay", "run.csv", "--machine", file)
            self.assertEqual(done.stderr.count("warning"), 1, done.stderr)
            self.assertIn(name, done.stderr)
            self.assertIn(why, done.stderr)

    def test_a_seed_gives_the_same_file_and_another_seed_another(self):
        for name, seed in (("a.csv", 7), ("b.csv", 7), ("c.csv", 8)):
            self.must_do("simulate", "--duration", "0.1", "--seed", seed, "--out", name)
        a, b, c = ((self.folder / f"{name}.csv").read_text() for name in "abc")
        self.assertEqual(a, b)
        self.assertNotEqual(a.replace("seed: 7", ""), c.replace("seed: 8", ""))

    def test_csv_on_standard_output_is_the_csv_of_the_file(self):
        text = self.must_do("simulate", "--duration", "0.1", "--out", "-").stdout
        self.must_do("simulate", "--duration", "0.1", "--out", "run.csv")
        self.assertEqual(text, (self.folder / "run.csv").read_text())

    def test_csv_and_native_recording_give_the_same_answers(self):
        self.must_do("simulate", "--duration", "0.5", "--out", "run.csv")
        self.must_do("convert", "run.csv", "run.mrec")
        self.must_do("convert", "run.mrec", "back.csv")
        self.assertEqual((self.folder / "run.csv").read_text(), (self.folder / "back.csv").read_text())
        for name in ("run.csv", "run.mrec"):
            self.must_do("replay", name, "--health-out", name + ".answers")
        self.assertEqual((self.folder / "run.csv.answers").read_bytes(), (self.folder / "run.mrec.answers").read_bytes())

    def shifted(self, name, start_s):
        """A cut whose first time is start_s; the same rows otherwise."""
        self.must_do("simulate", "--duration", "1", "--out", "run.csv")
        lines = (self.folder / "run.csv").read_text().splitlines()
        rows = [line.split(",", 1) for line in lines[6:]]
        return self.write(name, "\n".join(lines[:6] + [f"{float(t) + start_s:.6f},{rest}" for t, rest in rows]) + "\n")

    def test_times_are_those_of_the_recording(self):
        for start_s in (1.7e9, -10.0, 5000.0):
            with self.subTest(start_s):
                shifted = self.shifted("shifted.csv", start_s)
                here, there = self.replay("run.csv"), self.replay(shifted)
                time_s = there["chip_load_mm"]["time_s"]
                self.assertAlmostEqual(time_s - start_s, here["chip_load_mm"]["time_s"], delta=2e-6)
                self.assertEqual(time_s, round(time_s, 6))
                self.must_do("replay", shifted, "--out", "frames.csv")
                first, second = (self.folder / "frames.csv").read_text().splitlines()[1:3]
                self.assertEqual(int(first.split(",")[1]), round(start_s * 1e6))
                self.assertEqual(int(second.split(",")[1]), round(start_s * 1e6) + 100)
                self.assertIn(f"(at {time_s:.4f} s", self.must_do("replay", shifted).stdout)

    def test_a_native_recording_keeps_the_start(self):
        for start_s in (1.7e9, -10.0, 5000.0, 0.0):
            with self.subTest(start_s):
                shifted = self.shifted("shifted.csv", start_s)
                self.must_do("convert", shifted, "shifted.mrec")
                self.must_do("convert", "shifted.mrec", "back.csv")
                self.assertEqual(shifted.read_text(), (self.folder / "back.csv").read_text())
                self.assertEqual(self.replay("shifted.mrec")["chip_load_mm"], self.replay(shifted)["chip_load_mm"])

    def test_a_rate_outside_the_monitors_is_the_recordings_fault(self):
        for step_s, rate in ((0.02, "50 Hz"), (2e-5, "50000 Hz")):
            rows = "".join(f"{k * step_s:.6f},1\n" for k in range(50))
            recording = self.write("rate.csv", "time_s,contact\n" + rows)
            sentence = self.must_refuse(1, "replay", recording, "--machine", "reference")
            self.assertIn(rate, sentence)
            self.assertIn("rate.csv", sentence)
            self.assertNotIn("machine", sentence)

    def test_a_machine_without_a_tool_has_no_hypotheses(self):
        self.must_do("simulate", "--duration", "0.1", "--machine-out", "machine.toml", "--out", "run.csv")
        air = self.write("air.csv", "\n".join((self.folder / "run.csv").read_text().splitlines()[:150]) + "\n")
        machine = (self.folder / "machine.toml").read_text()
        axes = machine[:machine.index("[tool]")] + machine[machine.index("[sampling]"):]
        result = self.replay(air, "--machine", self.write("axes.toml", axes))
        self.assertEqual(result["bank"]["hypotheses_mm"], [])
        self.assertEqual(result["bank"]["probability"], [])
        self.assertIsNone(result["bank"]["selected"])
        self.assertIn("[tool] and [contact]", result["health"]["reason"])
        self.assertNotIn("sensor", json.dumps(result["health"]))

    def test_the_rule_of_the_thesis_has_no_probabilities(self):
        self.must_do("simulate", "--duration", "1", "--out", "run.csv")
        bank = self.replay("run.csv", "--rule", "thesis")["bank"]
        self.assertEqual(bank["probability"], [])
        self.assertIsNotNone(bank["selected"])
        done = self.must_do("replay", "run.csv", "--rule", "thesis", "--out", "frames.csv")
        self.assertIn("(rule 'thesis' has no probabilities", done.stdout)
        rows = [row.split(",") for row in (self.folder / "frames.csv").read_text().splitlines()]
        self.assertEqual({row[rows[0].index("probability")] for row in rows[1:]}, {""})

    def test_missing_rows_are_missing_frames(self):
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        lines = (self.folder / "run.csv").read_text().splitlines()
        del lines[1000:1003], lines[1500]
        self.write("gaps.csv", "\n".join(lines) + "\n")
        result = self.replay("gaps.csv")
        self.assertEqual(result["recording"]["missing_rows"], 4)
        self.assertEqual(result["frames"]["missing"], 4)

    def test_values_that_are_no_measurement_are_rejected_with_their_reason(self):
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        lines = (self.folder / "run.csv").read_text().splitlines()
        column = lines[5].split(",").index("spindle_speed_rad_s")
        for row, text in ((1000, "inf"), (1001, "-inf"), (1100, "1e30"), (1101, "25000"), (1200, "nan"), (1201, "")):
            fields = lines[row].split(",")
            fields[column] = text
            lines[row] = ",".join(fields)
        self.write("odd.csv", "\n".join(lines) + "\n")
        result = self.replay("odd.csv")
        self.assertEqual(result["frames"]["reasons"]["not_finite"], 2)
        self.assertEqual(result["frames"]["reasons"]["out_of_range"], 2)
        self.assertEqual(result["frames"]["accepted"], 2000)

    def test_config_says_what_a_file_of_it_gets(self):
        for name in ("reference", "thesis"):
            self.must_do("config", "--machine", name, "--out", "machine.toml")
            said = (self.folder / "machine.toml").read_text()
            again = self.must_do("config", "--machine", "machine.toml").stdout
            self.assertIn(f" (--machine {name}: ", said)
            self.assertEqual(re.sub(r" \(--machine .*\)", "", said), again)

    def with_settings(self, name):
        """The reference machine's file with a bank and a tuning of its own: what config shows behind a # is stated."""
        text = self.must_do("config").stdout
        for key, value in OWN_SETTINGS.items():
            text = re.sub(rf"^# {key} = .*$", f"{key} = {value}", text, count=1, flags=re.MULTILINE)
        self.write(name, text.replace('rule = "markov"', 'rule = "bayesian"'))

    def settings_of(self, name):
        text = self.must_do("config", "--machine", name).stdout
        return {key: re.search(rf"^{key} = (\S+)", text, re.MULTILINE).group(1) for key in (*OWN_SETTINGS, "rule")}

    def test_hypotheses_and_tuning_are_those_of_the_machine_file(self):
        self.with_settings("own.toml")
        self.must_do("simulate", "--duration", "2", "--out", "run.csv")
        usual, own = self.replay("run.csv"), self.replay("run.csv", "--machine", "own.toml")
        self.assertEqual([round(x, 9) for x in own["bank"]["hypotheses_mm"]], [0.03, 0.0375, 0.045, 0.0525, 0.06])
        self.assertEqual(own["bank"]["rule"], "bayesian")
        self.assertEqual(len(usual["bank"]["hypotheses_mm"]), 10)
        self.assertNotEqual(own["chip_load_mm"]["standard_error"], usual["chip_load_mm"]["standard_error"])

    def test_commands_that_write_a_machine_keep_its_settings(self):
        self.with_settings("own.toml")
        said = {**{key: str(value) for key, value in OWN_SETTINGS.items()}, "rule": '"bayesian"'}
        self.assertEqual(self.settings_of("own.toml"), said)
        self.must_do("simulate", "--machine", "own.toml", "--profile", "rich", "--duration", "2", "--machine-out",
                     "sheet.toml", "--out", "run.mrec")
        self.must_do("identify", "run.mrec", "--machine", "own.toml", "--apply", "identified.toml")
        self.must_do("diagnose", "run.mrec", "--machine", "own.toml", "--bootstrap", "0", "--apply", "found.toml")
        # Without --machine it is the recording's, which was made with these settings.
        self.must_do("identify", "run.mrec", "--apply", "recorded.toml")
        for name in ("sheet.toml", "identified.toml", "found.toml", "recorded.toml"):
            self.assertEqual(self.settings_of(name), said, name)

    def test_the_datasheet_is_wrong_by_the_fraction(self):
        self.must_do("simulate", "--duration", "0.01", "--datasheet-error", "0.1", "--machine-out", "sheet.toml",
                     "--out", "run.csv")
        true = self.must_do("config").stdout.splitlines()
        sheet = self.must_do("config", "--machine", "sheet.toml").stdout.splitlines()
        off = {a.split(" = ")[0]: float(b.split(" = ")[1]) / float(a.split(" = ")[1])
               for a, b in zip(true, sheet) if a != b and not a.startswith("#")}
        self.assertEqual(len(off), 9)
        for ratio in off.values():
            self.assertAlmostEqual(abs(ratio - 1), 0.1, places=9)

    def test_a_machine_file_of_the_reference_machine_is_the_reference_machine(self):
        self.must_do("simulate", "--duration", "1", "--machine-out", "machine.toml", "--out", "run.csv")
        built_in, described = self.replay("run.csv"), self.replay("run.csv", "--machine", "machine.toml")
        self.assertEqual(built_in["bank"]["hypotheses_mm"], described["bank"]["hypotheses_mm"])
        self.assertEqual(built_in["bank"]["selected"], described["bank"]["selected"])

    def test_every_rule_can_be_chosen(self):
        self.must_do("simulate", "--duration", "1", "--out", "run.csv")
        for rule in ("markov", "bayesian", "thesis"):
            self.assertEqual(self.replay("run.csv", "--rule", rule)["bank"]["rule"], rule)

    def test_without_contact_nothing_is_selected(self):
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        lines = (self.folder / "run.csv").read_text().splitlines()
        self.write("air.csv", "\n".join(lines[:300]) + "\n")
        result = self.replay("air.csv")
        self.assertEqual(result["chip_load_mm"], {"estimate": None, "standard_error": None, "state": "undetermined"})
        self.assertEqual(result["health"]["state"], "NOT_ENOUGH_DATA")

    def test_without_the_column_contact_a_sensor_is_missing(self):
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        rows = [row.split(",") for row in (self.folder / "run.csv").read_text().splitlines() if row[0] != "#"]
        at = rows[0].index("contact")
        self.write("part.csv", "\n".join(",".join(row[:at] + row[at + 1:]) for row in rows) + "\n")
        health = self.replay("part.csv", "--machine", "reference")["health"]
        self.assertEqual(health["state"], "NOT_ENOUGH_DATA")
        self.assertIn("SENSOR_MISSING", health["reason"])
        self.assertNotIn("SENSOR_MISSING", self.replay("run.csv")["health"]["reason"])

    def test_a_step_and_a_prbs_do_what_they_say(self):
        for profile, values in (("step", (2, 2)), ("prbs", (3, 10))):
            self.must_do("simulate", "--profile", profile, "--duration", "1", "--out", "run.csv")
            rows = [row.split(",") for row in (self.folder / "run.csv").read_text().splitlines() if row[0] != "#"]
            voltages = [float(row[rows[0].index("armature_voltage_v")]) for row in rows[1:]]
            contact = [float(row[rows[0].index("contact")]) for row in rows[1:]]
            # Of the voltage: 0 and 48 V, or 48 V and two levels on it, of equal size; of the contact: changes.
            self.assertEqual((len({round(v, 3) for v in voltages}), 1 + sum(a != b for a, b in zip(contact, contact[1:]))),
                             values)
            self.assertAlmostEqual(max(voltages), 48.0 * (1.0 if profile == "step" else 1.25), delta=0.1)

    def test_a_frame_table_has_one_row_per_frame(self):
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        self.must_do("replay", "run.csv", "--out", "frames.csv")
        rows = (self.folder / "frames.csv").read_text().splitlines()
        self.assertEqual(len(rows), 2001)
        self.assertTrue(all(row.count(",") == rows[0].count(",") for row in rows))


if __name__ == "__main__":
    unittest.main()
