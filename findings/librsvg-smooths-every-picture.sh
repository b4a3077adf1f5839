#!/usr/bin/env bash
# librsvg 2.54.7 (Debian 12: librsvg2-bin 2.54.7+dfsg-1~deb12u2): a small picture in a drawing, enlarged.
#
# Expected: SVG's property image-rendering says how. "optimizeSpeed" of SVG 1.1, and "pixelated" and "crisp-edges" of
# CSS, which the library's own list of features names, keep the pixels of a field of measured values as they are; two
# pixels, black and white, are half a picture each. Seen: whatever is asked for, as an attribute or as a style, the
# drawing is the same as without the property: a ramp over half of its width. So voxels drawn as a small picture are
# blurred in GNOME's viewers, without a word. Browsers do keep them.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends librsvg2-bin=2.54.7+dfsg-1~deb12u2 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >drawings.py <<'END'
import base64
import struct
import subprocess
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def two_pixels():
    """A PNG, one black pixel and a white one beside it."""
    head = struct.pack(">IIBBBBB", 2, 1, 8, 2, 0, 0, 0)
    rows = zlib.compress(bytes([0] + [0] * 3 + [255] * 3))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


def drawn(attribute):
    picture = base64.b64encode(two_pixels()).decode()
    with open("two.svg", "w") as file:
        file.write(f"<svg xmlns='http://www.w3.org/2000/svg' width='100' height='50'><image width='100' height='50' "
                   f"preserveAspectRatio='none' {attribute} href='data:image/png;base64,{picture}'/></svg>")
    subprocess.run(["rsvg-convert", "two.svg", "-o", "two.png"], check=True)
    return open("two.png", "rb").read()


def first_row(png):
    """Red of the first row of three or four channels, whose filter is none or the pixel before."""
    place, data, width, channels = 8, b"", 0, 0
    while place < len(png):
        size, = struct.unpack(">I", png[place:place + 4])
        kind, content = png[place + 4:place + 8], png[place + 8:place + 8 + size]
        if kind == b"IHDR":
            width = struct.unpack(">I", content[:4])[0]
            channels = {2: 3, 6: 4}[content[9]]
        data += content if kind == b"IDAT" else b""
        place += 12 + size
    raw = zlib.decompress(data)
    row = bytearray(raw[1:1 + channels * width])
    assert raw[0] in (0, 1)
    for i in range(channels, len(row) if raw[0] else 0):
        row[i] = (row[i] + row[i - channels]) & 255
    return row[::channels]


plain = drawn("")
row = first_row(plain)
between = sum(0 < value < 255 for value in row)
print(f"without the property: {between} of {len(row)} columns are neither black nor white, from {min(row)} to {max(row)}")
assert (min(row), max(row)) == (0, 255) and between >= 40
for word in ("optimizeSpeed", "pixelated", "crisp-edges", "optimizeQuality"):
    for attribute in (f"image-rendering='{word}'", f"style='image-rendering:{word}'"):
        same = drawn(attribute) == plain
        print(f"{attribute}: {'the same bytes' if same else 'other bytes'}")
        assert same
END
python3 drawings.py
