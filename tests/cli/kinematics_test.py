"""Kinematics as users call it: paths, single poses, own chains; what cannot be is said and nothing is written."""

import csv
import json
import math
import unittest

from program import HERE, ProgramTest

GOLDEN = HERE.parent / "golden"

# The golden path and its placement (tests/golden/README.md).
POINTS = [(0, 0, 0, 0), (0.2, 0.05, 0, math.radians(30)), (0.25, 0.2, 0, math.radians(-15)), (0.05, 0.25, 0, 0)]
DURATIONS = ["", 2, 1.5, 2]
PLACEMENT = "[placement]\nx_m = 0.30\ny_m = 0.10\nz_m = 0.40\nroll_deg = 15\npitch_deg = -20\nyaw_deg = 30\n"

PATH = "x_m,y_m,z_m,roll_deg,duration_s\n0,0,0,0,\n0.2,0.05,0,30,2\n0.25,0.2,0,-15,1.5\n"

ARM = """[[joint]]
kind = "revolute"
a_m = 0.5
[[joint]]
kind = "revolute"
a_m = 0.4
lowest_deg = -150
highest_deg = 150
[[joint]]
kind = "prismatic"
alpha_deg = 180
lowest_m = -0.3
highest_m = 0.3
[[joint]]
kind = "revolute"
"""
# Two slides along z and y; the tool stays at x = 0.2.
GANTRY = """[[joint]]
kind = "prismatic"
a_m = 0.2
alpha_deg = -90
[[joint]]
kind = "prismatic"
"""
GANTRY_PATH = "x_m,y_m,z_m,duration_s\n0.2,0,0.1,\n0.2,0.3,0.4,2\n"
PLANAR_ARM = ARM.split("[[joint]]\nkind = \"prismatic\"")[0]
ARM_PATH = "x_m,y_m,z_m,yaw_deg,duration_s\n0.5,0.2,0,0,\n0.6,-0.3,0.1,90,1\n0.3,-0.3,0.2,400,1\n"


def rows_of(path):
    with open(path) as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def page_data(path):
    return json.loads(path.read_text().split('id="data">', 1)[1].split("</script>", 1)[0])


def golden_path_file(head):
    tables = [head, PLACEMENT]
    for (x, y, z, roll), duration in zip(POINTS, DURATIONS):
        tables.append(f"[[point]]\nx_m = {x}\ny_m = {y}\nz_m = {z}\nroll_rad = {roll!r}\n")
        tables.append(f"duration_s = {duration}\n" if duration else "")
    return "".join(tables)


