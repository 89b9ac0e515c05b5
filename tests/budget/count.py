"""Instructions of the functions in the count image, exact, against budget.json.

usage: count.py BOARD BUILD_FOLDER
Cycles are an estimate: 1.6 per instruction (nominal for a Cortex-M4), 2.5 at the worst; there is no silicon here."""
import sys

import figures


def judge(name, counted, limits):
    """What is wrong with a count; None: nothing."""
    for word, value in zip(("instructions", "most_instructions"), counted):
        limit = limits[word].get(name, value if word == "most_instructions" else None)
        if limit is None:
            return f"{name} has no limit in {figures.BUDGET.name}"
        if value > limit:
            return f"{name}: {value} is over the limit of {limit} {word}"
    return None


def main(board, folder):
    limits = figures.budget()
    counted = figures.instructions(figures.Build(board, folder))
    print(f"{'function':28} {'mean':>7} {'most':>7} {'limit':>7}  estimated cycles of the mean")
    for name, (mean, most) in counted.items():
        limit = limits["instructions"].get(name, "-")
        print(f"{name:28} {mean:7} {most:7} {limit:>7}  {1.6 * mean:.0f} .. {2.5 * mean:.0f}")
    wrong = [w for w in (judge(name, both, limits) for name, both in counted.items()) if w]
    wrong += [f"the image did not count {name}" for name in limits["instructions"] if name not in counted]
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
