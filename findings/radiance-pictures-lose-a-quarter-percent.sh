#!/usr/bin/env bash
# Four writers and three readers of Radiance pictures (Debian 12: openimageio-tools 2.4.7.1+dfsg-2, python3-opencv
# 4.6.0+dfsg-12, imagemagick 8:6.9.11.60+dfsg-1.6+deb12u15, pfstools 2.2.0-5+b1): a picture of even noise from 1/2 to 1,
# written by each and read by each.
#
# Expected: mantissas of 8 bits are rounded to the nearest, so that the mean of many pixels stays to 1e-4 or so. Seen:
# every writer cuts off, and no reader puts back the half step that Ward's own definition adds on reading (Graphics Gems
# II, 1991, p. 80): the picture loses 0.26 % of its light, whichever way it goes. That is as much as two renderers may
# differ in a careful comparison, and as a photographed sky tells of the sun's power.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends openimageio-tools=2.4.7.1+dfsg-2 python3-opencv=4.6.0+dfsg-12 \
  imagemagick=8:6.9.11.60+dfsg-1.6+deb12u15 pfstools=2.2.0-5+b1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >lose.py <<'END'
import subprocess

import cv2
import numpy as np


def output_of(command):
    return subprocess.run(command, shell=True, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


picture = np.random.default_rng(1).uniform(0.5, 1.0, (256, 256, 3)).astype(np.float32)
cv2.imwrite("noise.pfm", picture)
cv2.imwrite("OpenCV.hdr", picture)
output_of("oiiotool noise.pfm -d float -o noise.exr && oiiotool noise.exr -o OpenImageIO.hdr")
output_of("pfsinpfm noise.pfm | pfsoutrgbe pfstools.hdr")
output_of("convert-im6.q16 noise.pfm ImageMagick.hdr")


def means(name):
    line = [line for line in output_of(f"oiiotool --stats {name}").decode().splitlines() if "Stats Avg" in line][0]
    floats = np.frombuffer(output_of(f"pfsinrgbe {name} | pfsoutpfm -")[-picture.nbytes:], "<f4")
    return {"OpenImageIO": np.mean([float(word) for word in line.split()[2:5]]),
            "OpenCV": cv2.imread(name, cv2.IMREAD_UNCHANGED).mean(dtype=np.float64),
            "pfstools": floats.mean(dtype=np.float64)}


for writer in ("OpenImageIO", "OpenCV", "pfstools", "ImageMagick"):
    print(f"by {writer}, read by", ", ".join(f"{reader} {100 * (mean / picture.mean(dtype=np.float64) - 1):.2f} %"
                                           for reader, mean in means(writer + ".hdr").items()))
END
/usr/bin/python3 lose.py | tee seen
diff - seen <<'END'
by OpenImageIO, read by OpenImageIO -0.26 %, OpenCV -0.26 %, pfstools -0.26 %
by OpenCV, read by OpenImageIO -0.26 %, OpenCV -0.26 %, pfstools -0.26 %
by pfstools, read by OpenImageIO -0.26 %, OpenCV -0.26 %, pfstools -0.26 %
by ImageMagick, read by OpenImageIO -0.26 %, OpenCV -0.26 %, pfstools -0.26 %
END
echo "as before"
