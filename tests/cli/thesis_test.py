"""The thesis's figures as users call for them: a table, JSON, a page."""

import json
import unittest

from program import ProgramTest

FIGURES = [13, 14, 15, 16, 17, 21, 22, 23, 24, 25, 26, 28, 29, 30, 31, 32, 33]


class Thesis(ProgramTest):
    def test_a_table_names_every_figure_with_printed_and_computed_values(self):
        text = self.must_do("thesis").stdout
        for number in FIGURES:
            self.assertIn(f"\nfigure {number} (", text)
        self.assertRegex(text, r"coefficient at 480 degC +0\.43 +0\.4347 +\+1\.1 %")
        self.assertIn("L = 0.49 H is 4900 times the nominal value", text)

    def test_json_holds_the_same(self):
        result = json.loads(self.must_do("thesis", "--json", "-").stdout)
        self.assertEqual(result["schema"], "morepro.thesis/1")
        self.assertEqual([figure["figure"] for figure in result["figures"]], FIGURES)
        friction = next(figure for figure in result["figures"] if figure["figure"] == 23)["comparisons"][0]
        self.assertEqual(friction["printed"], [0.15, 0.45])
        self.assertAlmostEqual(friction["ours"][0], 0.1745, delta=1e-4)
        self.assertEqual(result["bank"], [])

    def test_the_bank_has_a_row_per_rule_and_condition(self):
        done = self.must_do("thesis", "--bank", "--runs", "1", "--json", "bank.json", "--progress", "off")
        rows = json.loads((self.folder / "bank.json").read_text())["bank"]
        self.assertEqual(len(rows), 2 * 12 * 4)
        self.assertEqual({row["machine"] for row in rows}, {"thesis", "reference"})
        self.assertIn("never", done.stdout)

    def test_a_page_or_a_reason(self):
        done = self.run_program("thesis", "--report", "page.html")
        if done.returncode == 0:
            self.assertIn('id="data"', (self.folder / "page.html").read_text())
        else:
            self.assertIn("built without its report pages", done.stderr)
            self.assertEqual(self.files(), [])

    def test_wrong_usage(self):
        for arguments in (["figure"], ["--runs", "0"], ["--runs", "many"], ["--seed", "-1"],
                          ["--report", "a", "--json", "a"]):
            with self.subTest(arguments):
                self.must_refuse(2, "thesis", *arguments)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main()
