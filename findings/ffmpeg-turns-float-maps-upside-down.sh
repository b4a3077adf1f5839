#!/usr/bin/env bash
# FFmpeg 5.1.9 (Debian 12: ffmpeg 7:5.1.9-0+deb12u1): a portable float map (PFM), whose rows are stored from the bottom
# to the top.
#
# Expected: a picture that is made of it has the same row on top as with other readers, here oiiotool, pfstools and
# ImageMagick. Seen: it is upside down, whatever it is written as, and a PFM that FFmpeg writes from an upright EXR is
# upside down to all the others. Two wrongs make a right from PFM to PFM, which is why a test of it alone passes.
# OpenEXR to OpenEXR stays upright, too.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends ffmpeg=7:5.1.9-0+deb12u1 openimageio-tools=2.4.7.1+dfsg-2 pfstools=2.2.0-5+b1 \
  imagemagick=8:6.9.11.60+dfsg-1.6+deb12u15 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
/usr/bin/python3 - <<'END'
import struct
rows = [[0.125 + row / 64 + column / 1024 for column in range(16) for channel in range(3)] for row in range(16)]
with open("dark_below.pfm", "wb") as file:
    file.write(b"PF\n16 16\n-1.0\n" + b"".join(struct.pack("<48f", *row) for row in rows))
END
top() { # of a picture that oiiotool reads
  oiiotool "$1" --cut 16x1+0+0 --printstats | awk '/Stats Avg/ { top = $3 } END { print (top > 0.25 ? "bright" : "dark") }'
}
by_ffmpeg() { ffmpeg -nostdin -v error -y -f image2 -i "$1" "$2"; }
{
  oiiotool dark_below.pfm -d float -o by_oiiotool.exr
  pfsin dark_below.pfm | pfsoutexr by_pfstools.exr
  convert-im6.q16 dark_below.pfm -depth 16 by_imagemagick.tif
  for name in by_oiiotool.exr by_pfstools.exr by_imagemagick.tif; do echo "$name, from PFM: $(top $name) on top"; done
  by_ffmpeg dark_below.pfm from_pfm.exr
  by_ffmpeg by_oiiotool.exr from_exr.exr
  by_ffmpeg by_oiiotool.exr from_exr.pfm
  by_ffmpeg dark_below.pfm from_pfm.pfm
  for name in from_pfm.exr from_exr.exr from_exr.pfm from_pfm.pfm; do echo "ffmpeg, $name: $(top $name) on top"; done
} | tee seen
diff - seen <<'END'
by_oiiotool.exr, from PFM: bright on top
by_pfstools.exr, from PFM: bright on top
by_imagemagick.tif, from PFM: bright on top
ffmpeg, from_pfm.exr: dark on top
ffmpeg, from_exr.exr: bright on top
ffmpeg, from_exr.pfm: dark on top
ffmpeg, from_pfm.pfm: bright on top
END
echo "as before"
