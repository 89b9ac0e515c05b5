"""Scores of diagnoses against labels: every figure of the blind trial. No files, no processes."""

import math
import random

ALARMS = ("effect", "unexplained")
REFUSALS = ("not_enough_data", "insufficient_excitation")
MOST_ALIASES = 3
ONSET_TOLERANCE_S = 1.0
# Pairs that one recording cannot separate without further excitation; where the true effect was taken out of the
# catalogue, its alias is as right an answer as "unexplained".
KNOWN_ALIASES = (
    {"supply_voltage_offset", "spindle_speed_bias"},
    {"current_delay", "current_bandwidth", "drive_lag"},
    {"spindle_speed_delay", "spindle_speed_bandwidth"},
    {"feed_coulomb_friction", "feed_stribeck_friction", "feed_presliding"},
    {"feed_speed_delay", "feed_drive_lag"},
)


def wilson(hits, count, z=1.96):
    """95 % interval of a share."""
    if count == 0:
        return (0.0, 1.0)
    share = hits / count
    middle = (share + z * z / (2 * count)) / (1 + z * z / count)
    half = z / (1 + z * z / count) * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return (max(0.0, middle - half), min(1.0, middle + half))


class Trial:
    """One label and what was said about it."""

    def __init__(self, label, said):
        self.label = label
        self.said = said
        self.kind = label["class"]
        self.truths = [effect["name"] for effect in label["effects"]]

    @property
    def has_holes(self):
        return any(effect["has_holes"] for effect in self.label["effects"])

    @property
    def wanted_ratio(self):
        return min((effect["wanted_ratio"] for effect in self.label["effects"]), default=1.0)

    @property
    def verdict(self):
        return (self.said or {}).get("verdict", "failed")

    @property
    def named(self):
        return [entry["effect"] for entry in (self.said or {}).get("which", [])]

    @property
    def is_alarm(self):
        return self.verdict in ALARMS

    def top(self):
        which = (self.said or {}).get("which", [])
        return which[0] if which else None

    def names_truth(self, entry, truth):
        aliases = entry.get("alias_set", [])
        return entry["effect"] == truth or (len(aliases) <= MOST_ALIASES and truth in aliases)

    def top_is_right(self):
        return self.top() is not None and any(self.names_truth(self.top(), truth) for truth in self.truths)

    def top_is_exact(self):
        return self.top() is not None and self.top()["effect"] in self.truths

    def alias_set_holds_truth(self):
        if self.top() is None:
            return False
        names = set(self.top().get("alias_set", [])) | {self.top()["effect"]}
        return len(names) <= MOST_ALIASES and any(truth in names for truth in self.truths)

    def named_place(self):
        """What was said about the balance with the largest gap; None where nothing was evaluated."""
        evaluated = [place for place in (self.said or {}).get("where", []) if place.get("evaluated")]
        places = [place for place in evaluated if place.get("significant")] or evaluated
        return max(places, key=lambda place: place.get("residual_ratio") or 0.0, default=None)

    def ratio_factor(self):
        """By what factor the residual ratio of that balance is wrong; None where one of both is not known."""
        place = self.named_place() or {}
        said, truth = place.get("residual_ratio"), self.label["ratios"].get(place.get("balance"))
        return max(said / truth, truth / said) if said and truth else None

    def balance_is_right(self):
        place = self.named_place()
        return place is not None and place["balance"] in self.label["effects"][0]["balances"]

    def true_onset_s(self):
        return self.label["effects"][0]["onset_s"]

    def said_onset_s(self):
        """The onset that was said for the balance of the effect."""
        for place in (self.said or {}).get("where", []):
            if place["balance"] == self.label["effects"][0]["balance"]:
                return place.get("onset_s")
        return None

    def onset_is_right(self):
        said = self.said_onset_s()
        return said is not None and abs(said - self.true_onset_s()) <= ONSET_TOLERANCE_S

    def is_exact_pair(self):
        which = (self.said or {}).get("which", [])
        if len(which) != 2 or len(self.truths) != 2:
            return False
        (a, b), (first, second) = self.truths, which
        return (self.names_truth(first, a) and self.names_truth(second, b)) or (
            self.names_truth(first, b) and self.names_truth(second, a))

    def left_out_is_right(self):
        if self.verdict == "unexplained":
            return True
        top = self.top()
        return top is not None and any({self.truths[0], top["effect"]} <= group for group in KNOWN_ALIASES)

    def true_share(self):
        """What the named effects really close: the program's own reduction of the residual power in each balance,
        against the floor that is known from the same run without the effect."""
        places = {place["balance"]: place for place in self.said.get("where", []) if place.get("evaluated")}
        closed = excess = 0.0
        for balance, ratio in self.label["ratios"].items():
            place = places.get(balance)
            if place and place.get("residual_ratio") and place.get("residual_ratio_after") is not None:
                closed += ratio * (1.0 - place["residual_ratio_after"] / place["residual_ratio"])
                excess += ratio - 1.0
        # Both sides are estimates: more than all of it is all of it.
        return min(closed / excess, 1.0) if excess > 0.0 else None

    @property
    def board(self):
        """What the board's own watch said about the recording; None where nothing was said of it."""
        return (self.said or {}).get("board")

    def board_refuses(self):
        return self.board["verdict"] in REFUSALS

    def claimed_share(self):
        shrinkage = (self.said or {}).get("shrinkage") or {}
        return shrinkage.get("share_closed"), shrinkage.get("ci90")


