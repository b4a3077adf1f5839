#!/usr/bin/env bash
# OpenEXR 3.1.5 (Debian 12: openexr 3.1.5-5): exrmakepreview, of a picture that is four times as wide as its preview.
#
# Expected: each pixel of the preview is the mean of the pixels that it stands for, as thumbnails are. Seen: each is a
# single pixel of the picture, the nearest to its place. Columns of 1 and 0 in turn, which are an even 0.5 from afar,
# become two halves of the preview, one that is as bright as 1 and one that is black; a sky of faint light with one
# bright pixel in a hundred shows these at their full brightness, or would none of them if they lay elsewhere. A noisy
# render has as much noise in its preview as in itself. Nothing is said.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends openexr=3.1.5-5 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >pictures.py <<'END'
import struct
import subprocess

SIZE, PREVIEW = 400, 100  # pixels along an edge


def attribute(name, kind, value):
    return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value


def write_picture(path, light):
    """Floats, not compressed: light(x, y) in all three channels."""
    channels = b"".join(name + b"\0" + struct.pack("<4i", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, SIZE - 1, SIZE - 1)
    header = b"\x76\x2f\x31\x01\x02\0\0\0" + b"".join([
        attribute(b"channels", b"chlist", channels), attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", window), attribute(b"displayWindow", b"box2i", window),
        attribute(b"lineOrder", b"lineOrder", b"\0"), attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))]) + b"\0"
    row = 3 * 4 * SIZE
    first = len(header) + 8 * SIZE
    with open(path, "wb") as file:
        file.write(header)
        file.write(b"".join(struct.pack("<Q", first + y * (8 + row)) for y in range(SIZE)))
        for y in range(SIZE):
            line = b"".join(struct.pack("<f", light(x, y)) for x in range(SIZE))
            file.write(struct.pack("<2i", y, row) + 3 * line)


def red_of_preview(light):
    write_picture("picture.exr", light)
    subprocess.run(["exrmakepreview", "-w", str(PREVIEW), "picture.exr", "with.exr"], check=True)
    data = open("with.exr", "rb").read()
    begin = data.index(b"preview\0preview\0") + 16
    width, height = struct.unpack("<2I", data[begin + 4:begin + 12])
    assert (width, height) == (PREVIEW, PREVIEW)
    return data[begin + 12:begin + 12 + 4 * width * height:4]


def counts(values):
    return {value: values.count(value) for value in sorted(set(values))}


one, half = (set(red_of_preview(lambda x, y: light)).pop() for light in (1.0, 0.5))
columns = counts(red_of_preview(lambda x, y: float(x % 2 == 0)))
stars = counts(red_of_preview(lambda x, y: 100.0 if x % 10 == 5 and y % 10 == 5 else 0.01))
mean = set(red_of_preview(lambda x, y: 0.01 * 100.0 + 0.99 * 0.01)).pop()
print(f"an even 1: {one}; an even 0.5: {half}; columns of 1 and 0: {columns}")
print(f"one pixel in a hundred of 100, the others of 0.01: {stars}; an even light of their mean: {mean}")
assert columns == {0: 5000, one: 5000} and half not in columns
assert set(stars) == {22, 255} and stars[255] == 100 and mean not in stars
END
python3 pictures.py
