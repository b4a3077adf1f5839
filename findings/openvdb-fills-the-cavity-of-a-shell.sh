#!/usr/bin/env bash
# OpenVDB 10.0.1 for Python (Debian 12: python3-openvdb 10.0.1-2): a closed shell with an outer and an inner surface, as a
# bottle, a balloon or a hollow shell of smoke is modelled, made into a level set.
#
# Expected: the wall is inside and the cavity is outside, as parity and winding numbers have it, at the least where the
# inner surface is oriented towards the cavity. Seen: the cavity is inside as well, whichever way the surfaces are
# oriented, and the inner surface leaves no trace: beside it stands the value of the far inside. What cannot be reached
# from outside without a crossing counts as inside. sdfToFogVolume() then fills the bottle.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-openvdb=10.0.1-2 python3-numpy >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
/usr/bin/python3 - >seen <<'END'
import numpy
import pyopenvdb

FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def cube(half, inwards):
    places = [(x, y, z) for z in (-half, half) for y in (-half, half) for x in (-half, half)]
    return places, [tuple(reversed(face)) if inwards else face for face in FACES]


def signs(inner_inwards):
    outer, inner = cube(1.0, False), cube(0.5, inner_inwards)
    faces = outer[1] + [tuple(corner + 8 for corner in face) for face in inner[1]]
    grid = pyopenvdb.FloatGrid.createLevelSetFromPolygons(
        numpy.array(outer[0] + inner[0], numpy.float32), quads=numpy.array(faces, numpy.uint32),
        transform=pyopenvdb.createLinearTransform(0.1), halfWidth=3)
    look_up = grid.getConstAccessor()
    return [f"{look_up.getValue((i, 0, 0)):.1f}" for i in (0, 4, 6, 9, 11)]


for name, inwards in (("outwards", False), ("towards the cavity", True)):
    print(f"inner surface {name}: centre, cavity, wall, wall, outside", *signs(inwards))
END
cat seen
diff - seen <<'END'
inner surface outwards: centre, cavity, wall, wall, outside -0.3 -0.3 -0.3 -0.1 0.1
inner surface towards the cavity: centre, cavity, wall, wall, outside -0.3 -0.3 -0.3 -0.1 0.1
END
echo "as before"