def share_row(name, hits, trials):
    low, high = wilson(hits, trials)
    return {"name": name, "hits": hits, "trials": trials, "value": hits / trials if trials else None, "low": low, "high": high}


def rate(name, trials, predicate):
    return share_row(name, sum(1 for trial in trials if predicate(trial)), len(trials))


def number(name, value, count):
    return {"name": name, "value": value, "trials": count}


def quantile(values, part):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(part * len(ordered)))] if ordered else None


def calibration(trials, is_right):
    """Of the confidence in the first name."""
    pairs = [(float(t.top().get("confidence") or 0.0), 1.0 if is_right(t) else 0.0)
             for t in trials if t.verdict == "effect" and t.top() is not None and t.kind != "leave_one_out"]
    return Calibration(pairs)


def expected_calibration_error(pairs):
    bins = {}
    for p, o in pairs:
        bins.setdefault(min(9, int(p * 10)), []).append((p, o))
    return sum(abs(sum(p for p, _ in b) - sum(o for _, o in b)) for b in bins.values()) / len(pairs)


class Calibration:
    """Of pairs of a stated confidence and what came true, 0 or 1."""

    def __init__(self, pairs):
        self.pairs = pairs
        self.brier = sum((p - o) ** 2 for p, o in pairs) / len(pairs) if pairs else None
        self.ece = expected_calibration_error(pairs) if pairs else None

    def ece_by_chance(self):
        """What as many names have that are right exactly as often as they say: in the middle, and in 95 % at most."""
        if not self.pairs:
            return None, None
        chance = random.Random(1)
        draws = [expected_calibration_error([(p, 1.0 * (chance.random() < p)) for p, _ in self.pairs]) for _ in range(1000)]
        return quantile(draws, 0.5), quantile(draws, 0.95)


def share_rows(singles):
    errors, covered = [], 0
    for trial in singles:
        claimed, interval = trial.claimed_share()
        truth = trial.true_share() if trial.verdict == "effect" and trial.top_is_right() else None
        if claimed is None or truth is None or not interval:
            continue
        errors.append(abs(claimed - truth))
        covered += interval[0] <= truth <= interval[1]
    return [number("share_error_median", quantile(errors, 0.5), len(errors)),
            number("share_error_90", quantile(errors, 0.9), len(errors)),
            share_row("interval_covers", covered, len(errors))]


def ratio_rows(trials):
    factors = [factor for factor in (t.ratio_factor() for t in trials) if factor]
    return [number("ratio_factor_median", quantile(factors, 0.5), len(factors)),
            number("ratio_factor_90", quantile(factors, 0.9), len(factors))]


