"""The catalogue of effects, machines that have them, and what cannot be simulated."""

import csv
import io
import json
import unittest

from bad_machine_file_test import GOOD
from program import PROJECT, ProgramTest

SHORT = ["simulate", "--profile", "rich", "--duration", "0.2"]


class Catalogue(ProgramTest):
    def test_lists_every_effect_within_100_columns(self):
        lines = self.must_do("effects").stdout.splitlines()
        self.assertEqual(sum(line.startswith(("spindle", "feed")) for line in lines), 22)
        self.assertLessEqual(max(map(len, lines)), 100)

    def test_explains_one_effect(self):
        text = self.must_do("effects", "drive_lag").stdout
        for part in ("armature_voltage", "U = lagged(V) - V", "577.7 rad/s", "current_delay, current_bandwidth"):
            self.assertIn(part, text)
        self.assertIn("inverter dead time", self.must_do("effects", "brush_voltage_drop").stdout)

    def test_says_how_a_plain_law_bends(self):
        for name, bend in (("feed_force_saturation", "(F1/1 N)^2"), ("spindle_windage", "|w|/w0 - 1")):
            self.assertIn(f"a becomes a + b e, e = {bend}\n", self.must_do("effects", name).stdout)
        self.assertNotIn("bends", self.must_do("effects", "drive_lag").stdout)

    def test_the_reference_point_is_the_machines(self):
        self.assertIn("93.6 rad/s", self.must_do("effects", "drive_lag", "--machine", "thesis").stdout)

    def test_writes_the_catalogue_as_json(self):
        catalogue = json.loads(self.must_do("effects", "--json", "-").stdout)
        self.assertEqual(catalogue["schema"], "morepro.effects/1")
        self.assertEqual(len(catalogue["effects"]), 45)
        self.must_do("effects", "feed_backlash", "--json", "one.json")
        one = json.loads((self.folder / "one.json").read_text())["effects"]
        self.assertEqual([effect["unit"] for effect in one], ["m"])

    def test_the_table_of_the_readme_is_the_catalogue(self):
        readme = (PROJECT / "lib/gap/README.md").read_text()
        for effect in json.loads(self.must_do("effects", "--json", "-").stdout)["effects"]:
            aliases = [f"`{alias}`" for alias in effect["aliases"]] + [effect["other_causes"]] * bool(effect["other_causes"])
            equation = effect["equation"].replace("|", "\\|")
            row = f"| `{effect['effect']}` | {effect['balance']} | {effect['unit']} | {equation} | {', '.join(aliases)} |"
            self.assertIn(row, readme)

    def test_a_slip_of_the_keyboard_is_named(self):
        self.assertIn("did you mean 'feed_backlash'?", self.must_refuse(2, "effects", "feed_backlsh"))


class SimulatedEffects(ProgramTest):
    def simulate(self, *options):
        return self.must_do(*SHORT, *options, "--out", "-").stdout

    def column(self, text, name):
        rows = csv.DictReader(io.StringIO("".join(line for line in text.splitlines(True) if line[0] != "#")))
        return [float(row[name]) for row in rows]

    def test_every_effect_of_the_catalogue_can_be_simulated(self):
        names = [effect["effect"] for effect in json.loads(self.must_do("effects", "--json", "-").stdout)["effects"]]
        nominal = self.simulate()
        for name in names:
            with self.subTest(name):
                text = self.must_do("simulate", "--duration", "0.01", "--effect", f"{name}=1e-5", "--out", "-").stdout
                self.assertNotIn("nan", text)
        self.assertEqual(self.simulate("--effect", "drive_lag=0"), nominal)

    def test_effects_add_up_and_set_in(self):
        nominal = self.column(self.simulate(), "armature_current_a")
        both = self.column(self.simulate("--effect", "current_bias=1", "--effect", "current_bias=2,from=0.1"),
                           "armature_current_a")
        self.assertAlmostEqual(both[500] - nominal[500], 1.0, places=5)
        self.assertAlmostEqual(both[1500] - nominal[1500], 3.0, places=5)

    def test_lost_rows_leave_the_other_time_stamps(self):
        times = self.column(self.simulate("--effect", "sample_dropout=0.5"), "time_s")
        self.assertTrue(800 < len(times) < 1200)
        self.assertTrue(all(abs(1e4 * time - round(1e4 * time)) < 1e-6 for time in times))

    def test_process_noise_moves_the_machine(self):
        self.assertNotEqual(self.simulate("--process-noise", "0.1"), self.simulate())
        self.must_refuse(2, *SHORT, "--process-noise", "-1", "--out", "a.csv")

    def test_what_cannot_be_is_refused_with_the_reason(self):
        for option, reason in (("drive_lag", "write NAME=SIZE"),
                               ("drive_lagg=1", "did you mean 'drive_lag'?"),
                               ("drive_lag=fast", "'fast' is no number; write the size in s"),
                               ("drive_lag=nan", "is no number"),
                               ("drive_lag=inf", "is no number"),
                               ("drive_lag=1e99", "is no possible size"),
                               ("drive_lag=-1e-3", "must not be negative"),
                               ("current_delay=1", "delays up to 0.04 s"),
                               ("sample_dropout=1", "it is a fraction below 1"),
                               ("clock_jitter=1e-4", "a fifth of the sampling interval"),
                               ("current_bias=1,from=0.2", "outside the run of 0 .. 0.2 s"),
                               ("current_bias=1,from=-1", "outside the run"),
                               ("current_bias=1,from=x", "write from=SECONDS"),
                               ("current_bias=1,at=0.1", "write from=SECONDS")):
            with self.subTest(option):
                self.assertIn(reason, self.must_refuse(2, *SHORT, "--effect", option, "--out", "a.csv"))
        self.assertIn("too stiff",
                      self.must_refuse(1, *SHORT, "--effect", "feed_coulomb_friction=1e7", "--out", "a.csv"))
        for option in ("torque_constant_saturation=5e-4", "feed_asymmetric_friction=20"):  # drives one way
            with self.subTest(option):
                self.assertIn("an effect is larger", self.must_refuse(1, *SHORT, "--effect", option, "--out", "a.csv"))
        self.write("light.toml", GOOD.replace("inertia_kgm2 = 1.2e-4", "inertia_kgm2 = 1e-10"))
        self.assertIn("check the machine file's values",
                      self.must_refuse(1, *SHORT, "--machine", "light.toml", "--process-noise", 10, "--out", "a.csv"))
        self.assertEqual(self.files(), ["light.toml"])


