#!/usr/bin/env bash
# Six readers of portable float maps (Debian 12: openimageio-tools 2.4.7.1+dfsg-2, pfstools 2.2.0-5+b1, imagemagick
# 8:6.9.11.60+dfsg-1.6+deb12u15, netpbm 2:11.01.00-2, python3-opencv 4.6.0+dfsg-12, ffmpeg 7:5.1.9-0+deb12u1): a picture
# whose third line is not 1 or -1.
#
# The line's sign tells the order of the bytes, and its size is a scale. Expected: all readers give the stored numbers,
# as most writers only ever write 1, or all scale them alike. Seen: three multiply and three divide by it. A grey stored
# as 0.125 under a scale of 2 is 0.25 to OpenImageIO, pfstools and ImageMagick, and 0.0625 to OpenCV, ffmpeg and Netpbm;
# so a picture in known units comes out off by the square of its scale where it goes from one to the other. Netpbm's
# pamtopfm -scale writes such files.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends openimageio-tools=2.4.7.1+dfsg-2 pfstools=2.2.0-5+b1 netpbm=2:11.01.00-2 \
  imagemagick=8:6.9.11.60+dfsg-1.6+deb12u15 python3-opencv=4.6.0+dfsg-12 ffmpeg=7:5.1.9-0+deb12u1 >/dev/null ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >read.py <<'END'
import struct
import subprocess

import cv2


def said(command):
    return subprocess.run(command, shell=True, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout


for scale in (1, 2):
    with open("grey.pfm", "wb") as file:
        file.write(b"PF\n16 16\n-%d.0\n" % scale + struct.pack("<f", 0.125) * 3 * 256)
    greys = {
        "OpenImageIO": [line.split()[2] for line in said("oiiotool grey.pfm --printstats").decode().splitlines()
                        if "Stats Avg" in line][0],
        "pfstools": struct.unpack("<f", said("pfsin grey.pfm | pfsoutpfm -")[-4:])[0],
        "ImageMagick": said("convert-im6.q16 grey.pfm -format '%[fx:mean]' info:").decode(),
        "OpenCV": cv2.imread("grey.pfm", cv2.IMREAD_UNCHANGED)[8, 8, 0],
        "ffmpeg": struct.unpack("<f", said("ffmpeg -nostdin -f image2 -i grey.pfm -f rawvideo -pix_fmt gbrpf32le -")[:4])[0],
        "Netpbm": said("pfmtopam -maxval 65535 grey.pfm | pamtopnm -plain").split()[4].decode(),
    }
    greys["Netpbm"] = float(greys["Netpbm"]) / 65535
    print(f"scale {scale}:", ", ".join(f"{name} {float(grey):.4f}" for name, grey in greys.items()))
END
/usr/bin/python3 read.py | tee seen
diff - seen <<'END'
scale 1: OpenImageIO 0.1250, pfstools 0.1250, ImageMagick 0.1250, OpenCV 0.1250, ffmpeg 0.1250, Netpbm 0.1250
scale 2: OpenImageIO 0.2500, pfstools 0.2500, ImageMagick 0.2500, OpenCV 0.0625, ffmpeg 0.0625, Netpbm 0.0625
END
echo "as before"
