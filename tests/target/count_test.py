"""Instructions of the functions in the count image, exact, against tests/budget/budget.json.

usage: count_test.py BOARD IMAGE RECORDING
Cycles are an estimate: 1.6 per instruction (nominal for this core), 2.5 at the worst; there is no silicon here."""
import json
import pathlib
import sys

import process

LIMIT_S = 300
BUDGET = pathlib.Path(__file__).parents[1] / "budget" / "budget.json"
# One tick of virtual time per instruction.
EXACT = ("-icount", "shift=0")


def main(board, image, recording):
    status, text, _ = process.run(process.qemu(board, image, arguments=(recording,), extra=EXACT), LIMIT_S)
    if status != 0:
        print(f"the image ended with status {status}: {text}")
        return 1
    limits = json.loads(BUDGET.read_text())["instructions"]
    over = 0
    unseen = set(limits)
    print(f"{'function':28} {'mean':>7} {'most':>7} {'limit':>7}  estimated cycles of the mean")
    for line in text.splitlines():
        name, mean, most = line.split()[0], *map(int, line.split()[1:])
        limit = limits.get(name)
        over += limit is not None and mean > limit
        unseen.discard(name)
        print(f"{name:28} {mean:7} {most:7} {limit or '-':>7}  {1.6 * mean:.0f} .. {2.5 * mean:.0f}")
    if unseen:
        print(f"the image did not count {', '.join(sorted(unseen))}")
    return 1 if over or unseen else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
