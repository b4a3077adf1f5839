#!/usr/bin/env bash
# POV-Ray 3.7.0.10 (Debian 12: povray 1:3.7.0.10-2+b2): the five types of scattering of media, which are its phase
# functions.
#
# Expected: with the same coefficient every type takes the same light out of a beam and spreads it over the sphere, only
# in other directions, so that the mean over all directions is that of the isotropic type 1. Seen, in units of it: the
# Henyey-Greenstein function of type 5 keeps to it at any eccentricity, 1.00. Rayleigh's type 4 spreads 1.07, the haze
# of type 2 1.15 and the murky type 3 1.25 of the light, while the beam loses 1: a quarter of a thick fog's light is
# made up at each scattering, and a scene that changes from type 3 to type 5 gets darker. (Of thin balls, lit at the
# 64 angles of Gauss's quadrature.)
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends povray=1:3.7.0.10-2+b2 python3-numpy >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >phases.py <<'END'
import math
import subprocess

import numpy

# Beside one another in one picture: a thin ball for each direction, in the light of its own lamp only.
COSINES, WEIGHTS = numpy.polynomial.legendre.leggauss(64)


def spread(scattering, strength):
    """The mean over the sphere of the light that a ball scatters to the camera."""
    balls = ""
    for i, cosine in enumerate(COSINES):
        sine = math.sqrt(1 - cosine * cosine)
        balls += f"""light_group {{
  light_source {{ <{i} - {1000 * sine}, 0, {1000 * cosine}> rgb {strength} parallel point_at <{i}, 0, 0> }}
  sphere {{ <{i}, 0, 0>, 0.45 hollow pigment {{ rgbt 1 }} interior {{ media {{
    scattering {{ {scattering[0]}, 0.001 {scattering[1]} }} samples 10 }} }} }}
  global_lights off }}
"""
    with open("scene.pov", "w") as file:
        file.write(f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ orthographic location <31.5, 0, -10> direction z right 64 * x up y * 0.01 }}
{balls}""")
    subprocess.run(["povray", "+Iscene.pov", "+Oscene.ppm", "+FP16", "File_Gamma=1", "+W64", "+H1", "-D", "-A", "+WT1"],
                   check=True, stderr=subprocess.DEVNULL)
    pixels = numpy.frombuffer(open("scene.ppm", "rb").read()[-6 * 64 :], ">u2").reshape(64, 3)[:, 0]
    assert 0 < pixels.min() and pixels.max() < 65535, (pixels.min(), pixels.max())
    return numpy.dot(WEIGHTS, pixels) / 2 / strength


isotropic = spread((1, ""), 20)
for name, scattering in (("isotropic", (1, "")), ("haze", (2, "")), ("murky", (3, "")), ("Rayleigh", (4, "")),
                         ("eccentricity 0.5", (5, "eccentricity 0.5")), ("eccentricity -0.7", (5, "eccentricity -0.7"))):
    print(f"{name} {spread(scattering, 20) / isotropic:.2f}")
END
/usr/bin/python3 phases.py | tee seen
diff - seen <<'END'
isotropic 1.00
haze 1.15
murky 1.25
Rayleigh 1.07
eccentricity 0.5 1.00
eccentricity -0.7 1.00
END
echo "as before"
