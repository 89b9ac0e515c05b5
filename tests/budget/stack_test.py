"""Computed against painted: a replay must never have used more stack than the call graph allows.

usage: stack_test.py BOARD REPLAY_IMAGE RECORDING OBJECTS..."""
import pathlib
import sys
import tempfile

import stack_depth

sys.path.append(str(pathlib.Path(__file__).parents[1] / "target"))
import process  # noqa: E402  (lies in the folder of the emulator's scripts)

LIMIT_S = 120
# The replay image has no interrupt but those that end it.
INTERRUPT_LEVELS = 0
# What was painted must be most of what was computed, or one of the two looks at the wrong thing.
LEAST_SHARE = 0.5


def painted(board, image, recording):
    with tempfile.TemporaryDirectory() as folder:
        answers = str(pathlib.Path(folder) / "answers")
        status, text, _ = process.run(process.qemu(board, image, arguments=(recording, answers)), LIMIT_S)
    figures = dict(line.split() for line in text.splitlines() if len(line.split()) == 2)
    if status != 0:
        sys.exit(f"the replay ended with status {status}: {text}")
    return int(figures["painted_stack"])


def main(board, image, recording, *objects):
    computed, _, _ = stack_depth.worst_case(image, objects, INTERRUPT_LEVELS)
    used = painted(board, image, recording)
    print(f"{board}, replay image: {used} B of stack painted over, {computed} B computed for the worst case")
    return 0 if LEAST_SHARE * computed <= used <= computed else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
