"""The machine's parameters from a recording, as a user asks for them."""

import csv
import json
import unittest

from program import ProgramTest

SEVEN = ["torque_constant_nm_a", "inertia_kgm2", "mass_kg", "contact_force_n", "inductance_h", "resistance_ohm",
         "back_emf_constant_vs_rad"]
TRUE = {"torque_constant_nm_a": 0.08, "inertia_kgm2": 1.2e-4, "mass_kg": 3.0, "contact_force_n": 20.0,
        "inductance_h": 5e-4, "resistance_ohm": 0.8, "back_emf_constant_vs_rad": 0.08,
        "viscous_friction_nms_rad": 1e-4, "viscous_friction_ns_m": 200.0}
TRUE_OF_THESIS = {"torque_constant_nm_a": 1.5, "inertia_kgm2": 1e-3, "mass_kg": 3.0, "contact_force_n": 2.5,
                  "inductance_h": 1e-4, "resistance_ohm": 0.6, "back_emf_constant_vs_rad": 0.2}
SPINDLE = ("armature_voltage_v", "spindle_speed_rad_s", "armature_current_a", "contact", "chip_load_mm",
           "tool_temperature_degc")
FEED = ("feed_force_n", "feed_speed_m_s", "contact", "engagement")


class Identify(ProgramTest):
    def simulate(self, *options, duration=3, out="run.csv"):
        self.must_do("simulate", "--profile", "rich", "--duration", duration, "--seed", 7, "--datasheet-error", 0.2,
                     "--machine-out", "sheet.toml", *options, "--out", out)

    def identify(self, *options, recording="run.csv", machine="sheet.toml"):
        done = self.must_do("identify", recording, "--machine", machine, "--json", "-", *options)
        result = json.loads(done.stdout)
        self.assertEqual(result["schema"], "morepro.identification/1")
        return result, {entry["name"]: entry for entry in result["parameters"]}

    def keep_columns(self, *names):
        path = self.folder / "run.csv"
        text = [line for line in path.read_text().splitlines() if not line.startswith("#")]
        lines = ["time_s," + ",".join(names)]
        lines += [",".join(row[name] for name in ("time_s", *names)) for row in csv.DictReader(text)]
        self.write("part.csv", "\n".join(lines) + "\n")

    def check(self, entry):
        self.assertTrue(entry["identifiable"], entry)
        error = abs(entry["refit"] - TRUE[entry["name"]])
        self.assertLess(error, 4 * entry["standard_error"], entry)
        self.assertLess(error, 0.01 * TRUE[entry["name"]], entry)


