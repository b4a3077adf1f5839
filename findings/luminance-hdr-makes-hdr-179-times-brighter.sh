#!/usr/bin/env bash
# Luminance HDR 2.6.1.1 (Debian 12: luminance-hdr 2.6.1.1+dfsg-2+b2): a picture in Radiance's format (.hdr), written as
# OpenEXR by luminance-hdr-cli.
#
# Expected: a grey of 1 stays 1, as it does from .hdr to .hdr, from EXR to EXR, and from one to the other by oiiotool.
# Seen: it becomes 179, and from EXR to .hdr it becomes 1/179, without a word. The reader of .hdr multiplies by the
# lumens that Radiance counts for a watt of white light, and the writer divides by them, while those of OpenEXR do
# neither. Pictures made from the two formats differ by seven and a half stops. (pfstools, of which Luminance's readers
# are made, did so until 1.9, and its manual tells why.)
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends luminance-hdr=2.6.1.1+dfsg-2+b2 openimageio-tools=2.4.7.1+dfsg-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export HOME=$folder QT_QPA_PLATFORM=offscreen
for from in hdr exr; do
  oiiotool --create 16x16 3 --fill:color=1,1,1 16x16 -d half -o grey.$from
  for to in hdr exr; do
    luminance-hdr-cli -l grey.$from -s written.$to >said 2>&1
    echo "$from $(oiiotool -i grey.$from --printstats | awk '/Stats Avg/ { print $3 }')" \
      "written as $to $(oiiotool -i written.$to --printstats | awk '/Stats Avg/ { printf "%.4g\n", $3 }')"
  done
done | tee seen
diff - seen <<'END'
hdr 1.000000 written as hdr 1
hdr 1.000000 written as exr 179
exr 1.000000 written as hdr 0.005585
exr 1.000000 written as exr 1
END
echo "as before"
