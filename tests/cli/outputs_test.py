"""Outputs are whole or not there; what cannot be written is said; wrong usage has status 2."""

import json
import os
import subprocess
import unittest

from program import PROGRAM, ProgramTest


class Outputs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.must_do("simulate", "--duration", "0.2", "--out", "run.csv")
        self.must_do("simulate", "--duration", "0.2", "--out", "run.mrec")

    def test_an_output_that_is_an_input_or_another_output_is_wrong_usage(self):
        self.must_do("simulate", "--duration", "0.1", "--machine-out", "machine.toml", "--out", "-")
        (self.folder / "link.csv").symlink_to("run.csv")
        os.link(self.folder / "run.csv", self.folder / "hard.csv")
        before = {name: (self.folder / name).read_bytes() for name in self.files()}
        for arguments in (["replay", "run.csv", "--out", "run.csv"], ["replay", "run.csv", "--json", "./run.csv"],
                          ["replay", "run.mrec", "--health-out", "run.mrec"], ["replay", "run.csv", "--out", "link.csv"],
                          ["replay", "run.csv", "--out", "hard.csv"], ["convert", "run.csv", "run.csv"],
                          ["replay", "run.csv", "--json", "-", "--out", "-"],
                          ["replay", "run.csv", "--json", "new", "--health-out", "./new"],
                          ["replay", "run.csv", "--machine", "machine.toml", "--out", "machine.toml"],
                          ["simulate", "--out", "new.csv", "--machine-out", "new.csv"],
                          ["simulate", "--out", "-", "--machine-out", "-"],
                          ["config", "--machine", "machine.toml", "--out", "machine.toml"]):
            with self.subTest(arguments):
                self.must_refuse(2, *arguments)
                self.assertEqual({name: (self.folder / name).read_bytes() for name in self.files()}, before)

    def test_two_outputs_may_go_to_one_device(self):
        self.must_do("replay", "run.csv", "--json", "/dev/null", "--out", "/dev/null")

    def test_what_cannot_be_written_is_said_before_the_work(self):
        (self.folder / "folder").mkdir()
        for option in ("--json", "--out", "--health-out"):
            for target in ("nowhere/result", "folder"):
                with self.subTest(option=option, target=target):
                    before = self.files()
                    sentence = self.must_refuse(1, "replay", "run.csv", option, target)
                    self.assertIn(f"cannot write {target}", sentence)
                    self.assertEqual(self.files(), before)

    def test_simulate_and_convert_say_what_cannot_be_written(self):
        self.assertIn("cannot write", self.must_refuse(1, "simulate", "--out", "nowhere/run.csv"))
        self.assertIn("cannot write", self.must_refuse(1, "convert", "run.csv", "nowhere/run.mrec"))
        self.assertIn("cannot write", self.must_refuse(1, "config", "--out", "nowhere/machine.toml"))

    def test_a_full_disk_is_said(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("this system has no /dev/full")
        self.assertIn("No space left", self.must_refuse(1, "config", "--out", "/dev/full"))

    def test_an_old_output_survives_a_failed_job(self):
        self.write("result.json", "old")
        self.write("bad.csv", "time_s,contact\n0,1\n1,x\n")
        self.must_refuse(1, "replay", "bad.csv", "--json", "result.json")
        self.assertEqual((self.folder / "result.json").read_text(), "old")

    def test_a_link_stays_a_link(self):
        self.write("target.json", "old")
        (self.folder / "link.json").symlink_to("target.json")
        self.must_do("replay", "run.csv", "--json", "link.json")
        self.assertTrue((self.folder / "link.json").is_symlink())
        self.assertEqual(json.loads((self.folder / "target.json").read_text())["schema"], "morepro.replay/1")

    def test_wrong_usage_has_status_2(self):
        for arguments in ([], ["fly"], ["replay"], ["replay", "run.csv", "--rule", "guess"], ["simulate"],
                          ["simulate", "--out", "run.xyz"], ["simulate", "--out", "a.csv", "--rate", "nan"],
                          ["simulate", "--out", "a.csv", "--rate", "5"], ["simulate", "--out", "a.csv", "--duration", "0"],
                          ["simulate", "--out", "a.csv", "--duration", "x"],
                          ["simulate", "--out", "a.csv", "--profile", "idle"],
                          ["simulate", "--out", "a.csv", "--datasheet-error", "2"],
                          ["simulate", "--out", "a.csv", "--seed", "-1"],
                          ["replay", "run.txt"], ["convert", "run.csv"], ["convert", "run.csv", "run.h5"],
                          ["replay", "run.csv", "--machine", "thesys"], ["replay", "run.csv", "--no-such-option"]):
            with self.subTest(arguments):
                self.must_refuse(2, *arguments)
        self.assertEqual(self.files(), ["run.csv", "run.mrec"])

    def test_an_unknown_command_is_named(self):
        self.assertIn("unknown command 'frobnicate'; did you mean one of simulate, replay, ",
                      self.must_refuse(2, "frobnicate"))
        self.assertIn("unknown command 'replya'; did you mean 'replay'?", self.must_refuse(2, "replya", "run.csv"))

    def test_help_is_a_command_too(self):
        self.assertEqual(self.must_do("help").stdout, self.must_do("--help").stdout)

    def test_every_command_explains_itself(self):
        for command in ("simulate", "replay", "convert", "config", "kinematics", "effects"):
            self.assertIn("--", self.must_do(command, "--help").stdout)
        self.must_do("--version")

    def test_json_on_standard_output_stands_alone(self):
        json.loads(self.must_do("replay", "run.mrec", "--json", "-").stdout)

    def test_a_reader_that_goes_away_is_no_crash(self):
        pipe = f"'{PROGRAM}' simulate --duration 5 --out - | head -n 1"
        done = subprocess.run(["bash", "-c", pipe], capture_output=True, cwd=self.folder, timeout=60, text=True)
        self.assertEqual(done.stdout, "# machine: reference\n")

    def test_no_colour_reaches_a_file(self):
        self.assertNotIn("\033", self.must_do("replay", "run.csv").stdout)


class DamagedNativeRecording(ProgramTest):
    def setUp(self):
        super().setUp()
        self.must_do("simulate", "--duration", "0.5", "--out", "run.mrec")
        self.bytes = (self.folder / "run.mrec").read_bytes()

    def refused(self, content):
        recording = self.write("bad.mrec", content)
        sentence = self.must_refuse_but_print(recording)
        self.assertIn("bad.mrec", sentence)
        self.assertEqual(self.files(), ["bad.mrec", "run.mrec"])
        return sentence

    def must_refuse_but_print(self, recording):
        done = self.run_program("replay", recording, "--json", "result.json", "--health-out", "answers.bin")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        return done.stderr

    def test_a_cut_is_said_with_its_byte(self):
        for share in (0.1, 0.5, 0.9, 0.999):
            with self.subTest(share):
                self.assertIn("was cut behind byte", self.refused(self.bytes[:int(share * len(self.bytes))]))

    def test_a_cut_recording_is_read_up_to_the_cut_when_asked(self):
        self.write("cut.mrec", self.bytes[:len(self.bytes) // 2])
        result = json.loads(self.must_do("replay", "cut.mrec", "--accept-damaged", "--json", "-").stdout)
        self.assertFalse(result["recording"]["complete"])
        self.assertAlmostEqual(result["frames"]["accepted"], 2500, delta=50)

    def test_a_changed_byte_is_one_rejected_frame(self):
        changed = bytearray(self.bytes)
        changed[len(changed) // 2] ^= 0x55
        self.assertIn("damaged record", self.refused(bytes(changed)))
        result = json.loads(self.must_do("replay", "bad.mrec", "--accept-damaged", "--json", "-").stdout)
        self.assertGreaterEqual(result["frames"]["reasons"]["corrupt"], 1)
        self.assertGreaterEqual(result["frames"]["rejected"], 1)
        self.assertGreaterEqual(result["frames"]["accepted"], 4997)

    def test_what_is_no_recording_at_all_is_refused(self):
        for content in (b"", b"\0", b"\0" * 1000, b"time_s,contact\n0,1\n1,1\n", bytes(range(256)) * 16):
            with self.subTest(content[:16]):
                self.refused(content)

    def test_convert_does_not_hide_damage(self):
        self.write("cut.mrec", self.bytes[:len(self.bytes) // 2])
        self.must_refuse(1, "convert", "cut.mrec", "out.csv")
        self.assertEqual(self.files(), ["cut.mrec", "run.mrec"])
        self.must_do("convert", "cut.mrec", "out.csv", "--accept-damaged")


if __name__ == "__main__":
    unittest.main()
