"""The gap of measured machines: which effects are named, and that an ambiguous one is not named alone.

The recordings are not part of this project: MOREPRO_SHARED_DIR names the folder that holds data/."""

import json
import unittest

from program import HERE, SHARED, ProgramTest

VISCOUS_AXIS = """[machine]
name = "axis"
[feed]
mass_kg = 100
viscous_friction_ns_m = 200
[sampling]
rate_hz = 1000
[sensors.feed_position_m]
noise = 1e-6
"""
FRICTION = {"spindle_coulomb_friction", "spindle_stribeck_friction"}


class MeasuredGap(ProgramTest):
    def recording(self, *place):
        path = SHARED.joinpath("data", *place)
        if not path.exists():
            print(f"skipped: {path} is not there; set MOREPRO_SHARED_DIR")
            self.skipTest("the measured recordings are not there")
        return path

    def diagnose(self, recording, machine, *options):
        done = self.must_do("diagnose", recording, "--machine", machine, "--bootstrap", 50, "--json", "-", *options)
        return json.loads(done.stdout)


class BallScrewAxis(MeasuredGap):
    training = None

    def of_training(self):
        """What is found in the training recording, and the machine file with it; found once for all tests."""
        if BallScrewAxis.training is None:
            applied = self.folder / "applied.toml"
            result = self.diagnose(self.recording("emps", "train.csv"), self.write("axis.toml", VISCOUS_AXIS),
                                   "--apply", applied)
            BallScrewAxis.training = result, applied.read_text()
        return BallScrewAxis.training

    def test_is_told_its_friction_and_its_offset_and_the_direction_dependence(self):
        result, _ = self.of_training()
        found = {effect["effect"]: effect for effect in result["which"]}
        self.assertEqual(result["verdict"], "effect")
        self.assertEqual(result["which"][0]["effect"], "feed_coulomb_friction")
        self.assertLessEqual({"feed_force_offset", "feed_asymmetric_friction"}, set(found))
        # Published, with a direction-dependent friction: 20.14 and 20.63 N.
        self.assertAlmostEqual(found["feed_coulomb_friction"]["magnitude"], 20.4, delta=0.03 * 20.4)
        self.assertAlmostEqual(found["feed_force_offset"]["magnitude"], -0.245, delta=0.2)
        values = {parameter["name"]: parameter["refit"] for parameter in result["parameters"]}
        self.assertAlmostEqual(values["mass_kg"], 95.109, delta=0.02 * 95.109)
        self.assertAlmostEqual(values["viscous_friction_ns_m"], 203.5, delta=0.02 * 203.5)
        free_run = result["shrinkage"]["free_run_nrmse"]["feed_force"]
        self.assertLess(free_run["with_effect"], 0.2 * free_run["refit"])

    def test_what_was_found_explains_another_recording(self):
        _, applied = self.of_training()
        pulses = self.recording("emps", "test.csv")
        before, after = (self.diagnose(pulses, machine)["shrinkage"]["free_run_nrmse"]["feed_force"]["datasheet"]
                         for machine in (self.write("axis.toml", VISCOUS_AXIS), self.write("applied.toml", applied)))
        self.assertLess(after, 0.1 * before)


class MotorWithoutACurrentSensor(MeasuredGap):
    def test_friction_and_voltage_drop_are_one_alias_set(self):
        for name in ("chirp_1", "stair_1", "stair_2"):
            with self.subTest(name):
                result = self.diagnose(self.recording("motorxplorer", f"{name}.csv"), HERE / "machines/motorxplorer.toml")
                aliases = set(result["which"][0]["alias_set"])
                self.assertTrue(aliases & FRICTION and "brush_voltage_drop" in aliases, aliases)
                self.assertLess(result["which"][0]["confidence"], 0.5)


if __name__ == "__main__":
    unittest.main()