def calibration_rows(trials):
    exact = calibration(trials, Trial.top_is_exact)
    merged = calibration(trials, Trial.top_is_right)
    by_chance, by_chance_95 = exact.ece_by_chance()
    values = {"brier": exact.brier, "ece": exact.ece, "ece_by_chance": by_chance, "ece_by_chance_95": by_chance_95,
              "brier_merged": merged.brier, "ece_merged": merged.ece}
    return [number(name, value, len(exact.pairs)) for name, value in values.items()]


def board_rows(trials):
    asked = [t for t in trials if t.board is not None]
    judged = [t for t in asked if not t.board_refuses()]
    return [rate("board", asked, lambda t: t.board["agrees"]),
            rate("board_when_judged", judged, lambda t: t.board["agrees"]),
            rate("board_refuses", asked, Trial.board_refuses)]


def score(trials):
    """All rows of the table for the trials of one set (rich or production)."""
    clean = [t for t in trials if t.kind in ("none", "parameters")]
    singles = [t for t in trials if t.kind == "single" and not t.has_holes]
    visible = [t for t in singles if t.wanted_ratio >= 1.3]
    detected = [t for t in visible if t.is_alarm]
    pairs = [t for t in trials if t.kind == "pair" and not t.has_holes]
    unknown = [t for t in trials if t.kind == "unknown"]
    left_out = [t for t in trials if t.kind == "leave_one_out" and not t.has_holes]
    rows = [rate("false_alarm", clean, lambda t: t.is_alarm), rate("detected", visible, lambda t: t.is_alarm),
            rate("right_effect", detected, Trial.top_is_right), rate("right_effect_exact", detected, Trial.top_is_exact),
            rate("alias_set", detected, Trial.alias_set_holds_truth), rate("right_balance", detected, Trial.balance_is_right),
            rate("two_effects", pairs, Trial.is_exact_pair),
            rate("unknown_unexplained", unknown, lambda t: t.verdict == "unexplained"),
            rate("left_out_unexplained", left_out, Trial.left_out_is_right),
            rate("false_unexplained", visible, lambda t: t.verdict == "unexplained")]
    late = [t for t in detected if t.true_onset_s()]
    rows += [rate("onset_found", late, Trial.onset_is_right),
             rate("false_onset", [t for t in detected if not t.true_onset_s()], lambda t: t.said_onset_s() is not None)]
    rows += ratio_rows(detected + [t for t in unknown if t.is_alarm]) + calibration_rows(trials) + share_rows(visible)
    for ratio in sorted({t.wanted_ratio for t in singles}):
        group = [t for t in singles if t.wanted_ratio == ratio]
        rows.append(rate(f"detected_at_{ratio:g}", group, lambda t: t.is_alarm))
        rows.append(rate(f"right_at_{ratio:g}", [t for t in group if t.is_alarm], Trial.top_is_right))
    rows += board_rows(trials)
    rows.append(rate("failed", trials, lambda t: t.verdict == "failed"))
    return {row["name"]: row for row in rows}


def is_miss(trial):
    if trial.kind in ("none", "parameters"):
        return trial.is_alarm or trial.verdict == "failed"
    if trial.kind == "single":
        return trial.wanted_ratio >= 1.3 and not (trial.verdict == "effect" and trial.top_is_right())
    if trial.kind == "pair":
        return not trial.is_exact_pair()
    return not (trial.verdict == "unexplained" or trial.kind == "leave_one_out" and trial.left_out_is_right())


def summary(trial):
    """One line of the result file."""
    return {"id": trial.label["id"], "seed": trial.label["seed"], "class": trial.kind, "set": trial.label["set"],
            "truth": trial.truths, "wanted_ratio": [effect["wanted_ratio"] for effect in trial.label["effects"]],
            "verdict": trial.verdict, "named": trial.named, "miss": is_miss(trial)}


def confusion(trials):
    """{true name: {what was said: count}} over the single effects at 1.3 and more."""
    table = {}
    for trial in trials:
        if trial.kind == "single" and trial.wanted_ratio >= 1.3:
            said = trial.named[0] if trial.named else trial.verdict
            row = table.setdefault(trial.truths[0], {})
            row[said] = row.get(said, 0) + 1
    return table
