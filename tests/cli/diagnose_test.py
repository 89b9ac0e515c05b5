"""Where the model is wrong, which effect explains it, how far that shrinks the gap: as a user asks for it."""

import json
import random
import unittest

from diagnose_program import Diagnose


class Verdicts(Diagnose):
    def test_a_machine_like_its_datasheet_has_no_gap(self):
        self.simulate()
        result = self.diagnose()
        self.assertEqual(result["verdict"], "no_gap")
        self.assertEqual(result["which"], [])
        for balance in result["where"]:
            self.assertFalse(balance["significant"])
            self.assertAlmostEqual(balance["residual_ratio"], 1.0, delta=0.05)

    def test_a_wrong_datasheet_is_a_parameter_error_and_is_corrected(self):
        self.simulate("--datasheet-error", 0.2, "--machine-out", "wrong.toml")
        result = self.diagnose("--machine", "wrong.toml")
        self.assertEqual(result["verdict"], "parameter_error")
        self.assertEqual(result["which"], [])
        machine = json.loads(self.must_do("replay", "run.csv", "--json", "-").stdout)["parameters"]
        true = {entry["name"]: entry["datasheet"] for entry in machine}
        for entry in result["parameters"]:
            if entry["identifiable"] and true.get(entry["name"]):
                self.assertAlmostEqual(entry["refit"] / true[entry["name"]], 1.0, delta=0.01, msg=entry["name"])

    def test_names_an_effect_its_place_its_size_and_what_it_is_worth(self):
        self.simulate("--effect", "feed_force_offset=2", "--datasheet-error", 0.1, "--machine-out", "wrong.toml")
        result = self.diagnose("--machine", "wrong.toml")
        self.assertEqual(result["verdict"], "effect")
        self.assertEqual(self.names(result), ["feed_force_offset"])
        effect = result["which"][0]
        self.assertEqual(effect["unit"], "N")
        self.assertLess(abs(effect["magnitude"] - 2.0), max(0.1, 4.0 * effect["standard_error"]))
        self.assertGreater(effect["confidence"], 0.9)
        places = {balance["balance"]: balance for balance in result["where"]}
        self.assertTrue(places["feed_force"]["significant"])
        self.assertFalse(places["spindle_torque"]["significant"])
        self.assertGreater(places["feed_force"]["residual_ratio"], places["feed_force"]["residual_ratio_after"])
        self.assertGreater(result["shrinkage"]["share_closed"], 0.8)
        low, high = result["shrinkage"]["ci90"]
        self.assertLessEqual(low, result["shrinkage"]["share_closed"])
        self.assertGreaterEqual(high, result["shrinkage"]["share_closed"])

    def test_a_board_with_what_was_found_says_the_same(self):
        self.simulate("--effect", "feed_force_offset=2", duration=8)
        result = self.diagnose("--apply", "found.toml")
        board = result["board"]
        self.assertEqual((board["verdict"], board["effect"]), ("effect", "feed_force_offset"))
        self.assertIn("feed_force_offset", board["alias_set"])
        self.assertTrue(board["agrees"])
        stored = (self.folder / "found.toml").read_text()
        self.assertIn("[gap]", stored)
        self.assertIn("feed_evidence = ", stored)
        self.assertIn('[[gap.forms]]\nname = "feed_force_offset"\n', stored)
        self.must_do("config", "--machine", "found.toml")

    def test_says_when_an_effect_set_in(self):
        self.simulate("--effect", "current_bias=0.5,from=3")
        result = self.diagnose()
        self.assertEqual(self.names(result)[0], "current_bias")

    def late_offset_beside_a_wrong_datasheet(self, process_noise):
        self.simulate("--effect", "supply_voltage_offset=2.8,from=2.4", "--process-noise", process_noise,
                      "--datasheet-error", 0.25, "--seed", 2, "--machine-out", "wrong.toml", profile="production")
        result = self.diagnose("--machine", "wrong.toml")
        self.assertEqual(self.names(result), ["supply_voltage_offset"])
        self.assertAlmostEqual(result["which"][0]["magnitude"], 2.8, delta=0.05)
        return result

    def test_what_sets_in_late_keeps_its_size_beside_a_wrong_datasheet(self):
        # Known to a block of a quarter of a second only, the onset left a disturbance of 0.1 s, which bent the
        # parameters until nothing was left of the size.
        result = self.late_offset_beside_a_wrong_datasheet(0.1)
        voltage = next(b for b in result["where"] if b["balance"] == "armature_voltage")
        self.assertAlmostEqual(voltage["onset_s"], 2.4, delta=0.01)

    def test_what_sets_in_late_does_not_pass_for_noise(self):
        # Fitted with process noise, all of the recording looked like a wrong datasheet, with rows far beyond
        # what any noise makes: the time before the onset has to be looked at by itself.
        self.late_offset_beside_a_wrong_datasheet(0.3)

    def test_an_effect_out_of_the_catalogue_is_not_named(self):
        self.simulate("--effect", "spindle_windage=1e-6")
        self.assertEqual(self.names(self.diagnose()), ["spindle_windage"])
        self.assertNotIn("spindle_windage", self.names(self.diagnose("--exclude", "spindle_windage")))

    def test_samples_that_stand_alone_are_left_out_and_said(self):
        self.simulate("--effect", "feed_coulomb_friction=4", duration=3)
        self.change_cells("feed_position_m", (5000, 12000, 20000), by=0.002)
        done = self.must_do("diagnose", "run.csv", "--bootstrap", 0, "--json", "out.json")
        self.assertIn("feed_position_m: 3 samples stand alone", done.stderr)
        self.assertIn("the first at 0.5000 s", done.stderr)
        result = json.loads((self.folder / "out.json").read_text())
        self.assertEqual(self.names(result), ["feed_coulomb_friction"])

    def test_a_sensor_that_is_off_now_and_then_is_no_health(self):
        self.simulate(duration=4)
        places = random.Random(1)
        bursts = [range(first, first + 20) for first in (places.randrange(39980) for _ in range(40))]
        self.change_cells("spindle_speed_rad_s", (row for burst in bursts for row in burst), by=30.0)
        self.assertEqual(self.diagnose()["verdict"], "unexplained")

    def test_the_step_of_an_input_is_no_error_and_not_silent(self):
        self.simulate("--machine-out", "right.toml", duration=1)
        self.write("right.toml", (self.folder / "right.toml").read_text() +
                   "\n[sensors.feed_force_n]\nnoise = 0\nlsb = 0.2\n")
        done = self.must_do("diagnose", "run.csv", "--machine", "right.toml", "--bootstrap", 0)
        self.assertIn("[sensors.feed_force_n] is not used", done.stderr)

    def test_lost_rows_are_named_with_their_share(self):
        self.simulate("--effect", "sample_dropout=0.05")
        result = self.diagnose()
        found = {effect["effect"]: effect for effect in result["which"]}
        self.assertAlmostEqual(found["sample_dropout"]["magnitude"], 0.05, delta=0.01)

    def test_faults_of_the_samples_are_known_to_the_machine_that_is_written(self):
        for effect in "sensor_quantization=4", "sample_dropout=0.02", "clock_jitter=2e-5":
            self.simulate("--effect", effect)
            found = self.diagnose("--apply", "known.toml")
            self.assertEqual(self.names(found), [effect.split("=")[0]])
            self.assertTrue(found["board"]["agrees"], found["board"])
            again = self.diagnose("--machine", "known.toml")
            self.assertEqual(again["verdict"], "no_gap", effect)
            self.assertTrue(again["board"]["agrees"], again["board"])

    def test_a_board_takes_out_what_its_machine_file_states(self):
        for effect in "feed_coulomb_friction=6", "spindle_speed_bias=6", "current_delay=2e-4":
            with self.subTest(effect):
                self.simulate("--effect", effect, duration=4)
                self.diagnose("--apply", "known.toml")
                again = self.diagnose("--machine", "known.toml")
                self.assertEqual((again["verdict"], again["board"]["verdict"]), ("no_gap", "no_gap"))

    def test_lost_rows_do_not_hide_what_else_is_there(self):
        self.simulate("--effect", "feed_force_offset=2")
        lines = (self.folder / "run.csv").read_text().splitlines()
        kept = [line for i, line in enumerate(lines) if i < 40 or i * 7919 % 25]
        self.write("run.csv", "\n".join(kept) + "\n")
        result = self.diagnose()
        self.assertEqual(set(self.names(result)), {"sample_dropout", "feed_force_offset"})
        for balance in result["where"]:
            self.assertTrue(balance["evaluated"], balance)
        shown = self.must_do("diagnose", "run.csv", "--bootstrap", 0).stdout
        self.assertIn("feed_force_offset = ", shown)

    def test_a_screw_of_unknown_pitch(self):
        self.simulate("--effect", "feed_screw_periodic=4", "--machine-out", "sheet.toml")
        sheet = (self.folder / "sheet.toml").read_text().splitlines()
        self.write("sheet.toml", "\n".join(line for line in sheet if "screw_pitch_m" not in line) + "\n")
        result = self.diagnose("--machine", "sheet.toml")
        self.assertEqual(self.names(result), ["feed_screw_periodic"])
        self.assertAlmostEqual(result["which"][0]["magnitude"], 4.0, delta=5 * result["which"][0]["standard_error"])

    def test_says_what_the_scale_of_torques_rests_on(self):
        self.simulate("--machine-out", "sheet.toml")
        sheet = (self.folder / "sheet.toml").read_text()
        self.write("softer.toml", sheet.replace("edge_force_n = 40", "edge_force_n = 32")
                   .replace("chip_force_n_mm = 1600", "chip_force_n_mm = 1280"))
        result = self.diagnose("--machine", "softer.toml")
        self.assertEqual(result["verdict"], "parameter_error")
        torque = {p["name"]: p for p in result["parameters"]}["torque_constant_nm_a"]
        self.assertAlmostEqual(torque["refit"], 0.8 * 0.08, delta=0.002)
        self.assertIn("0.8 times the back-EMF constant", torque["reason"])

    def test_slow_sampling_is_no_gap(self):
        # An instant that covers several bins of a turn looked like a line over the angle.
        for rate_hz, seed in ((1000, 2), (1000, 3), (250, 1)):
            with self.subTest(rate_hz=rate_hz, seed=seed):
                self.simulate("--rate", rate_hz, "--seed", seed, duration=20)
                result = self.diagnose()
                self.assertEqual((result["verdict"], self.names(result)), ("no_gap", []))

    def test_a_link_that_was_away_is_no_effect_and_hides_none(self):
        for effects in ([], ["contact_speed_dependence"]):
            with self.subTest(effects):
                sizes = [word for name in effects for word in ("--effect", f"{name}=0.05")]
                self.simulate(*sizes, "--datasheet-error", 0.1, "--machine-out", "wrong.toml")
                self.lose_rows((2.5, 2.6), (4.3, 4.42))
                result = self.diagnose("--machine", "wrong.toml")
                self.assertEqual(self.names(result), effects)
                for parameter in result["parameters"]:
                    if parameter["name"] == "inertia_kgm2":
                        self.assertAlmostEqual(parameter["refit"], 1.2e-4, delta=4 * parameter["standard_error"])

    def test_wrong_values_are_found_beside_random_forces(self):
        # A fit that begins with an observer of long memory ends at 0.48 ohm.
        self.simulate("--process-noise", 1, "--datasheet-error", 0.2, "--machine-out", "wrong.toml", "--seed", 3,
                      duration=8, profile="production")
        result = self.diagnose("--machine", "wrong.toml")
        resistance = next(p for p in result["parameters"] if p["name"] == "resistance_ohm")
        self.assertAlmostEqual(resistance["refit"], 0.8, delta=0.01)

    def test_random_forces_that_last_are_no_effect_of_a_machine_that_hardly_moves(self):
        for seed in (1, 2):
            with self.subTest(seed=seed):
                self.simulate("--process-noise", 1, "--datasheet-error", 0.2, "--machine-out", "wrong.toml",
                              "--seed", seed, duration=8, profile="production")
                result = self.diagnose("--machine", "wrong.toml")
                self.assertEqual((result["verdict"], self.names(result)), ("parameter_error", []))


