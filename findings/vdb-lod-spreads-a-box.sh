#!/usr/bin/env bash
# OpenVDB 10.0.1 (Debian 12: libopenvdb-tools 10.0.1-2, python3-openvdb 10.0.1-2): coarser levels by vdb_lod.
#
# The tool says that it makes a volume mipmap, each level half the resolution of the one before. Expected: the mean of
# each 2^3 voxels, as in mipmaps of pictures, so that a box of 8^3 voxels of density 1 is one of 4^3, 2^3 and 1^3 voxels
# of density 1 that fill the same place. Seen: voxel i of a level stands where voxel 2i of the one before stands, and
# takes from all 27 around that, half as much for each axis along which one is beside it. The box becomes 5^3, 3^3 and
# 2^3 voxels, those through the middle of the first 0.75, 1, 1, 1, 0.25, and the densest voxel of the last has 0.18 in
# the place of 1. The sum times the volume of a voxel is kept, 0.512 m^3. So a coarse level in the place of a fine one is
# a larger and thinner cloud, which lets more light through where it was thickest.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends libopenvdb-tools=10.0.1-2 python3-openvdb=10.0.1-2 python3-numpy >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >levels.py <<'END'
import subprocess

import numpy
import pyopenvdb

box = pyopenvdb.FloatGrid()
box.name = "density"
box.copyFromArray(numpy.ones((8, 8, 8), numpy.float32))
box.transform = pyopenvdb.createLinearTransform(0.1)
pyopenvdb.write("fine.vdb", [box])
subprocess.run(["vdb_lod", "fine.vdb", "levels.vdb", "-range", "0-3"], check=True, stdout=subprocess.DEVNULL)
for level in range(4):
    grid = pyopenvdb.read("levels.vdb", f"density_level_{level}")
    low, high = grid.evalActiveVoxelBoundingBox()
    values = numpy.zeros([b - a + 1 for a, b in zip(low, high)], numpy.float32)
    grid.copyToArray(values, ijk=low)
    middle = values[:, values.shape[1] // 2, values.shape[2] // 2]
    total = values.sum(dtype=float) * grid.transform.voxelVolume()
    print(f"level {level}: {values.shape[0]}^3 voxels of {grid.transform.voxelSize()[0]:g} m, total {total:.3f},",
          f"densest {values.max():.2f}; through the middle", *(f"{value:.2f}" for value in middle))
END
/usr/bin/python3 levels.py | tee seen
diff - seen <<'END'
level 0: 8^3 voxels of 0.1 m, total 0.512, densest 1.00; through the middle 1.00 1.00 1.00 1.00 1.00 1.00 1.00 1.00
level 1: 5^3 voxels of 0.2 m, total 0.512, densest 1.00; through the middle 0.75 1.00 1.00 1.00 0.25
level 2: 3^3 voxels of 0.4 m, total 0.512, densest 1.00; through the middle 0.62 1.00 0.38
level 3: 2^3 voxels of 0.8 m, total 0.512, densest 0.18; through the middle 0.11 0.08
END
echo "as before"