class EffectsInMachineFiles(ProgramTest):
    def simulate(self, *options):
        self.must_do(*SHORT, *options, "--out", "run.csv")
        return (self.folder / "run.csv").read_text().split("\n", 1)[1]

    def test_are_simulated_like_those_of_the_command_line(self):
        self.write("plain.toml", GOOD)
        self.write("worn.toml", GOOD + '[[effects]]\nname = "feed_coulomb_friction"\nsize = 8\n'
                                       '[[effects]]\nname = "current_bias"\nsize = 1\nonset_s = 0.1\n')
        self.assertEqual(self.simulate("--machine", "worn.toml"),
                         self.simulate("--machine", "plain.toml", "--effect", "feed_coulomb_friction=8",
                                       "--effect", "current_bias=1,from=0.1"))

    def test_a_law_that_bends_is_simulated_so(self):
        law = '[[effects]]\nname = "spindle_windage"\nsize = 2e-6\n'
        runs = []
        for name, bend in (("plain", ""), ("straight", "coefficients = [2e-6, 0]\n"),
                           ("bent", "coefficients = [2e-6, 4e-6]\n")):
            self.write(f"{name}.toml", GOOD + law + bend)
            runs.append(self.simulate("--machine", f"{name}.toml"))
        self.assertEqual(runs[0], runs[1])
        self.assertNotEqual(runs[0], runs[2])

    def test_are_written_as_they_were_read(self):
        effects = ('\n[[effects]]\nname = "spindle_cogging"\nsize = 0.05\nshape = 12\ncoefficients = [0.03, 0.04]\n'
                   '\n[[effects]]\nname = "armature_reaction"\nsize = 0.001\nkind = 0\n'
                   '\n[[effects]]\nname = "feed_contact_drift"\nsize = 5\ncoefficients = [5, 2]\n'
                   '\n[[effects]]\nname = "drive_lag"\nsize = 0.0012\nonset_s = 0.5\n')
        self.write("worn.toml", GOOD + effects)
        text = self.must_do("config", "--machine", "worn.toml").stdout
        self.assertIn(effects, text)
        self.write("again.toml", text)
        self.assertEqual(self.must_do("config", "--machine", "again.toml").stdout, text)

    def test_mistakes_are_found_with_their_place(self):
        line = 1 + GOOD.count("\n")
        for effects, row, reason in (
                ('effects = 3\n', 0, "write [[effects]]"),
                ('[effects]\nname = "drive_lag"\n', 0, "write [[effects]]"),
                ('[[effects]]\nsize = 3\n', 0, "needs the name of an effect"),
                ('[[effects]]\nname = "drive_lag"\n', 0, "needs its size"),
                ('[[effects]]\nname = "drivelag"\nsize = 1\n', 1, "did you mean 'drive_lag'?"),
                ('[[effects]]\nname = "drive_lag"\nsize = "1"\n', 2, "is no number"),
                ('[[effects]]\nname = "drive_lag"\nsize = nan\n', 2, "is not finite"),
                ('[[effects]]\nname = "drive_lag"\nsize = -1\n', 2, "must not be negative"),
                ('[[effects]]\nname = "drive_lag"\nsize = 1\nonset = 2\n', 3, "did you mean 'onset_s'?"),
                ('[[effects]]\nname = "drive_lag"\nsize = 1\nonset_s = -2\n', 3, "is negative"),
                ('[[effects]]\nname = "drive_lag"\nsize = 1\nkind = 0.5\n', 3, "no whole number"),
                ('[[effects]]\nname = "drive_lag"\nsize = 1\nkind = 7\n', 1, "has no kind 7"),
                ('[[effects]]\nname = "current_bias"\nsize = 1\nshape = 2\n', 1, "has no shape"),
                ('[[effects]]\nname = "spindle_cogging"\nsize = 1\nshape = 0\n', 1, "must be greater than 0"),
                ('[[effects]]\nname = "current_bias"\nsize = 1\ncoefficients = [1, 0]\n', 1, "it can have 1 to 1"),
                ('[[effects]]\nname = "current_bias"\nsize = 1\ncoefficients = []\n', 3, "between brackets"),
                ('[[effects]]\nname = "current_bias"\nsize = 1\ncoefficients = ["1"]\n', 3, "is no number"),
                ('[[effects]]\nname = "current_bias"\nsize = 1\ncoefficients = [2]\n', 2, "coefficients make it 2")):
            with self.subTest(effects):
                is_first = effects.startswith("effects =")
                self.must_find(effects + GOOD if is_first else GOOD + effects, 1 if is_first else line + row, reason)

    def must_find(self, content, line, reason):
        self.write("bad.toml", content)
        sentence = self.must_refuse(1, "config", "--machine", "bad.toml")
        self.assertIn(reason, sentence)
        self.assertIn(f"bad.toml, line {line}, column ", sentence)

    def test_mistakes_in_what_a_board_looks_for_are_found_too(self):
        feed = "[feed]\nmass_kg = 3\n"
        many = ('[[gap.forms]]\nname = "feed_screw_periodic"\nparts = 2\n' * 3)
        for forms, row, reason in (
                ('[gap]\nforms = 3\n', 1, "write [[gap.forms]]"),
                ('[[gap.forms]]\nshape = 3\n', 0, "needs the name of an effect"),
                ('[[gap.forms]]\nname = "feed_springs"\n', 1, "did you mean 'feed_spring'?"),
                ('[[gap.forms]]\nname = "feed_spring"\nsize = 3\n', 2, "not known"),
                ('[[gap.forms]]\nname = "feed_force_offset"\nparts = 2\n', 1, "it can have 1 to 1"),
                ('[[gap.forms]]\nname = "feed_coulomb_friction"\n', 1, "must be greater than 0"),
                ('[[gap.forms]]\nname = "clock_jitter"\n', 1, "no signature"),
                ('[[gap.forms]]\nname = "drive_lag"\nshape = 1e-3\n', 1, "needs [spindle]"),
                (many, 7, "room for 4 forms with 4 parts")):
            with self.subTest(forms):
                self.must_find(feed + forms, 3 + row, reason)

    def test_that_the_rate_cannot_show_are_refused(self):
        self.write("worn.toml", GOOD + '[[effects]]\nname = "clock_jitter"\nsize = 1e-3\n')
        self.assertIn("machine 'mill': a jitter above a fifth",
                      self.must_refuse(1, *SHORT, "--machine", "worn.toml", "--out", "a.csv"))

    def test_a_form_that_a_faster_board_cannot_hold_is_left_out_with_a_word(self):
        self.write("mill.toml", GOOD + '[[gap.forms]]\nname = "current_delay"\nshape = 1e-3\n')
        for rate, said in ((10000, False), (20000, True)):
            self.must_do(*SHORT, "--rate", rate, "--out", "run.csv")
            words = self.must_do("replay", "run.csv", "--machine", "mill.toml").stderr
            self.assertEqual("its own form of current_delay" in words, said, words)

    def test_a_board_does_not_look_for_a_form_without_parts(self):
        self.must_do("simulate", "--profile", "rich", "--duration", 20, "--effect", "feed_force_offset=3", "--out", "run.csv")
        named = []
        for forms in "", '\n[[gap.forms]]\nname = "feed_force_offset"\nparts = 0\n':
            self.must_do("config", "--out", "mill.toml")
            self.write("mill.toml", (self.folder / "mill.toml").read_text() + forms)
            self.must_do("replay", "run.csv", "--machine", "mill.toml", "--json", "seen.json")
            named.append(json.loads((self.folder / "seen.json").read_text())["gap"]["effect"])
        self.assertEqual(named[0], "feed_force_offset")
        self.assertNotEqual(named[1], "feed_force_offset")

    def test_need_their_axis(self):
        feed = "[feed]\nmass_kg = 3\n"
        self.write("bad.toml", feed + '[[effects]]\nname = "brush_voltage_drop"\nsize = 1\n')
        self.assertIn("'brush_voltage_drop' needs [spindle]", self.must_refuse(1, "config", "--machine", "bad.toml"))


if __name__ == "__main__":
    unittest.main()
