"""Prints the scores of the blind trial as tables."""

from scoring import confusion, is_miss

TITLES = {
    "false_alarm": "false alarm on no effect, datasheet exact or wrong by 30 %",
    "detected": "detected at residual ratio >= 1.3",
    "right_effect": "right effect (aliases merged) when detected",
    "right_effect_exact": "  the same without merging",
    "alias_set": "alias set (<= 3) holds the truth",
    "right_balance": "right balance",
    "ratio_factor_median": "  its residual ratio is wrong by a factor of, median",
    "ratio_factor_90": "  the same, 90 %",
    "two_effects": "two effects, exactly those",
    "unknown_unexplained": "unknown structure called unexplained",
    "left_out_unexplained": "  true candidate removed: unexplained or alias",
    "false_unexplained": "false \"unexplained\"",
    "onset_found": "late onset found within 1 s",
    "false_onset": "onset claimed of an effect that is there from the start",
    "brier": "calibration, Brier",
    "ece": "calibration, ECE",
    "ece_by_chance": "  of as many names that are right as often as they say, median",
    "ece_by_chance_95": "  the same, 95 % at most",
    "brier_merged": "  Brier, aliases merged",
    "ece_merged": "  ECE, aliases merged",
    "share_error_median": "error of the claimed share, median",
    "share_error_90": "error of the claimed share, 90 %",
    "interval_covers": "90 % interval covers the true share",
    "board": "board = host",
    "board_when_judged": "  where the board judges at all",
    "board_refuses": "  the board refuses: too little seen, or too little excitation",
    "failed": "diagnosis failed",
}
# (at least, at most) per set.
GOALS = {
    "rich": {"false_alarm": (0, .02), "detected": (.95, 1), "right_effect": (.92, 1), "alias_set": (.97, 1),
             "right_balance": (.98, 1), "two_effects": (.70, 1), "unknown_unexplained": (.85, 1),
             "false_unexplained": (0, .05), "brier": (0, .08), "ece": (0, .05), "share_error_median": (0, .03),
             "share_error_90": (0, .10), "interval_covers": (.85, .95), "failed": (0, 0)},
    "production": {"false_alarm": (0, .05), "detected": (.80, 1), "right_effect": (.75, 1), "alias_set": (.90, 1),
                   "right_balance": (.95, 1), "two_effects": (.50, 1), "unknown_unexplained": (.70, 1),
                   "false_unexplained": (0, .05), "brier": (0, .15), "ece": (0, .08), "share_error_median": (0, .05),
                   "share_error_90": (0, .20), "interval_covers": (.85, .95), "failed": (0, 0)},
}


def percent(value):
    return f"{100 * value:.1f} %"


def figure(row):
    if row["value"] is None:
        return "-"
    if "hits" not in row:
        return f"{row['value']:.3f} (n={row['trials']})"
    return f"{percent(row['value'])} = {row['hits']}/{row['trials']} [{100 * row['low']:.0f}..{100 * row['high']:.0f}]"


def goal_text(goal, row):
    if goal is None:
        return "", ""
    low, high = goal
    show = percent if "hits" in row else "{:g}".format
    text = f"<= {show(high)}" if low == 0 else f">= {show(low)}" if high == 1 else f"{show(low)}..{show(high)}"
    met = row["value"] is not None and low <= row["value"] <= high
    return text, "" if row["value"] is None else "ok" if met else "MISSED"


def print_table(set_name, scores, baselines):
    print(f"\n== {set_name}: share, hits/trials, [95 % interval in %]")
    names = list(baselines)
    print(f"{'':60} {'morepro':36} {'goal':18} {'':7} " + " ".join(f"{name:30}" for name in names))
    for key, row in scores.items():
        goal, met = goal_text(GOALS[set_name].get(key), row)
        others = " ".join(f"{figure(baselines[name][key]) if key in baselines[name] else '-':30}" for name in names)
        print(f"{TITLES.get(key, '  ' + key.replace('_', ' ')):60} {figure(row):36} {goal:18} {met:7} {others}".rstrip())


def print_confusion(set_name, trials):
    print(f"\n== {set_name}: what was said about each single effect at ratio >= 1.3")
    for truth, row in sorted(confusion(trials).items()):
        parts = [f"{name if name != truth else 'RIGHT'} x{count}" for name, count in sorted(row.items(), key=lambda x: -x[1])]
        print(f"  {truth:34} {', '.join(parts)}")


def print_misses(trials):
    misses = [trial for trial in trials if is_miss(trial)]
    print(f"\n== every miss ({len(misses)})")
    for trial in misses:
        truth = " + ".join(f"{e['name']}@{e['wanted_ratio']:.3g}" for e in trial.label["effects"]) or "nothing"
        which = (trial.said or {}).get("which", [])
        said = "; ".join(f"{e['effect']} {e.get('confidence') or 0:.2f} {{{', '.join(e.get('alias_set', []))}}}" for e in which)
        print(f"  {trial.label['id']} {trial.label['set']} {trial.kind} seed {trial.label['seed']} "
              f"{trial.label['machine']}: {truth} -> {trial.verdict}: {said or '-'}")


def goals_missed(set_name, scores):
    return [key for key, goal in GOALS[set_name].items()
            if scores[key]["value"] is not None and not goal[0] <= scores[key]["value"] <= goal[1]]
