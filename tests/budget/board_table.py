"""Memory and instructions of every board that is built, beside their budgets: the table of firmware/README.md.

usage: board_table.py [--builds FOLDER] [--write | --check]
Prints the table. --write puts it into the README instead; --check fails where the README has another one, and is
skipped (77) where a board is not built or another compiler was used than for the README's."""
import argparse
import difflib
import pathlib
import re
import subprocess
import sys

import figures
import stack_depth

BOARDS = ("almec", "mps2-an386", "mps2-an500")
PROJECT = pathlib.Path(__file__).resolve().parents[2]
README = PROJECT / "firmware/README.md"
START, END = "<!-- python3 tests/budget/board_table.py --write -->", "<!-- end of the table -->"
COMPILER = re.compile(r"Compiled by (\S+ [\d.]+),")
MEMORY = {
    "flash_bytes": "product image: flash",
    "ram_bytes": "product image: RAM, worst-case stack included",
    "stack_bytes": "product image: worst-case stack, two interrupts included",
    "sizeof_monitor_bytes": "`sizeof(Monitor)`",
}
C_STACK = "stack of `{}`, for C"
INSTRUCTIONS = {
    "monitor_step": "monitor, the whole step: 11 hypotheses, gap to the model included",
    "morepro_monitor_step": "the same called from C",
    "frame_guard": "guard of a frame",
    "held_inputs": "held inputs",
    "bank_filter_step_n8": "bank of 8, per filter-step",
    "bank_filter_step_n32": "bank of 32, per filter-step",
    "bank_gates_n32": "safety gates of the bank, per filter-step",
    "decision_n11": "decision among 11 hypotheses",
    "chip_load_filter_step": "continuous chip load",
    "feed_filter_step": "feed speed",
    "spindle_parameter_step": "identification, spindle",
    "feed_parameter_step": "identification, feed",
    "derivative_parameter_step": "identification from measured derivatives, all seven",
    "parameter_refresh": "what is identified, judged",
    "gap_watch_step": "watch of the gap",
    "sensor_watch": "watch of the sensors",
    "wear_judge": "word on the tool",
    "receive_byte": "line: a received byte, in its interrupt",
    "decode_frame": "codec: a frame of 7 signals decoded",
    "encode_health": "codec: an answer encoded",
    "kinematics_pose": "kinematics: frames and Jacobian of one pose",
    "inverse_closed_form": "kinematics: closed-form inverse",
    "path_point": "kinematics: a point of a path",
    "clik_step": "kinematics: a step of the iterative inverse",
}


def compiler():
    name = stack_depth.TOOL + "g++"
    done = subprocess.run([name, "-dumpfullversion"], stdout=subprocess.PIPE, check=True, text=True)
    return f"{name} {done.stdout.strip()}"


def figures_of(build, limits):
    """Cells of one column, by row."""
    cells = {MEMORY[name]: f"{value:,}" for name, value in figures.memory(build)[0].items()}
    cells |= {C_STACK.format(name): f"{size:,}"
              for name, (size, _) in figures.c_stack(build, limits["c_stack_bytes"]).items()}
    return cells | {INSTRUCTIONS[name]: f"{mean:,} / {most:,}" if most > mean else f"{mean:,}"
                    for name, (mean, most) in figures.instructions(build).items()}


def budgets(limits):
    """Cells of the last column, by row; their order is the table's."""
    most = limits["most_instructions"]
    cells = {words: f"{limits['limits'][name]:,}" for name, words in MEMORY.items()}
    cells |= {C_STACK.format(name): f"{limit:,}" for name, limit in limits["c_stack_bytes"].items()}
    return cells | {words: f"{limits['instructions'][name]:,}" + (f" / {most[name]:,}" if name in most else "")
                    for name, words in INSTRUCTIONS.items()}


def table(builds):
    limits = figures.budget()
    columns = [figures_of(build, limits) for build in builds]
    lines = [f"Compiled by {compiler()}, `-O3`. Bytes, and instructions per call: mean / most.", "",
             "| what | " + " | ".join(build.board for build in builds) + " | budget |",
             "|---|" + "---:|" * (len(builds) + 1)]
    lines += ["| " + " | ".join([words, *(column[words] for column in columns), limit]) + " |"
              for words, limit in budgets(limits).items()]
    return "\n".join(lines) + "\n"


def in_readme():
    """What stands before the table, the table, what stands after it."""
    text = README.read_text()
    if text.count(START) != 1 or text.count(END) != 1:
        raise SystemExit(f"{README}: the table stands between '{START}' and '{END}'")
    before, rest = text.split(START)
    found, after = rest.split(END)
    return before + START + "\n", found.lstrip("\n"), END + after


def write(new):
    before, _, after = in_readme()
    README.write_text(before + new + after)


def check(new):
    _, old, _ = in_readme()
    made_by = COMPILER.search(old)
    if made_by and made_by.group(1) != compiler():
        print(f"skipped: the table is of {made_by.group(1)}, this is {compiler()}: not comparable")
        return 77
    if old == new:
        return 0
    print("".join(difflib.unified_diff(old.splitlines(True), new.splitlines(True), str(README), "as built")))
    print(f"{README} has other figures than the images. If that is meant: python3 tests/budget/board_table.py --write")
    return 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--builds", type=pathlib.Path, default=PROJECT / "build")
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--write", action="store_true")
    action.add_argument("--check", action="store_true")
    options = parser.parse_args()
    builds = [figures.Build(board, options.builds / board) for board in BOARDS]
    if options.write or options.check:
        figures.process.skip_without(*(file for build in builds for file in build.files()))
    builds = [build for build in builds if all(file.is_file() for file in build.files())]
    if not builds:
        raise SystemExit(f"no board is built in {options.builds}: cmake --workflow --preset almec")
    new = table(builds)
    if options.check:
        return check(new)
    write(new) if options.write else print(new, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
