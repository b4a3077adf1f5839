#!/usr/bin/env bash
# meshio 5.0.0 (Debian 12: python3-meshio 7.0.0-3): texture coordinates and normals of Wavefront OBJ.
#
# The faces of an OBJ file say which `vt` and `vn` belongs to each corner ("f 1/3 2/1 3/2"). Expected of meshio.read():
# corner 1 has the third pair of coordinates, or, as vertices of meshio have one pair each, a warning. Seen: vertices
# take the lines in their order, whatever faces say, and a picture is turned on the mesh without a word; so are normals.
# Written again as OBJ, the faces have lost their numbers. Where a seam needs more pairs than there are vertices, the
# file is refused by ValueError.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-meshio=7.0.0-3 >/dev/null ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >read.py <<'END'
import meshio

VERTICES = ["0 0 0", "1 0 0", "0 1 0"]
PAIRS = ["0.25 0.25", "0.5 0.25", "0.25 0.5"]
NORMALS = ["0 0 1", "1 0 0", "0 1 0"]


def read(pairs, face):
    with open("mesh.obj", "w") as file:
        for key, lines in (("v", VERTICES), ("vt", pairs), ("vn", NORMALS)):
            file.writelines(f"{key} {line}\n" for line in lines)
        file.write(face + "\n")
    return meshio.read("mesh.obj")


print("meshio", meshio.__version__)
mesh = read(PAIRS, "f 1/3/3 2/1/1 3/2/2")
for key, said in (("obj:vt", PAIRS), ("obj:vn", NORMALS)):
    print("corner 1,", key, mesh.point_data[key][0].tolist(), "but the file says", said[2])
mesh.write("again.obj")
print("written again:", [line.strip() for line in open("again.obj") if line.startswith("f ")])
try:
    read(PAIRS + ["0.9 0.9"], "f 1/4/3 2/1/1 3/2/2")
except ValueError as error:
    print("with a seam:", error)
END
/usr/bin/python3 read.py | tee seen
diff - seen <<'END'
meshio 5.0.0
corner 1, obj:vt [0.25, 0.25] but the file says 0.25 0.5
corner 1, obj:vn [0.0, 0.0, 1.0] but the file says 0 1 0
written again: ['f 1 2 3']
with a seam: len(points) = 3, but len(point_data["obj:vt"]) = 4
END
echo "as before"
