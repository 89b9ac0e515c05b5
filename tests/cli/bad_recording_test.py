"""Every malformed recording gets one sentence with file, line and column, status 1, and leaves no output behind."""

import unittest

from program import ProgramTest

HEADER = "time_s,armature_voltage_v,contact,spindle_speed_rad_s,armature_current_a\n"
ROWS = "".join(f"{k * 0.0001:.4f},48,0,500,1\n" for k in range(3))
GOOD = HEADER + ROWS
COLUMNS = HEADER.strip().split(",")


def with_row(row):
    return GOOD + row + "\n" + "0.0010,48,0,500,1\n"


def row_with(column, text):
    fields = ["0.0005", "48", "0", "500", "1"]
    fields[column] = text
    return ",".join(fields)


def place_of(column):
    """Where the field of that column begins in row_with()."""
    return 1 + sum(len(field) + 1 for field in ["0.0005", "48", "0", "500", "1"][:column])


# content of the file, and what the sentence must say
STRUCTURE = {
    "empty file": ("", "empty"),
    "only blank lines": ("\n\n\n", "empty"),
    "only metadata": ("# machine: reference\n# seed: 1\n", "empty"),
    "only a header": (HEADER, "line 2", "0 row"),
    "one row": (HEADER + "0,48,0,500,1\n", "1 row"),
    "numbers without a header": (ROWS, "line 1", "header row is missing"),
    "no time column": ("seconds,armature_voltage_v\n0,1\n1,2\n", "line 1", "'time_s'"),
    "misspelt time column": ("time,armature_voltage_v\n0,1\n1,2\n", "line 1", "'time_s'"),
    "nearly the time column": ("tim_s,contact\n0,1\n1,2\n", "line 1", "did you mean 'time_s' by 'tim_s'?"),
    "nearly a signal": ("time_s,spindle_sped_rad_s\n0,1\n1,2\n", "line 1", "did you mean 'spindle_speed_rad_s'"),
    "only the time": ("time_s\n0\n1\n", "line 1", "no column is a signal"),
    "no known signal": ("time_s,foo,bar\n0,1,2\n1,2,3\n", "line 1", "no column is a signal"),
    "semicolons": ("time_s;contact\n0;1\n1;1\n", "line 1", "commas"),
    "tabs": ("time_s\tcontact\n0\t1\n1\t1\n", "line 1", "commas"),
    "a column twice": ("time_s,contact,contact\n0,1,1\n1,1,1\n", "line 1, column 16", "twice"),
    "time twice": ("time_s,contact,time_s\n0,1,1\n1,1,1\n", "line 1, column 16", "twice"),
    "header below metadata, no time": ("# a: b\nt,contact\n0,1\n", "line 2", "'time_s'"),
    "binary": (bytes(range(256)) * 4, "line 1"),
    "text": ("this is no recording\n", "'time_s'"),
    "html": ("<html><body>\n<p>no</p>\n", "'time_s'"),
    "second header": (with_row(HEADER.strip()), "line 5, column 1", "not a number"),
    "blank line inside": (GOOD + "\n0.0010,48,0,500,1\n", "line 5", "1 fields"),
    "comment inside": (with_row("# stop"), "line 5", "1 fields"),
    "cut in the middle of a row": (GOOD + "0.0003,48,0", "line 5", "3 fields of 5", "was cut"),
    "cut behind a comma": (GOOD + "0.0003,", "line 5", "2 fields of 5", "was cut"),
    "a row that lacks fields": (GOOD + "0.0003,48,0\n0.0004,48,0,1,0\n", "line 5", "the row has 3 fields"),
}

FIELD_COUNTS = {f"{n} fields": (with_row(",".join(["0.0005"] + ["1"] * (n - 1))), f"line 5", f"{n} fields", "5")
                for n in (1, 2, 3, 4, 6, 7, 20)}

NO_NUMBERS = ["abc", "1.5V", "12 V", "0x10", "--1", "1e", "1..2", "1_000", "'1'", '"1"', "-", "+",
              "1.5e+", "true", "n/a", "1 2", "#", "?", "\u00b5", "1e5e5", ".", "e5", "NULL", "+-1"]
TEXT_IN_NUMBERS = {f"{text!r} in {COLUMNS[column]}": (with_row(row_with(column, text)),
                                                      f"line 5, column {place_of(column)}", "not a number",
                                                      COLUMNS[column])
                   for text in NO_NUMBERS for column in (0, 2, 4)}

TIMES = {f"time {text!r}": (with_row(row_with(0, text)), "line 5", said) for text, said in [
    ("0.0002", "does not increase"), ("0.0001", "does not increase"), ("0", "does not increase"),
    ("-1", "does not increase"), ("nan", "finite"), ("inf", "finite"), ("-inf", "finite"), ("1e300", "finite"),
    ("", "empty"), ("  ", "empty")]}

CORPUS = STRUCTURE | FIELD_COUNTS | TEXT_IN_NUMBERS | TIMES


class BadRecording(ProgramTest):
    def test_the_corpus_holds_a_hundred_files(self):
        self.assertGreaterEqual(len(CORPUS), 100)

    def test_the_recording_that_the_corpus_damages_is_good(self):
        self.must_do("replay", self.write("good.csv", GOOD))

    def test_every_one_is_refused_with_its_place(self):
        for name, (content, *said) in CORPUS.items():
            with self.subTest(name):
                recording = self.write("bad.csv", content)
                before = self.files()
                sentence = self.must_refuse(1, "replay", recording, "--json", "result.json", "--out", "frames.csv",
                                            "--health-out", "answers.bin")
                for words in ("bad.csv", *said):
                    self.assertIn(words, sentence)
                self.assertEqual(self.files(), before)

    def test_convert_refuses_them_too(self):
        for name in ("empty file", "7 fields", "time '0.0001'"):
            with self.subTest(name):
                recording = self.write("bad.csv", CORPUS[name][0])
                self.must_refuse(1, "convert", recording, "out.mrec")
                self.assertEqual(self.files(), ["bad.csv"])

    def test_a_missing_file_and_a_folder_are_refused(self):
        self.assertIn("No such file", self.must_refuse(1, "replay", "nothing.csv"))
        self.assertIn("No such file", self.must_refuse(1, "replay", "nothing.mrec"))
        (self.folder / "folder.csv").mkdir()
        self.assertIn("directory", self.must_refuse(1, "replay", "folder.csv"))

    def test_names_between_quotes_are_names(self):
        quoted = ",".join(f'"{column}"' for column in COLUMNS) + "\n"
        done = self.must_do("replay", self.write("quoted.csv", quoted + ROWS), "--machine", "reference")
        self.assertEqual(done.stderr, "")

    def test_an_unknown_column_is_a_warning_with_a_suggestion(self):
        recording = self.write("odd.csv", GOOD.replace("contact", "contakt"))
        done = self.must_do("replay", recording)
        self.assertIn("odd.csv, line 1, column 27", done.stderr)
        self.assertIn("did you mean 'contact'", done.stderr)


if __name__ == "__main__":
    unittest.main()
