"""What tests of `morepro diagnose` share: a simulated recording, what is taken out of it, the answer."""

import csv
import json

from program import ProgramTest

DRIVE = ("spindle_speed_rad_s", "armature_current_a", "contact", "chip_load_mm", "tool_temperature_degc")
SPINDLE = ("armature_voltage_v", "spindle_speed_rad_s")


class Diagnose(ProgramTest):
    def simulate(self, *options, duration=6, profile="rich"):
        seed = () if "--seed" in options else ("--seed", 5)
        self.must_do("simulate", "--profile", profile, "--duration", duration, *seed, *options, "--out", "run.csv")

    def lose_rows(self, *gaps_s):
        """Takes the rows of these times out of run.csv."""
        def is_there(line):
            first = line.split(",")[0]
            is_row = first[:1].isdigit()
            return not is_row or not any(begin <= float(first) < end for begin, end in gaps_s)
        lines = (self.folder / "run.csv").read_text().splitlines()
        self.write("run.csv", "\n".join(line for line in lines if is_there(line)) + "\n")

    def diagnose(self, *options, recording="run.csv"):
        done = self.must_do("diagnose", recording, "--bootstrap", 20, "--json", "-", *options)
        return json.loads(done.stdout)

    def names(self, result):
        return [effect["effect"] for effect in result["which"]]

    def value_of(self, key, machine):
        lines = (self.folder / machine).read_text().splitlines()
        return float(next(line for line in lines if line.startswith(key + " = ")).split(" = ")[1])

    def keep_columns(self, *names):
        path = self.folder / "run.csv"
        comments = [line for line in path.read_text().splitlines() if line.startswith("#")]
        rows = list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))
        lines = comments + [",".join(("time_s", *names))]
        lines += [",".join(row[name] for name in ("time_s", *names)) for row in rows]
        self.write("part.csv", "\n".join(lines) + "\n")

    def change_cells(self, column, rows, by):
        """Adds to some rows of one column of run.csv; row 0 is the first after the header."""
        lines = (self.folder / "run.csv").read_text().splitlines()
        head = next(i for i, line in enumerate(lines) if line.startswith("time_s"))
        place = lines[head].split(",").index(column)
        for row in rows:
            cells = lines[head + 1 + row].split(",")
            cells[place] = str(float(cells[place]) + by)
            lines[head + 1 + row] = ",".join(cells)
        self.write("run.csv", "\n".join(lines) + "\n")
