"""The scorer counts what it says it counts."""

import unittest

import report
from scoring import Trial, calibration, score, wilson

BALANCES = ("spindle_torque", "feed_force", "armature_voltage")


def label(kind, *names, ratio=2.0):
    effects = [{"name": name, "wanted_ratio": ratio, "balance": "feed_force", "balances": ["feed_force"], "has_holes": False, "onset_s": None}
               for name in names]
    ratios = dict.fromkeys(BALANCES, 1.0)
    ratios["feed_force"] = ratio
    return {"id": "trial_0000", "set": "rich", "class": kind, "seed": 1, "machine": "reference", "effects": effects,
            "ratios": ratios, "unreachable": False}


def said(verdict, *names, aliases=(), confidence=0.9, after=1.0):
    where = [{"balance": balance, "evaluated": True, "residual_ratio": 2.0 if balance == "feed_force" else 1.0,
              "residual_ratio_after": after if balance == "feed_force" else 1.0, "significant": balance == "feed_force"}
             for balance in BALANCES]
    which = [{"effect": name, "confidence": confidence, "alias_set": [name, *aliases]} for name in names]
    return {"verdict": verdict, "where": where, "which": which, "shrinkage": {"share_closed": 0.9, "ci90": [0.8, 0.95]}}


class ScoringTest(unittest.TestCase):
    def test_an_alias_of_the_first_name_counts_as_right_and_not_as_exact(self):
        trial = Trial(label("single", "feed_spring"), said("effect", "feed_force_offset", aliases=["feed_spring"]))
        self.assertTrue(trial.top_is_right())
        self.assertFalse(trial.top_is_exact())

    def test_an_alias_set_of_four_holds_nothing(self):
        trial = Trial(label("single", "feed_spring"), said("effect", "a", aliases=["b", "c", "feed_spring"]))
        self.assertFalse(trial.top_is_right())
        self.assertFalse(trial.alias_set_holds_truth())

    def test_the_second_name_does_not_make_a_trial_right(self):
        self.assertFalse(Trial(label("single", "feed_spring"), said("effect", "a", "feed_spring")).top_is_right())

    def test_a_parameter_error_is_no_false_alarm_and_an_effect_is_one(self):
        trials = [Trial(label("parameters"), said("parameter_error")), Trial(label("none"), said("effect", "feed_spring"))]
        row = score(trials)["false_alarm"]
        self.assertEqual((row["hits"], row["trials"]), (1, 2))

    def test_a_pair_needs_both_names_and_no_third(self):
        truth = label("pair", "feed_spring", "drive_lag")
        self.assertTrue(Trial(truth, said("effect", "drive_lag", "feed_spring")).is_exact_pair())
        self.assertFalse(Trial(truth, said("effect", "drive_lag", "drive_lag")).is_exact_pair())
        self.assertFalse(Trial(truth, said("effect", "drive_lag", "feed_spring", "a")).is_exact_pair())

    def test_small_effects_are_not_asked_to_be_detected(self):
        rows = score([Trial(label("single", "feed_spring", ratio=1.1), said("no_gap"))])
        self.assertEqual(rows["detected"]["trials"], 0)
        self.assertEqual(rows["detected_at_1.1"]["trials"], 1)

    def test_an_unknown_structure_that_gets_a_name_is_a_miss(self):
        row = score([Trial(label("unknown", "bump_in_the_way"), said("effect", "feed_spring"))])["unknown_unexplained"]
        self.assertEqual((row["hits"], row["trials"]), (0, 1))

    def test_without_the_true_candidate_its_known_alias_is_right(self):
        truth = label("leave_one_out", "supply_voltage_offset")
        self.assertTrue(Trial(truth, said("effect", "spindle_speed_bias")).left_out_is_right())
        self.assertFalse(Trial(truth, said("effect", "drive_lag")).left_out_is_right())

    def test_the_true_share_is_taken_against_the_true_floor(self):
        whole = Trial(label("single", "feed_spring"), said("effect", "feed_spring", after=1.0))
        self.assertAlmostEqual(whole.true_share(), 1.0)
        half = Trial(label("single", "feed_spring"), said("effect", "feed_spring", after=1.5))
        self.assertAlmostEqual(half.true_share(), 0.5)

    def test_brier_and_calibration_error_see_overconfidence(self):
        trials = [Trial(label("single", "feed_spring"), said("effect", "drive_lag", confidence=1.0))]
        overconfident = calibration(trials, Trial.top_is_exact)
        self.assertEqual((overconfident.brier, overconfident.ece), (1.0, 1.0))

    def test_few_names_have_a_calibration_error_by_chance(self):
        stated = lambda count: calibration([Trial(label("single", "feed_spring"), said("effect", "feed_spring", confidence=0.5))] * count,
                                           Trial.top_is_exact).ece_by_chance()
        self.assertEqual(stated(1), (0.5, 0.5))
        self.assertLess(stated(400)[1], 0.06)  # two standard deviations of a mean of 400 coins: 0.05
        self.assertGreater(stated(400)[0], 0.01)

    def test_a_failed_diagnosis_is_counted(self):
        self.assertEqual(score([Trial(label("none"), None)])["failed"]["hits"], 1)

    def test_a_ratio_that_is_half_or_twice_the_truth_is_wrong_by_a_factor_of_two(self):
        for truth in (1.0, 4.0):
            row = score([Trial(label("unknown", "bump_in_the_way", ratio=truth), said("unexplained"))])["ratio_factor_median"]
            self.assertEqual((row["value"], row["trials"]), (2.0, 1))

    def test_the_balance_is_the_significant_one(self):
        self.assertTrue(Trial(label("single", "feed_spring"), said("effect", "feed_spring")).balance_is_right())

    def test_an_onset_counts_when_it_is_near(self):
        truth, answer = label("single", "feed_spring"), said("effect", "feed_spring")
        truth["effects"][0]["onset_s"] = 4.0
        answer["where"][1]["onset_s"] = 4.8
        self.assertTrue(Trial(truth, answer).onset_is_right())
        answer["where"][1]["onset_s"] = 5.2
        self.assertFalse(Trial(truth, answer).onset_is_right())

    def test_the_board_is_compared_where_it_was_asked(self):
        answers = [said("effect", "feed_spring") for _ in range(4)]
        for answer, board in zip(answers, (("effect", True), ("no_gap", False), ("not_enough_data", False), None)):
            if board is not None:
                answer["board"] = {"verdict": board[0], "agrees": board[1]}
        rows = score([Trial(label("single", "feed_spring"), answer) for answer in answers] + [Trial(label("none"), None)])
        self.assertEqual((rows["board"]["hits"], rows["board"]["trials"]), (1, 3))
        self.assertEqual((rows["board_when_judged"]["hits"], rows["board_when_judged"]["trials"]), (1, 2))
        self.assertEqual((rows["board_refuses"]["hits"], rows["board_refuses"]["trials"]), (1, 3))

    def test_wilson_agrees_with_a_published_value(self):
        low, high = wilson(81, 263)  # Newcombe 1998, table I, method 3
        self.assertAlmostEqual(low, 0.2553, 4)
        self.assertAlmostEqual(high, 0.3662, 4)

    def test_every_goal_has_a_row(self):
        rows = score([Trial(label("single", "feed_spring"), said("effect", "feed_spring"))])
        for goals in report.GOALS.values():
            self.assertLessEqual(set(goals), set(rows))


if __name__ == "__main__":
    unittest.main()
