#!/usr/bin/env bash
# CloudCompare 2.11.3 (Debian 12: cloudcompare 2.11.3-7.1): normals of points.
#
# A binary PLY file holds 500 points with unit normals as floats. Expected: written out again by the program, with nine
# digits, they are the same, or differ in their last digits. Seen: 489 are turned, by up to 0.2 degrees: normals are kept
# as numbers of directions in a table. What takes normals for directions of light, as files of photons do, gets
# others.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends cloudcompare=2.11.3-7.1 >/dev/null 2>&1 ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >normals.py <<'END'
import math
import struct
import sys

COUNT = 500
HEADER = (f"ply\nformat binary_little_endian 1.0\nelement vertex {COUNT}\n"
          + "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz")) + "end_header\n").encode()


def normal(i):  # a spiral over the sphere
    z, turn = 1 - (2 * i + 1) / COUNT, 2.399963 * i
    across = math.sqrt(1 - z * z)
    return across * math.cos(turn), across * math.sin(turn), z


if sys.argv[1] == "write":
    with open("points.ply", "wb") as file:
        file.write(HEADER + b"".join(struct.pack("<6f", i, i % 7, i % 5, *normal(i)) for i in range(COUNT)))
else:
    rows = [list(map(float, line.split())) for line in open(sys.argv[2])]
    angles = []
    for i, row in enumerate(rows):
        cosine = sum(a * b for a, b in zip(row[-3:], normal(i))) / math.dist((0, 0, 0), row[-3:])
        angles.append(math.degrees(math.acos(min(1.0, cosine))))
    print(len(rows), "normals, turned by more than 0.01 degrees:", sum(angle > 0.01 for angle in angles),
          "and at most by", round(max(angles), 1), "degrees")
END
python3 normals.py write
QT_QPA_PLATFORM=offscreen CloudCompare -SILENT -NO_TIMESTAMP -O points.ply -C_EXPORT_FMT ASC -PREC 9 -SAVE_CLOUDS \
  >/dev/null 2>&1
python3 normals.py read points.asc | tee seen
diff - seen <<'END'
500 normals, turned by more than 0.01 degrees: 489 and at most by 0.2 degrees
END
echo "as before"
