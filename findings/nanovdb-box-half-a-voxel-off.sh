#!/usr/bin/env bash
# NanoVDB 32.4.2 (Debian 12: libnanovdb-dev 10.0.1-2): the box of a grid in world space.
#
# A value of a grid stands at the integer coordinates of its voxel; with a voxel of 0.5 and no offset, voxels 0 to 3
# stand at 0, 0.5, 1 and 1.5. Expected of worldBBox(), along each axis: 0 to 1.5, as OpenVDB's transform makes of the
# box of active voxels, or half a voxel more at both ends, -0.25 to 1.75. Seen: 0 to 2, from the first value to a whole
# voxel behind the last: a box of the right size for cells around the values, and half a voxel off. What is clipped to
# it, framed by it or centred by it is off by as much, and loses what interpolation gives before the first value.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install g++ libnanovdb-dev=10.0.1-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >box.cpp <<'END'
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/GridHandle.h>

#include <cstdio>

int main() {
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  auto values = builder.getAccessor();
  for (int i = 0; i < 64; ++i) values.setValue(nanovdb::Coord(i / 16, i / 4 % 4, i % 4), 1.0f);
  const auto handle = builder.getHandle<>(0.5, nanovdb::Vec3d(0.0), "density");
  const auto* grid = handle.grid<float>();
  const nanovdb::Vec3d first = grid->indexToWorld(nanovdb::Vec3d(0.0)), last = grid->indexToWorld(nanovdb::Vec3d(3.0));
  std::printf("NanoVDB %d.%d.%d\n", NANOVDB_MAJOR_VERSION_NUMBER, NANOVDB_MINOR_VERSION_NUMBER,
              NANOVDB_PATCH_VERSION_NUMBER);
  std::printf("voxels %d to %d stand at %g to %g, the box is %g to %g\n", grid->indexBBox().min()[0],
              grid->indexBBox().max()[0], first[0], last[0], grid->worldBBox().min()[0], grid->worldBBox().max()[0]);
}
END
g++ -std=c++17 -O1 box.cpp -o box
./box | tee seen
cat >expected <<'END'
NanoVDB 32.4.2
voxels 0 to 3 stand at 0 to 1.5, the box is 0 to 2
END
diff expected seen
