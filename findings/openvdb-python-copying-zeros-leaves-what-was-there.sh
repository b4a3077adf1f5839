#!/usr/bin/env bash
# OpenVDB 10.0.1 for Python (Debian 12: python3-openvdb 10.0.1-2): FloatGrid.copyFromArray() twice into one grid, as for
# the frames of an animation.
#
# Expected: afterwards the grid has the values of the second array, those equal to the background inactive. Seen: so it
# is in leaves of 8^3 voxels of which the second array has any other value. Leaves where it is background everywhere keep
# the first array's values: smoke of the first frame stays wherever the second has none for 8 voxels. The same frame into
# a new grid, or after clear(), is right.
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

first = numpy.ones((16, 16, 16), numpy.float32)
second = numpy.zeros((16, 16, 16), numpy.float32)
second[1, 1, 1] = 7
grid = pyopenvdb.FloatGrid()
grid.copyFromArray(first)
for name, array in (("all zeros", 0 * second), ("one 7", second)):
    grid.copyFromArray(array)
    back = numpy.zeros_like(array)
    grid.copyToArray(back)
    print(f"{name}: {grid.activeVoxelCount()} active voxels, {(back == 1).sum()} of the first array's")
grid.clear()
grid.copyFromArray(second)
print(f"after clear(): {grid.activeVoxelCount()} active voxel")
END
cat seen
diff - seen <<'END'
all zeros: 4096 active voxels, 4096 of the first array's
one 7: 3585 active voxels, 3584 of the first array's
after clear(): 1 active voxel
END
echo "as before"
