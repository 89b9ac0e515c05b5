"""Runs an image that says by its exit status how it went: conformance, unit, watchdog, count.

usage: image_test.py BOARD IMAGE LIMIT_S [QEMU OPTIONS...]"""
import subprocess
import sys

import process


def main(board, image, limit_s, *extra):
    try:
        status, text, _ = process.run(process.qemu(board, image, extra=extra), float(limit_s))
    except subprocess.TimeoutExpired as late:
        print((late.stdout or b"").decode(errors="replace"))
        print(f"{board}: no end within {limit_s} s")
        return 1
    print(text)
    return status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
