"""Every impossible machine file gets one sentence with file, line, column and key, and status 1."""

import unittest

from program import ProgramTest

GOOD = """[machine]
name = "mill"
[spindle]
torque_constant_nm_a = 0.08
back_emf_constant_vs_rad = 0.08
resistance_ohm = 0.8
inductance_h = 0.5e-3
inertia_kgm2 = 1.2e-4
viscous_friction_nms_rad = 1e-4
winding_time_constant_s = 8.0
winding_rise_k_a2 = 0.5
[feed]
mass_kg = 3
contact_force_n = 20
contact_offset_n = 2
engagement = 1
viscous_friction_ns_m = 200
screw_pitch_m = 0.005
[tool]
diameter_mm = 10
teeth = 4
chip_load_mm = 0.05
[contact]
form = "consistent"
viscous_gain_nms = 0
edge_force_n = 40
chip_force_n_mm = 1600
radius_m = 0.005
speed_scale_rad_s = 1
[thermal]
reference_degc = 400
melting_degc = 1400
exponent = 0.5535
tool_degc = 500
[sampling]
rate_hz = 10000
[sensors.spindle_speed_rad_s]
noise = 1
lsb = 0
[sensors.feed_speed_m_s]
noise = 0.002
[sensors.armature_current_a]
noise = 0.05
[gap]
speed_process_noise_rad_s = 0.01
current_process_noise_a = 5e-4
feed_process_noise_m_s = 2e-5
lost_share = 1e-3
clock_jitter_s = 1e-6
spindle_evidence = 25
spindle_temperature = 1
spindle_excitation = 5
spindle_noise_ratio = 1.5
spindle_parameter_spread = 0.01
feed_evidence = 30
feed_temperature = 1.5
feed_excitation = 6
feed_noise_ratio = 1.2
feed_parameter_spread = 0.3
[bank]
hypotheses = 8
first_hypothesis_mm = 0.03
hypothesis_step_mm = 0.01
rule = "markov"
[tuning]
chip_load_drift_mm = 5e-5
switch_probability = 1e-4
parameter_start_fraction = 0.3
[wear]
watch_ratio = 1.2
replace_ratio = 1.5
low_ratio = 0.8
hold_s = 0.1
datasheet_tolerance = 0.05
"""
GAP_NOISE = ["speed_process_noise_rad_s", "current_process_noise_a", "feed_process_noise_m_s", "lost_share", "clock_jitter_s"]
GAP_POSITIVE = ["spindle_evidence", "spindle_excitation", "spindle_noise_ratio", "spindle_parameter_spread",
                "feed_evidence", "feed_excitation", "feed_noise_ratio", "feed_parameter_spread"]
GAP_TEMPERATURES = ["spindle_temperature", "feed_temperature"]
GAP = GAP_NOISE + GAP_POSITIVE + GAP_TEMPERATURES
BANK = ["hypotheses", "first_hypothesis_mm", "hypothesis_step_mm"]
TUNING = ["chip_load_drift_mm", "switch_probability", "parameter_start_fraction"]
WEAR = ["watch_ratio", "replace_ratio", "low_ratio", "hold_s", "datasheet_tolerance"]
LINES = GOOD.count("\n")
POSITIVE = ["torque_constant_nm_a", "back_emf_constant_vs_rad", "resistance_ohm", "inductance_h", "inertia_kgm2",
            "mass_kg", "diameter_mm", "teeth", "chip_load_mm", "speed_scale_rad_s", "exponent"]
NOT_NEGATIVE = ["viscous_friction_nms_rad", "winding_time_constant_s", "winding_rise_k_a2",
                "contact_force_n", "contact_offset_n", "engagement",
                "viscous_friction_ns_m", "screw_pitch_m", "viscous_gain_nms", "edge_force_n", "chip_force_n_mm",
                "radius_m", "noise", "lsb"]
REQUIRED = ["torque_constant_nm_a", "back_emf_constant_vs_rad", "resistance_ohm", "inductance_h", "inertia_kgm2",
            "mass_kg", "diameter_mm", "teeth", "chip_load_mm", "form", "edge_force_n", "chip_force_n_mm", "radius_m",
            "reference_degc", "melting_degc", "exponent", "rate_hz", "noise"]


def line_of(key):
    return 1 + [line.split(" =")[0] for line in GOOD.splitlines()].index(key)


def with_value(key, value):
    lines = GOOD.splitlines()
    lines[line_of(key) - 1] = f"{key} = {value}"
    return "\n".join(lines)


def without(key):
    lines = GOOD.splitlines()
    del lines[line_of(key) - 1]
    return "\n".join(lines)


def wrong(key, value, *said):
    return with_value(key, value), f"line {line_of(key)}, column {len(key) + 4}", key, *said


