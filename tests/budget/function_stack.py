"""Worst-case stack of single functions of an image, which its users call from where they like.

usage: function_stack.py IMAGE OBJECTS FUNCTION=LIMIT_BYTES..."""
import sys

import stack_depth


def main(image, objects, *wanted):
    functions = stack_depth.disassemble(image)
    for name, size in stack_depth.compiled_frames([objects]).items():
        if name in functions:
            functions[name].frame = size
    over = 0
    for name, limit in (word.split("=") for word in wanted):
        if name not in functions:
            raise SystemExit(f"{image}: no function {name}")
        size, path = stack_depth.depth(functions, name)
        print(f"{name}: {size} B of stack, limit {limit} B, deepest: {path[-1]}")
        over += size > int(limit)
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
