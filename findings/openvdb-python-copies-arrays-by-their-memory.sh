#!/usr/bin/env bash
# OpenVDB 10.0.1 for Python (Debian 12: python3-openvdb 10.0.1-2): FloatGrid.copyFromArray() of an array that is not in
# C order, as of a simulation in Fortran, of a transposed view, or of numpy.load() of such a file.
#
# Expected: the voxel (i, j, k) has the value a[i, j, k], or the array is refused. Seen: the memory is read as if it were
# in C order, whatever the strides are: all values are there, at other places, and nothing is said. copyToArray() into a
# Fortran array writes likewise, so that what one writes and reads back by the two looks right. numpy.ascontiguousarray()
# gives what was expected.
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

values = numpy.arange(24, dtype=numpy.float32).reshape(2, 3, 4)
for name, array in (("C order", values), ("Fortran order", numpy.asfortranarray(values)), ("transposed", values.T),
                    ("transposed and copied", numpy.ascontiguousarray(values.T))):
    grid = pyopenvdb.FloatGrid()
    grid.copyFromArray(array)
    look_up = grid.getConstAccessor()
    right = sum(look_up.getValue(place) == array[place] for place in numpy.ndindex(array.shape))
    back = numpy.zeros_like(array)
    grid.copyToArray(back)
    print(f"{name}: {right} of 24 voxels are right; read back the same: {numpy.array_equal(back, array)}")
END
cat seen
diff - seen <<'END'
C order: 24 of 24 voxels are right; read back the same: True
Fortran order: 2 of 24 voxels are right; read back the same: True
transposed: 2 of 24 voxels are right; read back the same: True
transposed and copied: 24 of 24 voxels are right; read back the same: True
END
echo "as before"