class Results(Identify):
    def test_a_rich_recording_tells_everything_and_how_well(self):
        self.simulate()
        result, parameters = self.identify()
        self.assertEqual([entry["name"] for entry in result["parameters"]][:7], SEVEN)
        for entry in result["parameters"]:
            self.assertEqual(set(entry), {"name", "datasheet", "refit", "standard_error", "identifiable", "reason"})
            self.check(entry)
        self.assertIn("viscous_friction_ns_m", parameters)
        self.assertIn("contact_offset_n", parameters["contact_force_n"]["reason"])
        self.assertEqual(result["excitation"], {"sufficient": True, "advice": ""})

    def test_csv_and_native_recordings_say_the_same(self):
        self.simulate(duration=1)
        self.must_do("convert", "run.csv", "run.mrec")
        first, second = self.identify()[1], self.identify(recording="run.mrec")[1]
        for name in SEVEN:
            self.assertAlmostEqual(first[name]["refit"] / second[name]["refit"], 1.0, delta=1e-5)

    def test_the_machine_that_it_writes_is_the_machine(self):
        self.simulate()
        self.must_do("identify", "run.csv", "--machine", "sheet.toml", "--apply", "found.toml")
        for entry in self.identify(machine="found.toml")[0]["parameters"]:
            self.assertAlmostEqual(entry["datasheet"] / TRUE[entry["name"]], 1.0, delta=0.01)

    def test_a_machine_is_not_written_where_nothing_was_identified(self):
        rows = "".join(f"{k * 1e-4:.4f},48,577.7\n" for k in range(2000))
        self.write("run.csv", "time_s,armature_voltage_v,spindle_speed_rad_s\n" + rows)
        error = self.must_refuse(1, "identify", "run.csv", "--apply", "found.toml", "--json", "found.json")
        self.assertIn("nothing was identified", error)
        self.assertEqual(self.files(), ["run.csv"])

    def test_slow_sampling_is_as_honest(self):
        self.simulate("--rate", 1000, duration=10)
        for entry in self.identify()[0]["parameters"]:
            self.assertLess(abs(entry["refit"] - TRUE[entry["name"]]), 4 * entry["standard_error"], entry)

    def test_a_chip_load_outside_the_law_is_said(self):
        self.simulate(duration=1)
        path = self.folder / "run.csv"
        text = [line for line in path.read_text().splitlines() if not line.startswith("#")]
        rows = [dict(row, chip_load_mm="0.5") for row in csv.DictReader(text)]
        self.write("far.csv", "\n".join([text[0]] + [",".join(row.values()) for row in rows]) + "\n")
        outside = sum(float(row["contact"]) > 0.5 for row in rows)
        done = self.must_do("identify", "far.csv", "--machine", "sheet.toml")
        self.assertIn(f"outside the range of the contact law in {outside} rows of the cut", done.stderr)
        self.assertNotIn("outside the range", self.must_do("identify", "run.csv", "--machine", "sheet.toml").stderr)

    def test_a_person_can_read_it(self):
        self.simulate(duration=1)
        text = self.must_do("identify", "run.csv", "--machine", "sheet.toml").stdout
        for part in ("inertia_kgm2", "+-", "excitation", "datasheet"):
            self.assertIn(part, text)

    def test_derivatives_give_the_thesis_form(self):
        for machine, true in (("reference", TRUE), ("thesis", TRUE_OF_THESIS)):
            self.simulate("--machine", machine)
            result, parameters = self.identify("--filter", "derivatives")
            self.assertEqual(result["filter"], "derivatives")
            self.assertEqual(result["derivatives"], {"spindle_speed": "measured", "armature_current": "difference",
                                                     "feed_speed": "measured"})
            for name in SEVEN:
                self.assertTrue(parameters[name]["identifiable"], parameters[name])
                self.assertLess(abs(parameters[name]["refit"] - true[name]), 4 * parameters[name]["standard_error"],
                                parameters[name])
                self.assertAlmostEqual(parameters[name]["refit"] / true[name], 1.0, delta=0.02)

    def test_derivatives_that_are_not_recorded_are_differences(self):
        self.simulate()
        self.keep_columns(*SPINDLE)
        result, parameters = self.identify("--filter", "derivatives", recording="part.csv")
        self.assertEqual(result["derivatives"], {"spindle_speed": "difference", "armature_current": "difference"})
        for name in ("inductance_h", "resistance_ohm", "back_emf_constant_vs_rad"):
            self.assertTrue(parameters[name]["identifiable"], parameters[name])
        # Differences of this speed are noisier than its acceleration by 70: friction is not told, and it counts.
        for name in ("torque_constant_nm_a", "inertia_kgm2"):
            self.assertIn("viscous_friction_nms_rad", parameters[name]["reason"])
        for name in SEVEN:
            if parameters[name]["refit"] is not None:
                self.assertLess(abs(parameters[name]["refit"] - TRUE[name]), 4 * parameters[name]["standard_error"],
                                parameters[name])
        self.assertEqual(parameters["mass_kg"]["reason"], "not recorded: feed_force_n, feed_speed_m_s")
        text = self.must_do("identify", "part.csv", "--machine", "sheet.toml", "--filter", "derivatives").stdout
        self.assertIn("derivative  armature_current: difference over 0.1 ms", text)

    def test_a_period_longer_than_the_current_remembers_has_no_derivative(self):
        self.simulate("--rate", 500)
        parameters = self.identify("--filter", "derivatives")[1]
        self.assertIn("use --filter states", parameters["inductance_h"]["reason"])


