"""Worst-case stack of what lib/c offers, which its users call from where they like, against budget.json.

usage: function_stack.py BOARD BUILD_FOLDER"""
import sys

import figures


def main(board, folder):
    limits = figures.budget()["c_stack_bytes"]
    over = 0
    for name, (size, deepest) in figures.c_stack(figures.Build(board, folder), limits).items():
        print(f"{name}: {size} B of stack, limit {limits[name]} B, deepest: {deepest}")
        over += size > limits[name]
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
