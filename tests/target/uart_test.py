"""Frames over the board's UART, answers back: every frame is answered, and with the bytes of a replay on this host.

usage: uart_test.py BOARD IMAGE REPLAY_BITS RECORDING
In the middle the line rests for a moment, so that the board falls asleep and has to be woken by its receive interrupt."""
import pathlib
import sys
import tempfile
import time

import process
import wire

LIMIT_S = 300
REST_S = 0.3


def answers_on_host(replay_bits, recording):
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "answers"
        status, text, _ = process.run([replay_bits, recording, output], LIMIT_S)
        if status != 0:
            sys.exit(f"the replay on the host failed: {text}")
        return [payload for kind, payload in wire.records(output.read_bytes()) if kind == wire.HEALTH]


def wait_until_ready(line):
    while wire.decode(line.record())[0] != wire.READY:
        pass


def send_with_rest(line, stream):
    line.send(stream[:len(stream) // 2])
    time.sleep(REST_S)
    line.send(stream[len(stream) // 2:])


def answers_on_board(board, image, stream):
    answers = []
    with process.Line(process.qemu(board, image, serial="stdio"), LIMIT_S) as line:
        wait_until_ready(line)
        line.in_background(lambda: send_with_rest(line, stream))
        while True:
            kind, payload = wire.decode(line.record())
            if kind == wire.HEALTH:
                answers.append(payload)
            if kind == wire.END:
                return answers


def main(board, image, replay_bits, recording):
    process.skip_without(image)
    expected = answers_on_host(replay_bits, recording)
    start = time.monotonic()
    got = answers_on_board(board, image, pathlib.Path(recording).read_bytes())
    seconds = time.monotonic() - start
    different = sum(a != b for a, b in zip(got, expected))
    print(f"{board}: {len(got)} answers over the UART in {seconds:.1f} s ({len(got) / seconds:.0f} frames/s); "
          f"host: {len(expected)}; different: {different}")
    return 0 if len(got) == len(expected) > 0 and different == 0 else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
