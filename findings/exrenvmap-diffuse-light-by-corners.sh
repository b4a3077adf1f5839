#!/usr/bin/env bash
# OpenEXR 3.1.5 (Debian 12: openexr 3.1.5-5; pictures by openimageio-tools 2.4.7.1): diffuse light of a sky by exrenvmap.
#
# By its help, `exrenvmap -b` gives the colour of a white diffuse reflector of each direction: the irradiance over pi.
# Expected: under a sky that is 1 on the face +Z of a cube and 0 elsewhere, 0.554 for a reflector that looks at that
# face (the form factor of a square from half its side away, 4/(sqrt(2) pi) atan(1/sqrt(2))), 0.111 for those that look
# along the other four axes, and 0 behind. Seen: 0.489, 0.128 and 0, at any resolution, though a sky of 1 everywhere
# gives 1.01. Those are the figures of pixels whose weight grows as the square of the distance from the middle of the
# cube, where solid angles fall with its third power: directions to corners count 16 times what they should, beside
# those to the middle of a face. A light ahead is 12 % too dark, one beside 15 % too bright.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends openexr=3.1.5-5 openimageio-tools=2.4.7.1+dfsg-2 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for face in +X -X +Y -Y +Z -Z; do
  light=0
  [ "$face" != +Z ] || light=1
  oiiotool --pattern constant:color=$light,$light,$light,1 64x64 4 -d half -o "sky$face.exr"
  oiiotool --pattern constant:color=1,1,1,1 64x64 4 -d half -o "white$face.exr"
done
centre() { oiiotool --dumpdata "$1" | awk '$1 == "Pixel" && $2 == "(16," && $3 == "16):" { printf "%.3f", $4 }'; }
{
  for sky in sky white; do
    exrenvmap -b -c -w 33 "$sky%.exr" "diffuse$sky%.exr" >/dev/null
    printf "%s:" $sky
    for face in +X -X +Y -Y +Z -Z; do printf " %s %s" "$face" "$(centre "diffuse$sky$face.exr")"; done
    echo
  done
  /usr/bin/python3 - <<'END'
import math

n = 500
places = [(2 * i + 1) / n - 1 for i in range(n)]


def ahead(power):
    """Of a reflector that looks at the lit face, where pixels weigh distance ** power."""
    face = beside = 0.0
    for u in places:
        for v in places:
            r = math.sqrt(1 + u * u + v * v)
            face += r ** (power - 1)
            beside += max(v, 0) * r ** (power - 1)
    return face / (face + 4 * beside)


print(f"by solid angles {ahead(-3):.3f}, by the square of the distance {ahead(2):.3f}")
END
} | tee seen
diff - seen <<'END'
sky: +X 0.128 -X 0.128 +Y 0.128 -Y 0.128 +Z 0.489 -Z 0.000
white: +X 1.013 -X 1.013 +Y 1.013 -Y 1.013 +Z 1.013 -Z 1.013
by solid angles 0.554, by the square of the distance 0.488
END
echo "as before"
