#!/usr/bin/env bash
# ImageMagick (Debian 12: 8:6.9.11.60+dfsg-1.6+deb12u15), Radiance pictures: one whose header says that its primaries are
# those of Rec. 2020 is read and written again, and so is one without a word of primaries.
#
# Expected: the header says the same primaries, or those of sRGB where the colours were converted, or nothing, as the
# pixels are what they were. Seen: in both, PRIMARIES=0 0 0 0 0 0 0 0, eight zeros. They are no primaries at all: red,
# green, blue and white are one point of no luminance. A reader that goes by the header divides by zero, and one that
# takes zeros for "not known" shows colours of Rec. 2020 as those of sRGB: what the first picture said is lost.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends imagemagick=8:6.9.11.60+dfsg-1.6+deb12u15 >/dev/null ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 - <<'END'
pixels = bytes([128, 64, 32, 129]) * 128
for name, line in (("rec2020", b"PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n"), ("plain", b"")):
    with open(name + ".hdr", "wb") as file:
        file.write(b"#?RADIANCE\n" + line + b"FORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n" + pixels)
END
for name in rec2020 plain; do
  convert-im6.q16 "$name.hdr" "again_$name.hdr"
  echo "$name: $(grep -a PRIMARIES "$name.hdr" || echo 'no word of primaries'), then $(grep -a PRIMARIES "again_$name.hdr")"
done | tee seen
diff - seen <<'END'
rec2020: PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290, then PRIMARIES=0 0 0 0 0 0 0 0
plain: no word of primaries, then PRIMARIES=0 0 0 0 0 0 0 0
END
echo "as before"