class HalfAMachine(Identify):
    def test_a_feed_axis_alone(self):
        self.simulate()
        self.keep_columns(*FEED)
        parameters = self.identify(recording="part.csv")[1]
        for name in ("mass_kg", "contact_force_n"):
            self.check(parameters[name])
        self.assertFalse(parameters["inertia_kgm2"]["identifiable"])
        self.assertIsNone(parameters["inertia_kgm2"]["refit"])
        self.assertIn("armature_voltage_v", parameters["inertia_kgm2"]["reason"])

    def test_a_spindle_alone(self):
        self.simulate()
        self.keep_columns(*SPINDLE)
        parameters = self.identify(recording="part.csv")[1]
        for name in ("torque_constant_nm_a", "inertia_kgm2", "resistance_ohm", "back_emf_constant_vs_rad"):
            self.check(parameters[name])
        self.assertIn("not recorded: feed_force_n", parameters["mass_kg"]["reason"])

    def test_without_a_current_sensor_it_says_so(self):
        self.simulate(duration=1)
        self.keep_columns("armature_voltage_v", "spindle_speed_rad_s", "contact")
        parameters = self.identify(recording="part.csv")[1]
        self.assertEqual(parameters["resistance_ohm"]["reason"], "not recorded: armature_current_a")

    def test_nothing_that_moves_tells_nothing(self):
        rows = ["time_s,armature_voltage_v,spindle_speed_rad_s,armature_current_a"]
        rows += [f"{k * 1e-4:.4f},0,0,0" for k in range(5000)]
        self.write("run.csv", "\n".join(rows) + "\n")
        result, parameters = self.identify(machine="reference")
        self.assertFalse(any(entry["identifiable"] for entry in parameters.values()))
        self.assertFalse(result["excitation"]["sufficient"])
        self.assertTrue(result["excitation"]["advice"])


class SteadyCut(Identify):
    """The end of a step: the thesis's own excitation, nothing changes but what the controller answers to noise."""

    def steady(self, machine, seed=1):
        self.must_do("simulate", "--machine", machine, "--profile", "step", "--duration", 4, "--seed", seed, "--out",
                     "step.csv")
        lines = (self.folder / "step.csv").read_text().splitlines()
        head = [line for line in lines if not line[0].isdigit()]
        return self.write("steady.csv", "\n".join(head + lines[-15000:]) + "\n")

    def test_claims_nothing_false(self):
        for machine, true, seeds in (("reference", TRUE, (1, 4, 6)), ("thesis", TRUE_OF_THESIS, (1, 2))):
            for seed in seeds:
                parameters = self.identify(recording=self.steady(machine, seed), machine=machine)[1]
                for name in SEVEN:
                    if parameters[name]["identifiable"]:
                        error = abs(parameters[name]["refit"] - true[name])
                        self.assertLess(error, 4 * parameters[name]["standard_error"], (machine, seed, parameters[name]))

    def test_names_with_what_a_parameter_is_told_only_on_line_too(self):
        recording = self.steady("thesis")
        on_line = json.loads(self.must_do("replay", recording, "--json", "-").stdout)["parameters"]
        for entries in (self.identify(recording=recording, machine="thesis")[1].values(), on_line):
            reasons = {entry["name"]: entry["reason"] for entry in entries}
            self.assertIn("only a combination with back_emf_constant_vs_rad is", reasons["resistance_ohm"])
            self.assertIn("; it needs currents that vary", reasons["resistance_ohm"])
            self.assertIn("only a combination with resistance_ohm is", reasons["back_emf_constant_vs_rad"])
            self.assertIn("only together with contact_offset_n", reasons["contact_force_n"])
            self.assertIn("; it needs speeds that change", reasons["inertia_kgm2"])
        text = self.must_do("replay", recording).stdout
        self.assertIn("only a combination with back_emf_constant_vs_rad is determined; it needs", text)
        self.assertIn("only together with contact_offset_n", text)


class Mistakes(Identify):
    def test_are_refused_and_nothing_is_written(self):
        self.simulate(duration=0.2)
        self.must_refuse(2, "identify", "run.csv", "--filter", "magic", "--json", "a.json")
        self.must_refuse(2, "identify", "run.csv", "--json", "run.csv")
        self.must_refuse(1, "identify", "absent.csv", "--json", "a.json")
        self.write("text.csv", "time_s,armature_voltage_v\n0,1\n0.1,zwei\n")
        self.must_refuse(1, "identify", "text.csv", "--json", "a.json")
        self.assertEqual(self.files(), ["run.csv", "sheet.toml", "text.csv"])


if __name__ == "__main__":
    unittest.main()
