"""Flash, RAM and worst-case stack of a board's product image against the committed budget.

usage: weigh.py BOARD BUILD_FOLDER [--print-only | --update]
--update writes what was measured into budget.json as the new expectation."""
import argparse
import json
import sys

import figures

# A figure may grow by this share before somebody has to look.
TOLERANCE = 0.05


def judge(name, value, limit, expected):
    """What is wrong with a figure; None: nothing."""
    if value > limit:
        return f"{name}: {value} is over the limit of {limit}"
    if expected is not None and value > expected * (1 + TOLERANCE):
        return f"{name}: {value} has grown by more than {TOLERANCE:.0%} from {expected}; if that is meant: weigh.py --update"
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("board")
    parser.add_argument("build_folder")
    parser.add_argument("--print-only", action="store_true")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    budget = figures.budget()
    measured, path = figures.memory(figures.Build(options.board, options.build_folder))
    expected = budget["expected"].setdefault(options.board, {})
    print(f"{options.board}, product image: " + ", ".join(
        f"{name} {value} of {budget['limits'][name]}" for name, value in measured.items()))
    if options.print_only:
        return 0
    print("deepest path: " + " > ".join(path))
    if options.update:
        expected.update(measured)
        figures.BUDGET.write_text(json.dumps(budget, indent=2) + "\n")
        return 0
    wrong = [w for w in (judge(n, v, budget["limits"][n], expected.get(n)) for n, v in measured.items()) if w]
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
