#!/usr/bin/env bash
# vdb_tool of OpenVDB 10.0.1 (Debian 12: libopenvdb-tools 10.0.1-2): a level set that is scaled.
#
# A level set holds signed distances in world units, and vdb_tool's -transform scales "in world units". Expected of a
# sphere of 1 unit, scaled by 2: the distances to one of 2, with a slope of 1, as of a sphere that is made with that
# radius. Seen: the surface is at 2, but values and background are those of before, so that all distances are halved
# (slope 0.5). What goes by distances afterwards is wrong: -dilate by one voxel of 0.22 moves the surface by 0.36, and by
# 0.22 where the sphere was made with radius 2.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends libopenvdb-tools=10.0.1-2 python3-openvdb=10.0.1-2 python3-numpy \
  >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >distances.py <<'END'
import numpy
import pyopenvdb

grid = pyopenvdb.readAll("sphere.vdb")[0][0]
radii = [numpy.linalg.norm(grid.transform.indexToWorld(tuple(item.min))) for item in grid.citerOnValues()]
slope, offset = numpy.polyfit(radii, [item.value for item in grid.citerOnValues()], 1)
print(f"{slope:.2f} (r - {-offset / slope:.2f}), background {grid.background:.2f}, voxel {grid.transform.voxelSize()[0]:.2f}")
END
while read -r actions; do
  # shellcheck disable=SC2086
  vdb_tool -quiet $actions -write sphere.vdb >/dev/null
  echo "$actions: $(/usr/bin/python3 distances.py)"
done <<'END' | tee seen
-sphere dim=24 radius=2
-sphere dim=24 radius=1 -transform vdb=0 scale=2
-sphere dim=24 radius=2 -dilate radius=1
-sphere dim=24 radius=1 -transform vdb=0 scale=2 -dilate radius=1
END
diff - seen <<'END'
-sphere dim=24 radius=2: 1.00 (r - 2.00), background 0.67, voxel 0.22
-sphere dim=24 radius=1 -transform vdb=0 scale=2: 0.50 (r - 2.00), background 0.33, voxel 0.22
-sphere dim=24 radius=2 -dilate radius=1: 1.00 (r - 2.22), background 0.67, voxel 0.22
-sphere dim=24 radius=1 -transform vdb=0 scale=2 -dilate radius=1: 0.89 (r - 2.36), background 0.33, voxel 0.22
END
echo "as before"
