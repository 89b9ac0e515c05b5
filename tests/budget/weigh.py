"""Flash, RAM and worst-case stack of a board's product image against the committed budget.

usage: weigh.py --board NAME --image ELF --objects FOLDER... --monitor-object OBJECT [--print-only | --update]
--update writes what was measured into budget.json as the new expectation."""
import argparse
import json
import pathlib
import subprocess
import sys

import stack_depth

BUDGET = pathlib.Path(__file__).with_name("budget.json")
# One for the line, the tick and whatever else has the same priority; one for the watchdog's interrupt or a fault.
INTERRUPT_LEVELS = 2
# A figure may grow by this share before somebody has to look.
TOLERANCE = 0.05


def sections(image):
    text, data, bss = subprocess.run([stack_depth.TOOL + "size", image], stdout=subprocess.PIPE, check=True,
                                     text=True).stdout.splitlines()[1].split()[:3]
    return int(text), int(data), int(bss)


def symbol_size(program, symbol):
    for line in subprocess.run([stack_depth.TOOL + "nm", "-S", program], stdout=subprocess.PIPE, check=True,
                               text=True).stdout.splitlines():
        if line.endswith(" " + symbol):
            return int(line.split()[1], 16)
    raise SystemExit(f"{program}: no symbol {symbol}")


def reserved_stack(image):
    """The linker counts the stack's region as bss."""
    symbols = {}
    for line in subprocess.run([stack_depth.TOOL + "nm", image], stdout=subprocess.PIPE, check=True,
                               text=True).stdout.splitlines():
        symbols[line.split()[-1]] = int(line.split()[0], 16) if len(line.split()) == 3 else 0
    return symbols["__stack_size"]


def measure(options):
    text, data, bss = sections(options.image)
    thread, interrupts, path = stack_depth.worst_case(options.image, options.objects, INTERRUPT_LEVELS)
    stack = thread + interrupts
    return {"flash_bytes": text + data,
            "ram_bytes": data + bss - reserved_stack(options.image) + stack,
            "stack_bytes": stack,
            "sizeof_monitor_bytes": symbol_size(options.monitor_object, "morepro_monitor")}, path


def judge(name, value, limit, expected):
    """What is wrong with a figure; None: nothing."""
    if value > limit:
        return f"{name}: {value} is over the limit of {limit}"
    if expected is not None and value > expected * (1 + TOLERANCE):
        return f"{name}: {value} has grown by more than {TOLERANCE:.0%} from {expected}; if that is meant: weigh.py --update"
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--board", required=True)
    parser.add_argument("--image", required=True)
    parser.add_argument("--objects", nargs="+", required=True)
    parser.add_argument("--monitor-object", required=True)
    parser.add_argument("--print-only", action="store_true")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    budget = json.loads(BUDGET.read_text())
    measured, path = measure(options)
    expected = budget["expected"].setdefault(options.board, {})
    print(f"{options.board}, product image: " + ", ".join(
        f"{name} {value} of {budget['limits'][name]}" for name, value in measured.items()))
    if options.print_only:
        return 0
    print("deepest path: " + " > ".join(path))
    if options.update:
        expected.update(measured)
        BUDGET.write_text(json.dumps(budget, indent=2) + "\n")
        return 0
    wrong = [w for w in (judge(n, v, budget["limits"][n], expected.get(n)) for n, v in measured.items()) if w]
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