class TwoLagsInARow(Diagnose):
    def test_a_drive_is_not_given_the_lag_of_the_winding(self):
        # L/R is 0.625 ms, the drive's is half of it: exchanged, the two explain nearly as much.
        self.simulate("--effect", "drive_lag=3e-4", "--seed", 2, duration=8)
        result = self.diagnose("--machine", "reference")
        self.assertEqual(self.names(result), ["drive_lag"])
        self.assertAlmostEqual(result["which"][0]["magnitude"], 3e-4, delta=0.05 * 3e-4)


class NoisySensors(Diagnose):
    def test_leave_no_gap_open_that_the_right_effect_closes(self):
        # Fitted to noisy regressors alone, the voltage balance's coefficients are too small: 92 % were closed.
        self.simulate("--machine-out", "noisy.toml", duration=1)
        machine = (self.folder / "noisy.toml").read_text()
        for sensor, noise, more in (("spindle_speed_rad_s", 1, 4), ("armature_current_a", 0.05, 0.8)):
            head = f"[sensors.{sensor}]\nnoise = "
            self.assertIn(f"{head}{noise}\n", machine)
            machine = machine.replace(f"{head}{noise}\n", f"{head}{more}\n")
        self.write("noisy.toml", machine)
        self.simulate("--machine", "noisy.toml", "--effect", "spindle_speed_bias=8", duration=8, profile="commissioning")
        result = self.diagnose("--machine", "noisy.toml")
        self.assertIn("spindle_speed_bias", result["which"][0]["alias_set"])
        self.assertGreater(result["shrinkage"]["share_closed"], 0.95)


