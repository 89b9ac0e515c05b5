"""The link's records in Python: written from the format's description, not from the C++ code, so that both are checked."""
import struct
import zlib

FRAME, HEALTH, CONFIGURATION, READY, END, TEXT = 1, 2, 3, 4, 5, 6
CHANNELS = ("armature_voltage_v", "feed_force_n", "contact", "engagement", "spindle_speed_rad_s", "spindle_angle_rad",
            "feed_speed_m_s", "feed_position_m", "armature_current_a", "tool_temperature_degc",
            "winding_temperature_degc", "chip_load_mm", "spindle_acceleration_rad_s2", "feed_acceleration_m_s2")


def stuff(plain):
    """Consistent overhead byte stuffing, without the delimiter."""
    out = bytearray()
    for last, block in _blocks(plain):
        while len(block) >= 254:
            out += b"\xff" + block[:254]
            block = block[254:]
            if not block and last:
                return bytes(out)
        out += bytes([len(block) + 1]) + block
    return bytes(out)


def _blocks(plain):
    blocks = plain.split(b"\0")
    for index, block in enumerate(blocks):
        yield index == len(blocks) - 1, block


def unstuff(encoded):
    out, at = bytearray(), 0
    while at < len(encoded):
        code = encoded[at]
        if code == 0 or at + code > len(encoded):
            raise ValueError("broken byte stuffing")
        out += encoded[at + 1:at + code]
        at += code
        if code != 255 and at < len(encoded):
            out.append(0)
    return bytes(out)


def encode(kind, payload):
    plain = bytes([kind]) + payload
    return stuff(plain + struct.pack("<I", zlib.crc32(plain))) + b"\0"


def encode_frame(sequence, time_us, values):
    """values: {channel name: number}."""
    present = [i for i, name in enumerate(CHANNELS) if name in values]
    bits = sum(1 << i for i in present)
    numbers = [values[CHANNELS[i]] for i in present]
    return encode(FRAME, struct.pack(f"<IIH{len(numbers)}f", sequence & 0xFFFFFFFF, time_us & 0xFFFFFFFF, bits, *numbers))


def encode_end(frames):
    return encode(END, struct.pack("<I", frames))


def decode(encoded):
    """(type, payload) of one record without its delimiter."""
    plain = unstuff(encoded)
    body, crc = plain[:-4], plain[-4:]
    if len(plain) < 5 or struct.unpack("<I", crc)[0] != zlib.crc32(body):
        raise ValueError("wrong check sum")
    return body[0], body[1:]


def records(stream):
    """Every (type, payload) of a byte string; raises ValueError at the first that is broken or cut."""
    *whole, rest = stream.split(b"\0")
    if rest:
        raise ValueError(f"{len(rest)} bytes after the last record")
    return [decode(part) for part in whole if part]