def misspelt(key, name):
    return GOOD.replace(f"\n{key} =", f"\n{name} =", 1), f"line {line_of(key)}, column 1", f"'{name}'", f"'{key}'"


CORPUS = {
    **{f"{key} = 0": wrong(key, 0, "impossible") for key in POSITIVE},
    **{f"{key} = -1": wrong(key, -1, "impossible") for key in POSITIVE + NOT_NEGATIVE},
    **{f"{key} is text": wrong(key, '"much"', "no number") for key in POSITIVE + NOT_NEGATIVE},
    **{f"{key} is no value": wrong(key, "nan", "not finite") for key in POSITIVE[:4] + NOT_NEGATIVE[:4]},
    **{f"{key} is infinite": wrong(key, "inf", "not finite") for key in POSITIVE[:4] + NOT_NEGATIVE[:4]},
    **{f"{key} = {value}": wrong(key, value, "magnitude") for value in ("1e300", "1e-300", "1e30", "1e-40")
       for key in POSITIVE + NOT_NEGATIVE},
    **{f"{key} = -1 (gap)": wrong(key, -1, "impossible", f"gap.{key}") for key in GAP},
    **{f"{key} = 0 (gap)": wrong(key, 0, "impossible", "greater than 0") for key in GAP_POSITIVE},
    **{f"{key} = 0.9 (gap)": wrong(key, 0.9, "impossible", "at least 1") for key in GAP_TEMPERATURES},
    **{f"{key} is text (gap)": wrong(key, '"much"', "no number") for key in GAP},
    **{f"{key} is no value (gap)": wrong(key, "nan", "not finite") for key in GAP},
    **{f"{key} = 1e30 (gap)": wrong(key, "1e30", "magnitude") for key in GAP},
    **{f"{key} = -1 (wear)": wrong(key, -1, "impossible", f"wear.{key}") for key in WEAR},
    **{f"{key} is text (wear)": wrong(key, '"much"', "no number") for key in WEAR},
    **{f"{key} = {value}": wrong(key, value, "impossible", f"{table}.{key}") for value in (0, -1)
       for table, keys in (("bank", BANK), ("tuning", TUNING)) for key in keys},
    **{f"{key} is text": wrong(key, '"much"', "no number") for key in BANK + TUNING},
    **{f"{key} is no value": wrong(key, "nan", "not finite") for key in BANK + TUNING},
    "half a hypothesis": wrong("hypotheses", 7.5, "whole number from 1 to 11"),
    "more hypotheses than the bank holds": wrong("hypotheses", 12, "whole number from 1 to 11", "holds no more"),
    "hypotheses beyond the law": wrong("hypotheses", 10, "0.12 mm, is outside", "0.02 .. 0.1175 mm", "fewer"),
    "hypotheses below the law": wrong("first_hypothesis_mm", 0.01, "outside", "0.02 .. 0.1175 mm"),
    "a switch that is certain": wrong("switch_probability", 1, "impossible", "less than 1"),
    "unknown rule": wrong("rule", '"baysian"', "did you mean 'bayesian'?"),
    "rule is a number": wrong("rule", 1, "bank.rule is neither"),
    "misspelt hypotheses": misspelt("hypotheses", "hypothesis"),
    "forgotten unit of a step": misspelt("hypothesis_step_mm", "hypothesis_step"),
    "misspelt probability": misspelt("switch_probability", "switch_probabilty"),
    "misspelt tuning": (GOOD + "[tunning]\n", f"line {LINES + 1}", "'tunning'", "'tuning'"),
    "bank without contact": ("[feed]\nmass_kg = 3\n[bank]\nhypotheses = 3\n", "line 4", "bank.hypotheses needs [tool]"),
    "nothing is too little": wrong("low_ratio", 0, "impossible", "greater than 0"),
    "a sharp tool cuts too little": wrong("low_ratio", 1.1, "impossible", "at most 1"),
    "replace before watch": wrong("replace_ratio", 1.1, "smaller than watch_ratio = 1.2"),
    "watch after replace": (GOOD.replace("replace_ratio = 1.5\n", "").replace("watch_ratio = 1.2", "watch_ratio = 1.6"),
                            f"line {GOOD[:GOOD.index('watch_ratio')].count(chr(10)) + 1}", "smaller than"),
    "misspelt wear": misspelt("watch_ratio", "wach_ratio"),
    "misspelt evidence": misspelt("spindle_evidence", "spindel_evidence"),
    "gap is a number": ("gap = 3\n" + GOOD[:GOOD.index("[gap]")], "line 1", "no table"),
    "deafening sensor": wrong("noise", "1e6", "magnitude"),
    **{f"no {key}": (without(key), "line ", f"'{key}'") for key in REQUIRED},
    "cold melting point": wrong("melting_degc", 300, "impossible", "400"),
    "half a tooth": wrong("teeth", 3.5, "whole"),
    "thick chip": wrong("chip_load_mm", 0.5, "outside", "0.02 .. 0.1175"),
    "thin chip": wrong("chip_load_mm", 0.001, "outside"),
    "slow sampling": wrong("rate_hz", 10, "100 .. 20000"),
    "fast sampling": wrong("rate_hz", 1e6, "100 .. 20000"),
    "unknown form": wrong("form", '"thesys"', "consistent"),
    "form is a number": wrong("form", 1, "consistent"),
    "name is a number": wrong("name", 1, "no text"),
    "exact sensor": wrong("noise", 0, "no sensor is exact"),
    "misspelt resistance": misspelt("resistance_ohm", "resistence_ohm"),
    "forgotten unit": misspelt("mass_kg", "mass"),
    "misspelt teeth": misspelt("teeth", "teath"),
    "misspelt noise": misspelt("noise", "nois"),
    "unknown key": (GOOD.replace("mass_kg", "colour"), "line 13, column 1", "'colour'"),
    "unknown table": (GOOD + "[spindel]\n", f"line {LINES + 1}", "'spindel'", "'spindle'"),
    "unknown sensor": (GOOD + "[sensors.speed]\nnoise = 1\n", f"line {LINES + 1}", "'speed'"),
    "table is a number": ("spindle = 3\n", "line 1", "no table"),
    "sensor is a number": (GOOD.replace("[sensors.armature_current_a]\nnoise", "[sensors]\narmature_current_a"), "line 43",
                           "no table"),
    "contact without tool": (GOOD.replace("[tool]\ndiameter_mm = 10\nteeth = 4\nchip_load_mm = 0.05\n", ""), "[tool]"),
    "no axis": ('[machine]\nname = "nothing"\n', "[spindle]", "[feed]"),
    "empty file": ("", "[spindle]"),
    "open bracket": (GOOD + "[thermal2\n", f"line {LINES + 1}", "TOML"),
    "open text": ('[machine]\nname = "mill\n', "line 2", "TOML"),
    "no value": ("[feed]\nmass_kg =\n", "line 2", "TOML"),
    "decimal comma": ("[feed]\nmass_kg = 3,5\n", "line 2", "TOML"),
    "unit behind the value": ("[feed]\nmass_kg = 3 kg\n", "line 2", "TOML"),
    "key twice": ("[feed]\nmass_kg = 3\nmass_kg = 4\n", "line 3", "TOML"),
    "table twice": ("[feed]\nmass_kg = 3\n[feed]\nmass_kg = 3\n", "line 3", "TOML"),
    "binary": (bytes([0, 1, 2, 255, 254]), "line 1", "TOML"),
    "CSV": ("time_s,contact\n0,1\n", "line 1", "TOML"),
}


