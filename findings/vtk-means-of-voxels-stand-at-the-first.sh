#!/usr/bin/env bash
# VTK 9.1.0 (Debian 12: python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1): vtkImageShrink3D, which makes a volume coarser
# by the means of blocks of voxels.
#
# The value of each voxel is its place along x. Expected: so is each mean, at the place that the result gives to it.
# Seen: the means are right, but the origin stays, so that each stands at the first voxel of its block: the mean of 0
# and 1 at 0, by blocks of four the mean of 0 to 3, which is 1.5, at 0. A coarse copy of a cloud is moved by half a
# block less half a voxel along each axis, and its box ends too early.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 >/dev/null ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >shrink.py <<'END'
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIDE = 8
places = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE][2]
volume = vtk.vtkImageData()
volume.SetDimensions(SIDE, SIDE, SIDE)
volume.GetPointData().SetScalars(numpy_to_vtk(places.astype(numpy.float32).ravel(), deep=True))
for block in (2, 4):
    shrink = vtk.vtkImageShrink3D()
    shrink.SetShrinkFactors(block, block, block)
    shrink.MeanOn()
    shrink.SetInputData(volume)
    shrink.Update()
    coarse = shrink.GetOutput()
    values = vtk_to_numpy(coarse.GetPointData().GetScalars())[: SIDE // block]
    stands = [coarse.GetPoint(i)[0] for i in range(SIDE // block)]
    print("blocks of", block, "means", [float(value) for value in values], "at", stands)
END
/usr/bin/python3 shrink.py | tee seen
diff - seen <<'END'
blocks of 2 means [0.5, 2.5, 4.5, 6.5] at [0.0, 2.0, 4.0, 6.0]
blocks of 4 means [1.5, 5.5] at [0.0, 4.0]
END
echo "as before"
