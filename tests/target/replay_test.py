"""The same recording through every build of the monitor: the answers must be the same bytes.

usage: replay_test.py RECORDING REPLAY_BITS KIND=PROGRAM...
REPLAY_BITS: of this host. KIND: a board (almec, mps2-an386, mps2-an500: its replay image) or an architecture
(aarch64, riscv64, s390x: its replay_bits)."""
import hashlib
import pathlib
import sys
import tempfile

import process
import wire

LIMIT_S = 300


def command_for(kind, program, recording, output):
    if kind == "host":
        return [program, recording, output]
    if kind in process.MACHINES:
        return process.qemu(kind, program, arguments=(recording, output))
    return [f"qemu-{kind}", "-L", f"/usr/{kind}-linux-gnu", program, recording, output]


def replay(kind, program, recording, folder):
    """The bytes of the answers."""
    output = pathlib.Path(folder) / f"{kind}.health"
    status, text, seconds = process.run(command_for(kind, program, recording, output), LIMIT_S)
    if status != 0:
        sys.exit(f"{kind}: the replay failed with status {status}: {text}")
    answers = output.read_bytes()
    count = sum(kind_of == wire.HEALTH for kind_of, _ in wire.records(answers))
    print(f"{kind:12} {count} answers, {len(answers)} bytes, sha256 {hashlib.sha256(answers).hexdigest()[:16]}, "
          f"{count / seconds:.0f} frames/s")
    for figure in text.splitlines():
        print(f"{'':12} {figure}")
    return answers


def first_difference(expected, answers):
    for index, (a, b) in enumerate(zip(wire.records(expected), wire.records(answers))):
        if a != b:
            return f"record {index} differs: {a[1].hex()} on the host, {b[1].hex()} there"
    return "one is longer"


def main(recording, replay_bits, *others):
    others = [other.split("=", 1) for other in others]
    process.skip_without(*(program for _, program in others))
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        expected = replay("host", replay_bits, recording, folder)
        for kind, program in others:
            answers = replay(kind, program, recording, folder)
            if answers != expected:
                failures += 1
                print(f"{kind}: NOT the same bytes: {first_difference(expected, answers)}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