class Contract(Diagnose):
    def test_the_same_seed_gives_the_same_bytes(self):
        self.simulate("--effect", "drive_lag=5e-4", duration=2)
        first = self.must_do("diagnose", "run.csv", "--bootstrap", 20, "--json", "-").stdout
        self.assertEqual(first, self.must_do("diagnose", "run.csv", "--bootstrap", 20, "--json", "-").stdout)

    def test_json_has_the_keys_of_the_schema(self):
        self.simulate("--effect", "feed_spring=500", duration=4)
        result = self.diagnose()
        self.assertEqual(result["schema"], "morepro.diagnosis/1")
        self.assertEqual(set(result["recording"]), {"file", "rows", "rate_hz", "duration_s", "missing_rows"})
        self.assertEqual(result["recording"]["rows"], 40000)
        for balance in result["where"]:
            self.assertLessEqual({"balance", "evaluated", "residual_ratio", "residual_ratio_after", "significant",
                                  "cells", "onset_s"}, set(balance))
            times = [(cell["from"], cell["to"]) for cell in balance["cells"] if cell["by"] == "time"]
            self.assertTrue(all(before[1] == after[0] for before, after in zip(times, times[1:])), times)
        for effect in result["which"]:
            self.assertLessEqual({"effect", "confidence", "magnitude", "unit", "standard_error", "evidence", "alias_set",
                                  "separate_by"}, set(effect))
            self.assertIn(effect["effect"], effect["alias_set"])
            self.assertTrue(effect["separate_by"])
        for figure in ("one_step_nrmse", "free_run_nrmse"):
            for balance, intervals in result["shrinkage"][figure + "_ci90"].items():
                models = result["shrinkage"][figure][balance]
                self.assertEqual(set(models), {"datasheet", "refit", "with_effect", "noise_floor"})
                self.assertEqual(set(intervals), {"datasheet", "refit", "with_effect"})
                for name, (low, high) in intervals.items():
                    self.assertLess(low, high)
                    self.assertTrue(low <= models[name] <= high, f"{figure} {balance} {name}")
        self.assertEqual(result["threshold"]["bootstrap_runs"], 20)

    def test_a_person_can_read_it(self):
        self.simulate("--effect", "feed_force_offset=2", duration=4)
        text = self.must_do("diagnose", "run.csv", "--bootstrap", 20).stdout
        for part in ("feed_force_offset", "N", "%"):
            self.assertIn(part, text)
        printed = self.must_do("diagnose", "run.csv", "--bootstrap", 20, "--out", "result.txt").stdout
        self.assertEqual((printed, (self.folder / "result.txt").read_text()), ("", text))

    def test_mistakes_are_refused_and_nothing_is_written(self):
        self.simulate(duration=0.2)
        self.assertIn("did you mean 'drive_lag'?",
                      self.must_refuse(2, "diagnose", "run.csv", "--exclude", "drive_lagg", "--json", "a.json"))
        self.must_refuse(2, "diagnose", "run.csv", "--bootstrap", "-1")
        self.must_refuse(2, "diagnose", "run.csv", "--json", "run.csv")
        self.must_refuse(1, "diagnose", "absent.csv", "--json", "a.json")
        self.write("text.csv", "time_s,armature_voltage_v\n0,1\n0.1,zwei\n")
        self.must_refuse(1, "diagnose", "text.csv", "--json", "a.json")
        slow = "".join(f"{row / 5},1,10,0.1\n" for row in range(300))
        self.write("ms.csv", "time_s,armature_voltage_v,spindle_speed_rad_s,armature_current_a\n" + slow)
        self.assertIn("sampled at 5 Hz, a diagnosis needs 20 Hz",
                      self.must_refuse(1, "diagnose", "ms.csv", "--json", "a.json"))
        self.assertEqual(self.files(), ["ms.csv", "run.csv", "text.csv"])


if __name__ == "__main__":
    unittest.main()