class Trajectories(ProgramTest):
    def test_closed_form_gives_the_golden_tool_and_its_joints(self):
        self.write("path.toml", golden_path_file(""))
        self.must_do("kinematics", "path.toml", "--rate", "100", "--out", "joints.csv")
        ours = rows_of(self.folder / "joints.csv")
        golden = rows_of(GOLDEN / "traj_operational.csv")
        self.assertEqual(len(ours), len(golden))
        for row, wanted in zip(ours, golden):
            for name, key in (("x_m", "x"), ("y_m", "y"), ("z_m", "z"), ("roll_rad", "phi"), ("speed_x_m_s", "vx"),
                              ("turn_x_rad_s", "vphi"), ("t4_rad", "phi"), ("t4_rad_s", "vphi"), ("d3_m_s", "vx"),
                              ("d2_m_s", "vy"), ("d1_m_s", "vz")):
                self.assertAlmostEqual(row[name], wanted[key], delta=1e-12)
            self.assertAlmostEqual(row["d1_m"], wanted["z"] - 0.4, delta=1e-12)

    def test_clik_gives_the_golden_joints(self):
        start = "[inverse]\nmethod = \"clik\"\ngain_per_s = 50\nrate_hz = 1000\nstart = [0.01, -0.01, 0.035, 0.05]\n"
        self.write("path.toml", golden_path_file(start))
        self.must_do("kinematics", "path.toml", "--out", "joints.csv")
        ours = rows_of(self.folder / "joints.csv")[::10]
        golden = rows_of(GOLDEN / "traj_joint_clik.csv")
        self.assertEqual(len(ours), len(golden))
        for row, wanted in zip(ours, golden):
            for name, key in (("d1_m", "d1"), ("d2_m", "d2"), ("d3_m", "d3"), ("t4_rad", "t4"), ("d1_m_s", "d1d"),
                              ("t4_rad_s", "t4d"), ("error_x_m", "ex"), ("error_z_m", "ez"), ("error_x_rad", "ephi")):
                self.assertAlmostEqual(row[name], wanted[key], delta=1e-10, msg=f"{row['time_s']} {name}")

    def test_an_own_chain_follows_its_path(self):
        self.write("arm.toml", ARM)
        self.write("path.csv", ARM_PATH)
        self.must_do("kinematics", "path.csv", "--chain", "arm.toml", "--gain", "100", "--out", "joints.csv")
        rows = rows_of(self.folder / "joints.csv")
        self.assertEqual(len(rows), 2001)
        last = rows[-1]
        pose = self.must_do("kinematics", "--chain", "arm.toml", "--json", "-", "--forward",
                            *(last[name] for name in ("t1_rad", "t2_rad", "d3_m", "t4_rad")))
        for ours, wanted in zip(json.loads(pose.stdout)["position_m"], (0.3, -0.3, 0.2)):
            self.assertAlmostEqual(ours, wanted, delta=1e-4)
        self.assertAlmostEqual(last["yaw_rad"], math.radians(400), delta=1e-9)
        for name in last:
            self.assertTrue(all(math.isfinite(row[name]) for row in rows), name)

    def test_a_machine_of_two_axes_lags_as_predicted(self):
        self.write("gantry.toml", GANTRY)
        self.write("path.csv", GANTRY_PATH)
        said = self.must_do("kinematics", "path.csv", "--chain", "gantry.toml", "--out", "joints.csv").stdout
        self.assertNotIn("damped", said)
        row = rows_of(self.folder / "joints.csv")[600]
        for axis in "yz":
            predicted = 1e-3 * row[f"acceleration_{axis}_m_s2"] / (2 * 50)
            self.assertGreater(predicted, 0)
            self.assertAlmostEqual(row[f"error_{axis}_m"], predicted, delta=0.01 * predicted)

    def test_a_target_on_a_limit_of_a_joint_is_reached(self):
        self.write("path.csv", "x_m,y_m,z_m,duration_s\n0.1,0,0.4,\n0.1,0,1.4,2\n")
        for method in ("closed_form", "clik"):
            self.must_do("kinematics", "path.csv", "--method", method, "--out", "j.csv")
            self.assertAlmostEqual(rows_of(self.folder / "j.csv")[-1]["d1_m"], 1.0, delta=1e-4)

    def test_a_planar_arm_follows_its_path(self):
        self.write("arm.toml", PLANAR_ARM)
        self.write("path.csv", "x_m,y_m,z_m,duration_s\n0.5,0.2,0,\n0.6,-0.3,0,1\n")
        said = self.must_do("kinematics", "path.csv", "--chain", "arm.toml", "--out", "joints.csv").stdout
        self.assertNotIn("damped", said)
        row = rows_of(self.folder / "joints.csv")[-1]
        t1, t2 = row["t1_rad"], row["t2_rad"]
        self.assertAlmostEqual(0.5 * math.cos(t1) + 0.4 * math.cos(t1 + t2), 0.6, delta=1e-4)
        self.assertAlmostEqual(0.5 * math.sin(t1) + 0.4 * math.sin(t1 + t2), -0.3, delta=1e-4)

    def test_rates_are_the_differences_of_the_joints(self):
        self.write("arm.toml", ARM)
        self.write("path.csv", ARM_PATH)
        self.must_do("kinematics", "path.csv", "--chain", "arm.toml", "--rate", "10000", "--out", "joints.csv")
        rows = rows_of(self.folder / "joints.csv")
        for before, after in list(zip(rows, rows[1:]))[500:10000:97]:
            self.assertAlmostEqual((after["t2_rad"] - before["t2_rad"]) * 1e4, before["t2_rad_s"], delta=1e-6)
            self.assertAlmostEqual((after["t2_rad_s"] - before["t2_rad_s"]) * 1e4, before["t2_rad_s2"], delta=0.05)

    def test_standard_output_holds_the_csv_alone(self):
        self.write("path.csv", PATH)
        lines = self.must_do("kinematics", "path.csv", "--rate", "10", "--out", "-").stdout.splitlines()
        self.assertEqual(len(lines), 1 + 36)
        self.assertTrue(lines[0].startswith("time_s,d1_m,d2_m,d3_m,t4_rad,d1_m_s,"))


