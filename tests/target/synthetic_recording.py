"""A recording of made-up but machine-like signals: enough to exercise every field without the simulator.

usage: synthetic_recording.py FRAMES FILE"""
import math
import pathlib
import sys

import wire


def frames(count, rate_hz=10000):
    for i in range(count):
        t = i / rate_hz
        yield {
            "armature_voltage_v": 36 + 6 * math.sin(2 * math.pi * 3 * t),
            "feed_force_n": 30 + 5 * math.sin(2 * math.pi * 1.3 * t),
            "contact": float(i * 4 > count),
            "spindle_speed_rad_s": 400 + 40 * math.sin(2 * math.pi * 3 * t + 0.2) + ((i * 7919) % 97) / 97,
            "feed_speed_m_s": 0.05 + 0.01 * math.sin(2 * math.pi * 1.3 * t),
            "armature_current_a": 3 + math.sin(2 * math.pi * 3 * t + 0.5) + ((i * 104729) % 89) / 890,
            "tool_temperature_degc": 480 + 20 * t,
        }


def recording(count, rate_hz=10000):
    """Bytes of a whole recording with missing, duplicated, damaged and non-finite frames among the good ones."""
    out = bytearray()
    for i, values in enumerate(frames(count, rate_hz)):
        if i % 1009 == 500:
            continue
        if i % 1511 == 700:
            values["spindle_speed_rad_s"] = float("nan")
        if i % 1723 == 800:
            values["armature_current_a"] = float("inf")
        record = wire.encode_frame(i, i * 1000000 // rate_hz, values)
        if i % 2003 == 900:
            record = bytes([record[0], record[1] ^ 0x10 or 1]) + record[2:]
        out += record * (2 if i % 1301 == 600 else 1)
    return bytes(out) + wire.encode_end(count)


if __name__ == "__main__":
    pathlib.Path(sys.argv[2]).write_bytes(recording(int(sys.argv[1])))
