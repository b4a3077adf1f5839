#!/usr/bin/env bash
# POV-Ray 3.7.0.10 (Debian 12: povray 1:3.7.0.10-2+b2): a grid of densities (DF3) with trilinear interpolation.
#
# The grid fills the unit cube. Without interpolation its first voxel is the first of n equal parts, its last the last.
# Expected with "interpolate 1": the values stand in the middles of those parts, or spread from face to face, and beyond
# the outermost nothing is mixed in. Seen: voxel i stands at i / n, half a voxel before its middle, and behind the last
# voxel comes the first again. Of four layers with glowing smoke in the lowest only, half of that layer's light appears
# under the ceiling; the whole cloud is half a voxel lower than without interpolation. A border of empty voxels keeps it
# from coming in on the other side.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends povray=1:3.7.0.10-2+b2 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >grid.py <<'END'
import struct
import subprocess


def column(layers, interpolate):
    """The light along the height of a grid of layers of one value each, from the bottom to the top, in 16 pixels."""
    n = len(layers)
    with open("grid.df3", "wb") as file:
        file.write(struct.pack(">3H", n, n, n))
        file.write(bytes(255 * layers[y] for z in range(n) for y in range(n) for x in range(n)))
    with open("scene.pov", "w") as file:
        file.write(f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ orthographic location <0.5, 0.5, -10> direction z right x * 0.1 up y }}
box {{ 0, 1 hollow pigment {{ rgbt 1 }} interior {{ media {{ emission 1
  density {{ density_file df3 "grid.df3" interpolate {interpolate} }} }} }} }}
""")
    subprocess.run(["povray", "+Iscene.pov", "+Oscene.ppm", "+FP16", "File_Gamma=1", "+W1", "+H16", "-D", "-A", "+WT1"],
                   check=True, stderr=subprocess.DEVNULL)
    pixels = open("scene.ppm", "rb").read()[-6 * 16 :]
    return [int.from_bytes(pixels[i : i + 2], "big") / 65535 for i in range(0, len(pixels), 6)][::-1]


for layers in ((1, 0, 0, 0), (0, 1, 0, 0)):
    for interpolate in (0, 1):
        print(*layers, "interpolate", interpolate, "from below:", *(f"{x:.1f}" for x in column(layers, interpolate)))
END
/usr/bin/python3 grid.py | tee seen
diff - seen <<'END'
1 0 0 0 interpolate 0 from below: 1.0 1.0 1.0 1.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0
1 0 0 0 interpolate 1 from below: 0.9 0.6 0.4 0.1 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.1 0.4 0.6 0.9
0 1 0 0 interpolate 0 from below: 0.0 0.0 0.0 0.0 1.0 1.0 1.0 1.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0
0 1 0 0 interpolate 1 from below: 0.1 0.4 0.6 0.9 0.9 0.6 0.4 0.1 0.0 0.0 0.0 0.0 0.0 0.0 0.0 0.0
END
echo "as before"
