#!/usr/bin/env bash
# Four readers of Radiance pictures (Debian 12: openimageio-tools 2.4.7.1+dfsg-2, python3-opencv 4.6.0+dfsg-12,
# imagemagick 8:6.9.11.60+dfsg-1.6+deb12u15, pfstools 2.2.0-5+b1): a picture with a line EXPOSURE= in its header.
#
# Radiance's programs write such a line whenever they scale a picture, and the radiance is the stored number over the
# product of all of them. Expected: a reader that gives floats divides, as they are no radiances else, or tells the
# product. Seen: pfstools divides. OpenImageIO, OpenCV and ImageMagick give the stored numbers. OpenImageIO and
# ImageMagick tell the last line's value for the whole, 4 where the two make 2, and in the EXR that oiiotool writes
# there is none of it. So a lamp of 1 that was stored at half is 1 or 0.5, and comparisons of two exposures fail.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends openimageio-tools=2.4.7.1+dfsg-2 python3-opencv=4.6.0+dfsg-12 \
  imagemagick=8:6.9.11.60+dfsg-1.6+deb12u15 pfstools=2.2.0-5+b1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >read.py <<'END'
import struct
import subprocess

import cv2


def said(command):
    return subprocess.run(command, shell=True, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


# A grey of 1/2 in the units of the file: mantissas of 128, and an exponent of 0.
for exposure in ("", "EXPOSURE=0.5\n", "EXPOSURE=0.5\nEXPOSURE=4\n"):
    with open("grey.hdr", "wb") as file:
        file.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{exposure}\n-Y 4 +X 4\n".encode() + bytes((128, 128, 128, 128)) * 16)
    info = said("oiiotool --info -v grey.hdr --printstats").decode()
    greys = {
        "pfstools": struct.unpack("<f", said("pfsinrgbe grey.hdr | pfsoutpfm -")[-4:])[0],
        "OpenImageIO": [line.split()[2] for line in info.splitlines() if "Stats Avg" in line][0],
        "OpenCV": cv2.imread("grey.hdr", cv2.IMREAD_UNCHANGED)[2, 2, 0],
        "ImageMagick": said("convert-im6.q16 grey.hdr -set colorspace RGB -format '%[fx:mean]' info:").decode(),
    }
    said("oiiotool grey.hdr -d half -o grey.exr")
    told = [[line.split()[1] for line in lines.splitlines() if "exposure" in line.lower()] for lines in
            (info, said("oiiotool --info -v grey.exr").decode(), said("identify-im6.q16 -verbose grey.hdr").decode())]
    print(exposure.replace("\n", " ") or "none ", *(f"{name} {float(grey):.3f}" for name, grey in greys.items()),
          "told by OpenImageIO, its EXR and ImageMagick:", *(values[0] if values else "-" for values in told))
END
/usr/bin/python3 read.py | tee seen
diff - seen <<'END'
none  pfstools 0.500 OpenImageIO 0.500 OpenCV 0.500 ImageMagick 0.500 told by OpenImageIO, its EXR and ImageMagick: - - -
EXPOSURE=0.5  pfstools 1.000 OpenImageIO 0.500 OpenCV 0.500 ImageMagick 0.500 told by OpenImageIO, its EXR and ImageMagick: 0.5 - 0.5
EXPOSURE=0.5 EXPOSURE=4  pfstools 0.250 OpenImageIO 0.500 OpenCV 0.500 ImageMagick 0.500 told by OpenImageIO, its EXR and ImageMagick: 4 - 4
END
echo "as before"
