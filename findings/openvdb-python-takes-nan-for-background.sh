#!/usr/bin/env bash
# OpenVDB 10.0.1 for Python (Debian 12: python3-openvdb 10.0.1-2): FloatGrid.copyFromArray() of a simulation's array that
# has values which are not finite.
#
# Expected: values that are not finite come into the grid, where a renderer finds them and refuses or counts them.
# Seen: infinities do; a NaN becomes the background, inactive, also among values that are kept, as whether a value is
# background is asked by a comparison that a NaN never fails. A simulation that has gone wrong has holes, and no voxel
# tells why.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-openvdb=10.0.1-2 python3-numpy >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
/usr/bin/python3 - >seen <<'END'
import math

import numpy
import pyopenvdb

for value in (math.inf, -math.inf, math.nan):
    array = numpy.ones((8, 8, 8), numpy.float32)
    array[1, 2, 3] = value
    grid = pyopenvdb.FloatGrid()
    grid.copyFromArray(array)
    print(f"{value}: {grid.activeVoxelCount()} of 512 voxels are active, there is {grid.getConstAccessor().getValue((1, 2, 3))}")
END
cat seen
diff - seen <<'END'
inf: 512 of 512 voxels are active, there is inf
-inf: 512 of 512 voxels are active, there is -inf
nan: 511 of 512 voxels are active, there is 0.0
END
echo "as before"