class BadMachineFile(ProgramTest):
    def test_the_corpus_holds_two_hundred_files(self):
        self.assertGreaterEqual(len(CORPUS), 200)

    def test_the_machine_that_the_corpus_damages_is_good(self):
        self.must_do("config", "--machine", self.write("good.toml", GOOD))

    def test_every_one_is_refused_with_its_place(self):
        for name, (content, *said) in CORPUS.items():
            with self.subTest(name):
                machine = self.write("bad.toml", content)
                sentence = self.must_refuse(1, "config", "--machine", machine, "--out", "out.toml")
                for words in ("bad.toml", *said):
                    self.assertIn(words, sentence)
                self.assertEqual(self.files(), ["bad.toml"])

    def test_a_noise_too_small_for_the_estimators_is_refused_with_its_place(self):
        machine = self.write("quiet.toml", with_value("noise", "1e-12"))
        recording = self.write("air.csv", "time_s,contact\n0,0\n0.0001,0\n0.0002,0\n")
        self.assertIn(f"quiet.toml, line {line_of('noise')}", self.must_refuse(1, "replay", recording, "--machine", machine))

    def test_a_missing_file_is_refused(self):
        self.assertIn("No such file", self.must_refuse(1, "config", "--machine", "./nothing.toml"))

    def test_an_unknown_machine_is_wrong_usage_with_a_suggestion(self):
        self.assertIn("'thesis'", self.must_refuse(2, "config", "--machine", "thesys"))

    def test_without_a_contact_law_a_spindle_in_contact_is_refused(self):
        machine = self.write("spindle.toml", GOOD[GOOD.index("[spindle]"):GOOD.index("[feed]")])
        recording = self.write("cut.csv", "time_s,armature_voltage_v,contact,spindle_speed_rad_s\n" +
                               "".join(f"{k * 0.0001:.4f},48,1,500\n" for k in range(5)))
        self.assertIn("[contact]", self.must_refuse(1, "replay", recording, "--machine", machine))


if __name__ == "__main__":
    unittest.main()
