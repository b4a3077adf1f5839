#!/usr/bin/env bash
# pfstools 2.2.0 (Debian 12: pfstools 2.2.0-5+b1): a picture with a pixel too bright for half floats, written as EXR.
#
# Expected: that pixel becomes infinite, or 65504, and the others keep their values. Seen: pfsoutexr scales the whole
# picture so that its brightest pixel becomes 65504, without a word: beside a pixel of 100,000 grey of 0.5 becomes
# 0.3276. The attribute whiteLuminance has the factor, and neither OpenImageIO nor pfstools' own pfsinexr applies it,
# so that a picture that went through pfstools compares as one of another exposure. With a pixel of 1000 all is kept.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install python3 openimageio-tools=2.4.7.1+dfsg-2 pfstools=2.2.0-5+b1 >/dev/null ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 - <<'END'
import struct
for name, bright in (("bright", 1000.0), ("brighter", 100000.0)):
    pixels = b"".join(struct.pack("<3f", x, x, x) for x in [0.5] * 15 + [bright])
    open(f"{name}.pfm", "wb").write(b"PF\n4 4\n-1.0\n" + pixels)
END
extrema() { oiiotool "$1" --printstats | awk '/Stats (Min|Max)/ { printf "%s %.4f ", $2, $3 }'; }
for name in bright brighter; do
  pfsin "$name.pfm" 2>/dev/null | pfsoutexr once.exr
  pfsinexr once.exr 2>/dev/null | pfsoutexr twice.exr
  echo "$name: $(extrema "$name.pfm")as EXR: $(extrema once.exr)read and written again: $(extrema twice.exr)"
done | sed "s, \$,," | tee seen
iinfo -v once.exr | grep -o 'whiteLuminance: .*' | tee -a seen
cat >expected <<'END'
bright: Min: 0.5000 Max: 1000.0000 as EXR: Min: 0.5000 Max: 1000.0000 read and written again: Min: 0.5000 Max: 1000.0000
brighter: Min: 0.5000 Max: 100000.0000 as EXR: Min: 0.3276 Max: 65504.0000 read and written again: Min: 0.3276 Max: 65504.0000
whiteLuminance: 1.52662
END
diff expected seen
