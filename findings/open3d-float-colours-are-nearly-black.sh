#!/usr/bin/env bash
# Open3D 0.16.1 (Debian 12: python3-open3d 0.16.1+ds-2+b4): points of a PLY file whose colours are numbers of the type
# float, as those of photons and of HDR scans are.
#
# Expected: red, green and blue of the type float are kept, as those of the type uchar are divided by 255 to lie between 0
# and 1. Seen: io.read_point_cloud() divides by 255 whatever the type is, so that white of 1 becomes 0.0039. The reader
# beside it, t.io.read_point_cloud(), keeps floats as they are: of one file a program shows black points or white ones.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-open3d=0.16.1+ds-2+b4 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >read.py <<'END'
import numpy
import open3d

for kind, white in (("uchar", 255), ("float", 1.0)):
    with open("points.ply", "w") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 1\n" + "".join(f"property float {axis}\n" for axis in "xyz"))
        file.write("".join(f"property {kind} {name}\n" for name in ("red", "green", "blue")) + "end_header\n")
        file.write(f"0 0 0 {white} {white} {white}\n")
    old = numpy.asarray(open3d.io.read_point_cloud("points.ply").colors)[0, 0]
    new = open3d.t.io.read_point_cloud("points.ply").point["colors"].numpy()[0, 0]
    print(f"{kind} {white}: io reads {old:.4g}, t.io reads {new:g}")
END
/usr/bin/python3 read.py 2>/dev/null | grep reads | tee seen
diff - seen <<'END'
uchar 255: io reads 1, t.io reads 255
float 1.0: io reads 0.003922, t.io reads 1
END
echo "as before"
