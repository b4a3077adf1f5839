#!/usr/bin/env bash
# VTK 9.1.0 (Debian 12: python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1): derivatives of an image at its border, as for
# the light on a density grid that reaches the border.
#
# The values rise by 2 a voxel. Expected of vtkImageGradient and vtkImageGradientMagnitude, as of numpy.gradient and of
# VTK's own vtkGradientFilter: 2 everywhere, by one-sided differences at the border. Seen: 1 at the border, as the
# voxel beyond repeats the last one and the difference to it is still divided by two spacings. Of x^2, whose second
# derivative is 2, vtkImageLaplacian makes 1 and -7 there. A medium that fills its grid so has a false shell of half the
# slope. HandleBoundariesOff() leaves the border out.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 >/dev/null ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >rim.py <<'END'
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

SIDE = 5


def image(values):
    made = vtk.vtkImageData()
    made.SetDimensions(SIDE, SIDE, SIDE)
    scalars = numpy_to_vtk(numpy.ascontiguousarray(values, dtype=numpy.float32).ravel(), deep=True)
    scalars.SetName("density")
    made.GetPointData().SetScalars(scalars)
    return made


def along_x(array):
    values = vtk_to_numpy(array).reshape(SIDE, SIDE, SIDE, -1)
    return [float(value) for value in values[SIDE // 2, SIDE // 2, :, 0]]


x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE][2]
for name, values in (("vtkImageGradient", 2 * x), ("vtkImageGradientMagnitude", 2 * x), ("vtkImageLaplacian", x * x)):
    of_image = getattr(vtk, name)()
    of_image.SetDimensionality(3)
    of_image.SetInputData(image(values))
    of_image.Update()
    print(name, along_x(of_image.GetOutput().GetPointData().GetScalars()))
of_data = vtk.vtkGradientFilter()
of_data.SetInputData(image(2 * x))
of_data.SetInputScalars(0, "density")
of_data.Update()
print("vtkGradientFilter", along_x(of_data.GetOutput().GetPointData().GetArray("Gradients")))
END
/usr/bin/python3 rim.py | tee seen
diff - seen <<'END'
vtkImageGradient [1.0, 2.0, 2.0, 2.0, 1.0]
vtkImageGradientMagnitude [1.0, 2.0, 2.0, 2.0, 1.0]
vtkImageLaplacian [1.0, 2.0, 2.0, 2.0, -7.0]
vtkGradientFilter [2.0, 2.0, 2.0, 2.0, 2.0]
END
echo "as before"
