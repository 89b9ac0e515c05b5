"""What of a machine can be diagnosed where a recording or a machine file has only some of it."""

import json
import unittest

from diagnose_program import DRIVE, SPINDLE, Diagnose


class PartialRecording(Diagnose):
    def test_a_feed_axis_alone(self):
        self.simulate("--effect", "feed_coulomb_friction=6", duration=3)
        self.keep_columns("feed_force_n", "feed_speed_m_s", "contact")
        result = self.diagnose(recording="part.csv")
        self.assertIn("feed_coulomb_friction", result["which"][0]["alias_set"])
        evaluated = {balance["balance"]: balance["evaluated"] for balance in result["where"]}
        self.assertEqual(evaluated, {"feed_force": True, "spindle_torque": False, "armature_voltage": False})

    def test_a_cut_that_nobody_has_recorded_is_warned_of(self):
        # 16 N of it, with the position alone, were process noise: "no_gap", without a word.
        self.simulate(duration=2)
        for contact in ([], ["contact"]):
            self.keep_columns("feed_force_n", "feed_position_m", *contact)
            done = self.must_do("diagnose", "part.csv", "--bootstrap", 10)
            is_warned = "contact is not recorded: the tool is taken to be in the air" in done.stderr
            self.assertEqual(is_warned, not contact)

    def test_a_spindle_without_a_current_sensor(self):
        self.simulate()
        self.keep_columns(*SPINDLE, "contact", "chip_load_mm", "tool_temperature_degc")
        self.assertEqual(self.diagnose(recording="part.csv")["which"], [])

    def test_a_gap_without_a_current_sensor_is_the_torques_and_closes(self):
        # The winding lets a voltage through late; where its current is not recorded that is no gap.
        self.simulate("--effect", "supply_voltage_offset=0.5", "--datasheet-error", 0.1, "--machine-out", "wrong.toml",
                      profile="commissioning")
        self.keep_columns(*SPINDLE, "contact", "chip_load_mm", "tool_temperature_degc")
        result = self.diagnose("--machine", "wrong.toml", recording="part.csv")
        self.assertIn("supply_voltage_offset", result["which"][0]["alias_set"])
        torque = next(b for b in result["where"] if b["balance"] == "spindle_torque")
        self.assertGreater(torque["residual_ratio"], 2.0)
        self.assertLess(torque["residual_ratio_after"], 1.2)
        self.assertGreater(result["shrinkage"]["share_closed"], 0.9)
        self.assertTrue(torque["significant"])

    def test_a_warm_tool_that_nobody_has_measured_is_not_taken_for_a_worn_one(self):
        self.simulate("--effect", "contact_temperature_dependence=0.2", duration=8, profile="production")
        self.keep_columns(*SPINDLE, "armature_current_a", "contact", "chip_load_mm")
        done = self.must_do("diagnose", "part.csv", "--bootstrap", 20, "--json", "part.json")
        self.assertIn("tool_temperature_degc is not recorded: contact_temperature_dependence is not looked for", done.stderr)
        first = json.loads((self.folder / "part.json").read_text())["which"][0]
        self.assertIn("contact_temperature_dependence", first["alias_set"])
        self.assertLess(first["confidence"], 0.6)

    def test_a_chip_load_that_nobody_has_recorded_is_said(self):
        self.simulate(duration=2)
        self.keep_columns(*SPINDLE, "armature_current_a", "contact", "tool_temperature_degc")
        done = self.must_do("diagnose", "part.csv", "--bootstrap", 0, "--json", "part.json")
        self.assertIn("chip_load_mm is not recorded: the machine file's is taken", done.stderr)
        self.assertNotIn("contact_chip_load_dependence", self.names(json.loads((self.folder / "part.json").read_text())))

    def test_a_spindle_without_its_voltage_is_driven_by_its_current(self):
        self.simulate("--effect", "tool_wear_ramp=0.02", "--datasheet-error", 0.1, "--machine-out", "wrong.toml")
        self.keep_columns(*DRIVE)
        result = self.diagnose("--machine", "wrong.toml", "--apply", "found.toml", recording="part.csv")
        self.assertEqual(self.names(result), ["tool_wear_ramp"])
        self.assertAlmostEqual(result["which"][0]["magnitude"], 0.02, delta=0.001)
        where = {balance["balance"]: balance for balance in result["where"]}
        self.assertTrue(where["spindle_torque"]["significant"])
        self.assertEqual(where["armature_voltage"]["reason"], "not recorded: armature_voltage_v")
        parameters = {p["name"]: p for p in result["parameters"]}
        self.assertAlmostEqual(parameters["inertia_kgm2"]["refit"], 1.2e-4, delta=2e-6)
        for name in ("resistance_ohm", "back_emf_constant_vs_rad", "inductance_h"):
            self.assertFalse(parameters[name]["identifiable"], name)
            self.assertEqual(parameters[name]["refit"], parameters[name]["datasheet"], name)
            line = next(line for line in (self.folder / "wrong.toml").read_text().splitlines() if name in line)
            self.assertIn(line, (self.folder / "found.toml").read_text())

    def test_a_wrong_current_that_drives_a_spindle_is_told_from_a_wrong_speed(self):
        self.simulate("--effect", "current_bias=0.2")
        self.keep_columns(*DRIVE)
        result = self.diagnose(recording="part.csv")
        self.assertEqual(self.names(result), ["current_bias"])
        self.assertAlmostEqual(result["which"][0]["magnitude"], 0.2, delta=0.01)

    def test_a_current_that_drives_a_spindle_is_found_again_behind_lost_rows(self):
        # What it changed by is not known there: only the sensor tells.
        self.simulate("--effect", "current_bias=0.2")
        self.keep_columns(*DRIVE)
        lines = (self.folder / "part.csv").read_text().splitlines()
        self.write("part.csv", "\n".join(line for i, line in enumerate(lines) if i < 40 or i * 7919 % 25) + "\n")
        found = {effect["effect"]: effect for effect in self.diagnose(recording="part.csv")["which"]}
        self.assertEqual(set(found), {"sample_dropout", "current_bias"})
        self.assertAlmostEqual(found["current_bias"]["magnitude"], 0.2, delta=0.02)

    def test_a_late_current_that_drives_a_spindle_is_no_sure_shaft(self):
        self.simulate("--effect", "current_delay=3e-4")
        self.keep_columns(*DRIVE)
        done = self.must_do("diagnose", "part.csv", "--bootstrap", 0, "--json", "out.json")
        self.assertIn("armature_voltage_v is not recorded: the current drives the spindle", done.stderr)
        effect = json.loads((self.folder / "out.json").read_text())["which"][0]
        self.assertIn("current_delay", effect["alias_set"])
        self.assertLess(effect["confidence"], 0.5)

    def test_a_winding_whose_temperature_is_not_recorded_is_heated_by_its_current(self):
        for effect in ("resistance_temperature_drift=0.0039", "magnet_temperature_drift=-0.002"):
            with self.subTest(effect):
                self.simulate("--effect", effect, "--datasheet-error", 0.1, "--machine-out", "wrong.toml", duration=8)
                self.keep_columns(*SPINDLE, "armature_current_a", "contact", "chip_load_mm", "tool_temperature_degc")
                done = self.must_do("diagnose", "part.csv", "--machine", "wrong.toml", "--bootstrap", 0,
                                    "--json", "out.json", "--apply", "found.toml")
                self.assertIn("winding_temperature_degc is not recorded", done.stderr)
                result = json.loads((self.folder / "out.json").read_text())
                self.assertEqual(self.names(result), [effect.split("=")[0]])
                self.assertIsNone(result["which"][0]["magnitude"])
                self.assertIsNone(result["which"][0]["standard_error"])
                self.assertIn(f"{effect.split('=')[0]} = undetermined", done.stdout)
                # Its course is known, and that is what a model needs; a board's, too.
                self.assertTrue(result["board"]["agrees"], result["board"])
                self.assertGreater(self.value_of("winding_rise_k_a2", "found.toml"), 0.0)
                again = self.diagnose("--machine", "found.toml", recording="part.csv")
                self.assertEqual(again["verdict"], "no_gap")
                self.assertTrue(again["board"]["agrees"], again["board"])

    def test_a_winding_that_is_warmed_as_the_machine_file_says_has_a_size(self):
        sheet = self.must_do("config").stdout.replace("winding_time_constant_s = 0\n", "winding_time_constant_s = 4\n")
        self.write("sheet.toml", sheet.replace("winding_rise_k_a2 = 0\n", "winding_rise_k_a2 = 1.5\n"))
        self.simulate("--machine", "sheet.toml", "--effect", "resistance_temperature_drift=0.004")
        self.keep_columns(*SPINDLE, "armature_current_a", "contact", "chip_load_mm", "tool_temperature_degc")
        result = self.diagnose("--machine", "sheet.toml", recording="part.csv")
        self.assertEqual(self.names(result), ["resistance_temperature_drift"])
        # The machine is warmed by the mean of the squared current, the model by its samples.
        self.assertAlmostEqual(result["which"][0]["magnitude"], 0.004, delta=0.0002)

    def test_a_winding_whose_temperature_is_not_recorded_does_not_take_over(self):
        self.simulate("--effect", "brush_voltage_drop=0.1")
        self.keep_columns(*SPINDLE, "armature_current_a", "contact", "chip_load_mm", "tool_temperature_degc")
        self.assertEqual(self.names(self.diagnose(recording="part.csv")), ["brush_voltage_drop"])

    def test_what_is_not_evaluated_says_what_it_lacks(self):
        self.simulate(duration=2)
        self.keep_columns("feed_force_n", "feed_speed_m_s", "contact")
        result = self.diagnose(recording="part.csv")
        reasons = {balance["balance"]: balance.get("reason") for balance in result["where"]}
        self.assertEqual(reasons["spindle_torque"], "not recorded: armature_voltage_v, spindle_speed_rad_s")
        self.assertEqual(reasons["armature_voltage"],
                         "not recorded: armature_voltage_v, spindle_speed_rad_s, armature_current_a")

    def test_an_axis_known_by_its_position_alone_is_seen_at_the_full_rate(self):
        self.simulate("--datasheet-error", 0.2, "--machine-out", "wrong.toml", duration=4)
        self.keep_columns("feed_force_n", "feed_position_m", "contact", "engagement")
        result = self.diagnose("--machine", "wrong.toml", recording="part.csv")
        self.assertEqual(result["verdict"], "parameter_error")
        mass = {p["name"]: p for p in result["parameters"]}["mass_kg"]
        self.assertAlmostEqual(mass["refit"], 3.0, delta=max(5 * mass["standard_error"], 0.003))

    def test_samples_that_no_sensor_gives_are_missing_and_said_to_be(self):
        self.simulate()
        lines = (self.folder / "run.csv").read_text().splitlines(keepends=True)
        names = next(line for line in lines if line.startswith("time_s")).strip().split(",")
        place = names.index("spindle_speed_rad_s")
        first = next(i for i, line in enumerate(lines) if line[0].isdigit())
        for i in range(first + 500, first + 600):
            cells = lines[i].split(",")
            cells[place] = "-inf" if i % 2 else "9e9"
            lines[i] = ",".join(cells)
        self.write("wild.csv", "".join(lines))
        for command in ("diagnose", "identify"):
            done = self.must_do(command, "wild.csv")
            self.assertIn("spindle_speed_rad_s: 100 of ", done.stderr)
            self.assertIn("samples are outside -20000 .. 20000 and count as missing", done.stderr)

    def test_too_short_says_so(self):
        self.simulate(duration=0.05)
        result = self.diagnose()
        self.assertEqual(result["verdict"], "insufficient_excitation")
        self.assertEqual(result["which"], [])

    def test_nothing_that_moves_tells_nothing(self):
        rows = ["time_s,armature_voltage_v,spindle_speed_rad_s,armature_current_a"]
        rows += [f"{k * 1e-4:.4f},0,0,0" for k in range(5000)]
        self.write("run.csv", "\n".join(rows) + "\n")
        self.assertEqual(self.diagnose("--machine", "reference")["verdict"], "insufficient_excitation")


if __name__ == "__main__":
    unittest.main()