class Pages(ProgramTest):
    def test_a_page_holds_the_trajectory_beside_the_csv(self):
        self.write("path.csv", PATH)
        done = self.run_program("kinematics", "path.csv", "--report", "page.html", "--out", "joints.csv")
        if "built without its report pages" in done.stderr:
            self.assertEqual((done.returncode, self.files()), (1, ["path.csv"]))
            return
        data = page_data(self.folder / "page.html")
        rows = rows_of(self.folder / "joints.csv")
        self.assertEqual([joint["name"] for joint in data["joints"]], ["d1", "d2", "d3", "t4"])
        self.assertEqual(data["rows"]["time_s"], [row["time_s"] for row in rows])
        self.assertEqual(data["rows"]["joints"][3], [row["t4_rad"] for row in rows])

    def test_a_long_path_is_thinned_and_keeps_its_end(self):
        self.write("path.csv", PATH)
        done = self.run_program("kinematics", "path.csv", "--rate", "10000", "--report", "page.html")
        if "built without its report pages" in done.stderr:
            return
        times = page_data(self.folder / "page.html")["rows"]["time_s"]
        self.assertTrue(2000 <= len(times) <= 4001, len(times))
        self.assertEqual((times[0], times[-1]), (0.0, 3.5))
        self.assertIn("one row of 16 is shown", (self.folder / "page.html").read_text())


class SinglePoses(ProgramTest):
    def test_forward_and_inverse_undo_each_other(self):
        pose = json.loads(self.must_do("kinematics", "--forward", "0.1", "-0.2", "0.3", "1.5", "--json", "-").stdout)
        self.assertEqual([round(value, 12) for value in pose["position_m"]], [0.57, -0.1, 0.5])
        back = self.must_do("kinematics", "--inverse", *pose["position_m"], pose["angles_rad"][0], "--json", "-")
        for ours, wanted in zip(json.loads(back.stdout)["joints"], (0.1, -0.2, 0.3, 1.5)):
            self.assertAlmostEqual(ours, wanted, delta=1e-12)

    def test_an_own_chain_finds_its_joints(self):
        self.write("arm.toml", ARM)
        found = self.must_do("kinematics", "--inverse", "0.5,0.5,0.1", "--chain", "arm.toml", "--json", "-")
        for ours, wanted in zip(json.loads(found.stdout)["position_m"], (0.5, 0.5, 0.1)):
            self.assertAlmostEqual(ours, wanted, delta=1e-8)

    def test_a_person_gets_text_and_a_file_gets_json(self):
        text = self.must_do("kinematics", "--forward", "0", "0", "0", "0", "--json", "pose.json").stdout
        self.assertIn("position  x = 0.27  y = 0.1  z = 0.4 m", text)
        self.assertEqual(json.loads((self.folder / "pose.json").read_text())["schema"], "morepro.kinematics/1")


