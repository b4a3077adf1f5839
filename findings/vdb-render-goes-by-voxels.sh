#!/usr/bin/env bash
# vdb_render of OpenVDB 10.0.1 (Debian 12: libopenvdb-tools 10.0.1-2): how opaque a fog volume is, by its resolution.
#
# A cube of two units along each edge has the density 1, and vdb_render is told to absorb 0.05. Expected, as of density
# grids in any renderer that knows their transform: the cube hides 1 - exp(-0.1) = 0.10 of what is behind it, however
# many voxels it has. Seen: 0.54, 0.79 and 0.96 for 16, 32 and 64 voxels along an edge, about 1 - exp(-0.05 N): the
# coefficients are per voxel, so that the same fog at twice the resolution is twice as thick, also with a finer -step,
# whose length is in voxels, too. The help names no unit. Where pictures of two resolutions are compared, the
# coefficients must be multiplied by the size of a voxel.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends libopenvdb-tools=10.0.1-2 python3-openvdb=10.0.1-2 python3-numpy \
  openimageio-tools=2.4.7.1+dfsg-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >cube.py <<'END'
import sys

import numpy
import pyopenvdb

side = int(sys.argv[1])
size = 2 / side
grid = pyopenvdb.FloatGrid()
grid.name, grid.gridClass = "density", pyopenvdb.GridClass.FOG_VOLUME
grid.copyFromArray(numpy.ones((side, side, side), numpy.float32))
grid.transform = pyopenvdb.createLinearTransform(size)
grid.transform.translate((size / 2 - 1,) * 3)
pyopenvdb.write("cube.vdb", grids=[grid])
END
for side in 16 32 64; do
  /usr/bin/python3 cube.py "$side"
  for step in 1 0.25; do
    vdb_render cube.vdb cube.exr -camera ortho -frame 1 -translate 0,0,5 -res 9x9 -absorb 0.05,0.05,0.05 -scatter 0,0,0 \
      -cutoff 0.0001 -cpus 1 -step "$step" >/dev/null
    alpha=$(oiiotool cube.exr --printstats | sed -n 's/.*Stats Avg: .* \([0-9.]*\) (float)$/\1/p')
    LC_ALL=C printf 'edge of 2 units in %d voxels, step %s: alpha %.2f\n' "$side" "$step" "$alpha"
  done
done | tee seen
diff - seen <<'END'
edge of 2 units in 16 voxels, step 1: alpha 0.54
edge of 2 units in 16 voxels, step 0.25: alpha 0.54
edge of 2 units in 32 voxels, step 1: alpha 0.79
edge of 2 units in 32 voxels, step 0.25: alpha 0.79
edge of 2 units in 64 voxels, step 1: alpha 0.96
edge of 2 units in 64 voxels, step 0.25: alpha 0.96
END
echo "as before"
