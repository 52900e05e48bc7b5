"""What is in a PNG of eight bits a channel that is not interlaced, by the standard's own words and not by a library.

Usage: png_pixels.py FILE [X,Y]... [X0:X1,Y0:Y1]...; prints its width and height, the colour of each pixel (#rrggbb),
and of each box the columns and rows (from, to) that what is much darker than white takes; "nothing" if nothing is.
Exits 1 if a chunk's checksum is wrong.
"""
import struct
import sys
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunks(data):
    assert data.startswith(SIGNATURE), "no PNG"
    at = len(SIGNATURE)
    while at < len(data):
        (length,) = struct.unpack(">I", data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        (checksum,) = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        if checksum != zlib.crc32(kind + body):
            sys.exit(f"the checksum of {kind} is wrong")
        yield kind, body
        at += 12 + length


def paeth(left, above, corner):
    guess = left + above - corner
    return min((left, above, corner), key=lambda value: abs(guess - value))


def unfiltered(lines, height, stride, step):
    before, rows = bytearray(stride), []
    for y in range(height):
        kind, line = lines[y * (stride + 1)], bytearray(lines[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            left, corner = (line[x - step], before[x - step]) if x >= step else (0, 0)
            above = before[x]
            line[x] = line[x] + (0, left, above, (left + above) // 2, paeth(left, above, corner))[kind] & 0xff
        rows.append(line)
        before = line
    return rows


parts = list(chunks(open(sys.argv[1], "rb").read()))
width, height, depth, colour_type, _, _, interlaced = struct.unpack(">IIBBBBB", parts[0][1])
assert depth == 8 and not interlaced, "not of the kind that is read here"
channels = {0: 1, 2: 3, 6: 4}[colour_type]
lines = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
rows = unfiltered(lines, height, width * channels, channels) if len(sys.argv) > 2 else []


def pixel(x, y):
    found = rows[y][x * channels:(x + 1) * channels]
    return tuple(found[:3]) if channels > 1 else (found[0],) * 3


def dark_box(columns, lines):
    dark = [(x, y) for y in range(*lines) for x in range(*columns) if sum(pixel(x, y)) < 3 * 128]
    if not dark:
        return "nothing"
    xs, ys = zip(*dark)
    return f"{min(xs)} {max(xs)} {min(ys)} {max(ys)}"


print(width, height)
for place in sys.argv[2:]:
    if ":" in place:
        print(dark_box(*(tuple(int(n) for n in span.split(":")) for span in place.split(","))))
    else:
        print("#%02x%02x%02x" % pixel(*(int(n) for n in place.split(","))))
