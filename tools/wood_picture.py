#!/usr/bin/env python3
"""Draws examples/wood.png: a board with the grain along u, made of sines only, so that it goes on over its own edges.

tools/wood_picture.py PICTURE.png
"""

import math
import struct
import sys
import zlib

SIDE = 256  # pixels
LIGHT, DARK = (214, 164, 104), (138, 88, 44)
SHADES = 48


def shade(u, v):
    """0 is light early wood, 1 the dark edge of a year ring."""
    turn = 2 * math.pi
    bend = 0.030 * math.sin(turn * (u + 0.3)) + 0.012 * math.sin(turn * (2 * u + v)) + 0.006 * math.sin(turn * (3 * u - 2 * v))
    ring = (9 * (v + bend) + 0.7 * math.sin(turn * (v + 0.1))) % 1.0
    year = ring**3 * (1.0 - max(0.0, ring - 0.9) / 0.1)
    fibre = 0.5 + 0.5 * math.sin(turn * (53 * (v + 0.6 * bend) + 0.35 * math.sin(turn * (4 * u + 3 * v))))
    return min(1.0, max(0.0, 0.12 + 0.70 * year + 0.16 * fibre))


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def main():
    rows = bytearray()
    for y in range(SIDE):
        rows.append(0)  # no filter
        rows += bytes(round(shade(x / SIDE, 1 - y / SIDE) * (SHADES - 1)) for x in range(SIDE))
    palette = bytes(
        round(light + (dark - light) * i / (SHADES - 1)) for i in range(SHADES) for light, dark in zip(LIGHT, DARK)
    )
    header = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 3, 0, 0, 0)
    with open(sys.argv[1], "wb") as picture:
        picture.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"PLTE", palette))
        picture.write(chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