class Refusals(ProgramTest):
    def refused(self, sentence, *arguments):
        before = self.files()
        self.assertIn(sentence, self.must_refuse(1, "kinematics", *arguments))
        self.assertEqual(self.files(), before, "something was written")

    def test_paths_that_cannot_be(self):
        head = "x_m,y_m,z_m,duration_s\n"
        for rows, sentence in (("0,0,0,\n0,0,0,1\n", "line 3: the point is where the one before it is"),
                               ("0,0,0,\n1,0,0,0\n", "line 3: duration_s = 0 is impossible"),
                               ("0,0,0,\n1,0,0,1e-300\n", "duration_s = 1e-300 is impossible"),
                               ("0,0,0,\n1,0,0,-1\n", "duration_s = -1 is impossible"),
                               ("0,0,0,\n1,0,0,\n", "line 3, column 7: '' in column 'duration_s' is not a finite number"),
                               ("0,0,0,\n1,0,0,nan\n", "'nan' in column 'duration_s'"),
                               ("0,0,0,\n1,inf,0,1\n", "line 3, column 3: 'inf' in column 'y_m'"),
                               ("0,0,0,\n1,0,x,1\n", "'x' in column 'z_m'"),
                               ("0,0,0,\n1,0,1\n", "the row has 3 fields, the header has 4"),
                               ("0,0,0,1\n1,0,0,1\n", "the first point has no way before it"),
                               ("0,0,0,\n", "the path has 1 point; it needs two"),
                               ("", "the path has 0 points"),
                               ("0,0,0,\n5,0,0,1\n", "out of reach at"),
                               ("0,0,0,\n1,0,0,1e9\n", "are more than 1e+08 rows")):
            with self.subTest(rows):
                self.write("path.csv", head + rows)
                self.refused(sentence, "path.csv", "--out", "joints.csv")

    def test_headers_that_cannot_be(self):
        for head, sentence in (("x_m,y_m,z_m\n", "the header has no column 'duration_s'"),
                               ("x_m,y_m,z_m,duration\n", "'duration' is not known (did you mean 'duration_s'?)"),
                               ("x_m,y_m,z_m,x_m,duration_s\n", "column 'x_m' is there twice"),
                               ("x_m,y_m,z_m,roll_deg,roll_rad,duration_s\n", "column 'roll_rad' is there twice"),
                               ("", "the path is empty")):
            with self.subTest(head):
                self.write("path.csv", head)
                self.refused(sentence, "path.csv", "--out", "joints.csv")

    def test_chains_that_cannot_be(self):
        self.write("path.csv", ARM_PATH)
        for old, new, sentence in (("prismatic", "prizmatic", "joint kind 'prizmatic' is unknown (did you mean 'prismatic'?)"),
                                   ("kind = \"revolute\"\na_m = 0.5", "a_m = 0.5", "has no 'kind'"),
                                   ("a_m = 0.5", "a_m = 5000.0", "a_m or d_m is beyond 1000 m"),
                                   ("a_m = 0.5", "a_m = nan", "a_m is not finite"),
                                   ("a_m = 0.5", "a_m = \"long\"", "a_m is no number"),
                                   ("a_m = 0.5", "a_mm = 500", "'a_mm' of [[joint]] is not known"),
                                   ("alpha_deg = 180", "alpha_rad = 180", "alpha or theta is beyond 100 rad"),
                                   ("alpha_deg = 180", "alpha_deg = 180\nalpha_rad = 3", "are both there"),
                                   ("lowest_m = -0.3", "lowest_m = 0.4", "lowest is not below highest"),
                                   ("lowest_m = -0.3", "lowest_deg = -3", "lowest has the wrong unit"),
                                   ("[[joint]]", "[[joint]", "no valid TOML"),
                                   ("[[joint]]\n", "[[joint]]\nkind = \"revolute\"\n" * 6 + "[[joint]]\n",
                                    "the chain has more than 8 joints")):
            with self.subTest(new):
                self.write("arm.toml", ARM.replace(old, new, 1))
                self.refused(sentence, "path.csv", "--chain", "arm.toml", "--out", "joints.csv")

    def test_a_gain_for_the_closed_form(self):
        self.write("path.csv", PATH)
        self.must_refuse(2, "kinematics", "path.csv", "--gain", "50", "--out", "j.csv")

    def test_a_gain_outside_its_stable_range(self):
        self.write("path.csv", PATH)
        for gain in ("2000", "0", "-5", "1e9"):
            with self.subTest(gain):
                self.refused("is unstable at 1000 Hz", "path.csv", "--method", "clik", f"--gain={gain}", "--out", "j.csv")
        self.refused("gain = 50/s is unstable at 20 Hz", "path.csv", "--method", "clik", "--rate", "20", "--out", "j.csv")
        self.refused("rate = 0 Hz is outside", "path.csv", "--rate", "0", "--out", "j.csv")

    def test_poses_out_of_reach(self):
        self.write("arm.toml", ARM)
        self.refused("the pose is out of reach: joint d3 would be at 4.73 m", "--inverse", "5", "0", "0")
        self.refused("the pose is out of reach: the tool stays 0.1", "--inverse", "1", "0", "0", "--chain", "arm.toml")
        self.refused("cannot tilt", "--inverse", "0.5", "0", "0", "0", "0.1", "0")
        self.refused("the joints cannot be there", "--forward", "0", "0", "0.4", "0", "--chain", "arm.toml")
        self.write("far.csv", ARM_PATH.replace("0.3,-0.3,0.2", "0.95,0,0.2"))
        self.refused("line 4: the path is out of reach at 1.", "far.csv", "--chain", "arm.toml", "--out", "joints.csv")

    def test_motion_that_no_joint_makes(self):
        self.write("gantry.toml", GANTRY)
        for old, new, sentence in (
                ("0.2,0.3,0.4,2", "0.25,0.3,0.4,2", "line 3: the path is out of reach at 0."),
                ("0.2,0.3,0.4,2", "0.25,0.3,0.4,2", "off along x, and no joint of this chain moves it along x"),
                ("0.2,", "0,", "line 2: the pose is out of reach: the tool is 0.2 m off along x, and no joint")):
            self.write("path.csv", GANTRY_PATH.replace(old, new))
            self.refused(sentence, "path.csv", "--chain", "gantry.toml", "--out", "joints.csv")
        self.refused("the tool is 0.3 rad off about x, and no joint of this chain turns it about x",
                     "--inverse", "0.2", "0", "0", "0.3", "--chain", "gantry.toml")
        self.write("turned.toml", GANTRY.replace("alpha_deg", "theta_deg = 30\nalpha_deg", 1))
        self.refused("no joint of this chain moves it along (0.866, 0.5, 0)", "--inverse", "1", "0", "0",
                     "--chain", "turned.toml")
        self.write("arm.toml", PLANAR_ARM)
        self.refused("no joint of this chain moves it along z", "--inverse", "0.5", "0.2", "0.1", "--chain", "arm.toml")

    def test_more_directions_than_joints(self):
        self.write("arm.toml", ARM.rsplit("[[joint]]", 1)[0])
        numbers = "the points prescribe 4 directions in which this chain can move, and it has 3 joints"
        self.refused(numbers, "--inverse", "0.5", "0.2", "0", "0", "0", "1", "--chain", "arm.toml")
        self.write("path.csv", ARM_PATH)
        self.refused(numbers, "path.csv", "--chain", "arm.toml", "--out", "joints.csv")
        start = "[inverse]\nstart = [0, 1, 0]\n"
        self.write("arm.toml", start + ARM.rsplit("[[joint]]", 1)[0])
        self.refused("out of reach at", "path.csv", "--chain", "arm.toml", "--out", "joints.csv")
        self.refused(numbers, "path.csv", "--chain", "arm.toml", "--out", "joints.csv")
        # As many as it has joints, or a pose that it happens to go through.
        self.must_do("kinematics", "--inverse", "0.5", "0.2", "0", "--chain", "arm.toml")
        self.assertNotIn("prescribe", self.must_refuse(1, "kinematics", "--inverse", "1", "0", "0", "--chain", "arm.toml"))
        self.must_do("kinematics", "--inverse", "0.9", "0", "0", "0", "0", "0", "--chain", "arm.toml")

    def test_times_that_need_more_than_the_limits(self):
        self.write("path.csv", "x_m,y_m,z_m,duration_s\n0,0,0,\n0.3,0.4,0,1\n")
        path = ("path.csv", "--chain", "limits.toml", "--out", "joints.csv")
        # 0.5 m in 1 s with ramps of a third: 0.75 m/s, 2.25 m/s2.
        for limits, sentence in (("max_speed_m_s = 0.5", "line 3: duration_s = 1 is impossible: 0.5 m in it need 0.75 m/s, "
                                  "[limits] allow 0.5 m/s; give the segment 1.5 s or more"),
                                 ("max_acceleration_m_s2 = 1", "need 2.25 m/s2, [limits] allow 1 m/s2; give the segment 1.5 s"),
                                 ("max_speed_m_s = 0", "max_speed_m_s is impossible; give more than 0"),
                                 ("max_acceleration_m_s2 = -1", "max_acceleration_m_s2 is impossible"),
                                 ("max_speed_m_s = nan", "max_speed_m_s is not finite"),
                                 ("max_speed = 1", "'max_speed' of [limits] is not known")):
            with self.subTest(limits):
                self.write("limits.toml", f"[limits]\n{limits}\n")
                self.refused(sentence, *path)
        self.write("limits.toml", "[limits]\nmax_speed_m_s = 0.751\nmax_acceleration_m_s2 = 2.251\n")
        self.must_do("kinematics", *path)

    def test_a_stretched_arm_is_out_of_reach_and_not_still(self):
        self.write("arm.toml", PLANAR_ARM)
        self.write("path.csv", "x_m,y_m,z_m,duration_s\n0.6,0,0,\n1.0,0,0,1\n")
        self.refused("the tool is 0.00", "path.csv", "--chain", "arm.toml", "--out", "joints.csv")

    def test_a_tool_that_cannot_tilt_is_not_asked_to(self):
        self.write("path.csv", "x_m,y_m,z_m,pitch_deg,duration_s\n0,0,0,0,\n0.2,0,0,5,1\n")
        self.refused("line 3: this machine cannot tilt", "path.csv", "--out", "joints.csv")

    def test_a_closed_form_is_the_built_in_machines_only(self):
        self.write("arm.toml", ARM)
        self.write("path.csv", ARM_PATH)
        self.refused("exists for the built-in machine only", "path.csv", "--chain", "arm.toml", "--method",
                     "closed_form", "--out", "joints.csv")

    def test_wrong_usage(self):
        self.write("path.csv", PATH)
        for arguments in ([], ["path.csv"], ["path.csv", "--forward", "0", "0", "0", "0", "--out", "j.csv"],
                          ["path.txt", "--out", "j.csv"], ["--forward", "1", "2"], ["--inverse", "1", "2"],
                          ["--forward", "0", "0", "0", "nan"], ["--forward", "0", "0", "0", "0", "--out", "j.csv"],
                          ["--forward", "0", "0", "0", "0", "--report", "p.html"],
                          ["path.csv", "--out", "path.csv"], ["path.csv", "--out", "p.csv", "--report", "p.csv"],
                          ["path.csv", "--report", "path.csv"], ["path.csv", "--out", "j.csv", "--method", "guess"]):
            with self.subTest(arguments):
                self.must_refuse(2, "kinematics", *arguments)
        self.assertEqual(self.files(), ["path.csv"])

    def test_files_that_are_not_there(self):
        self.refused("cannot read", "nowhere.csv", "--out", "joints.csv")
        self.refused("cannot read", "--forward", "0", "--chain", "nowhere.toml")


if __name__ == "__main__":
    unittest.main()
