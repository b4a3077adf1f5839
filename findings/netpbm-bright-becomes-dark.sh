#!/usr/bin/env bash
# Netpbm 11.01.00 (Debian 12: netpbm 2:11.01.00-2): pfmtopam, which makes an ordinary picture of one of floats (PFM).
#
# Expected: what is brighter than 1 becomes white, as 1 does, and what is below 0 black; or it is refused. Seen: the
# numbers go around, in 8 and in 16 bits, without a word. A grey of 1.5 becomes 127, darker than one of 0.6, 2 becomes
# 254, 2.01 is 1, nearly black, and a lamp of 1000 is 24; -0.01 becomes nearly white. A rendering with a highlight has
# dark rings in it, and only a picture within 0 to 1 comes out as it is meant.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends netpbm=2:11.01.00-2 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
greys="0.25 0.6 1 1.5 2 2.01 3 1000 -0.01"
# shellcheck disable=SC2086
/usr/bin/python3 -c '
import struct, sys
greys = list(map(float, sys.argv[1:]))
open("lights.pfm", "wb").write(b"Pf\n%d 1\n-1.0\n" % len(greys) + struct.pack("<%df" % len(greys), *greys))
' $greys
{
  echo "grey $greys"
  for highest in 255 65535; do
    echo "$highest $(pfmtopam -maxval $highest lights.pfm | pamtopnm -plain | tail -n +4 | xargs)"
  done
} | tee seen
diff - seen <<'END'
grey 0.25 0.6 1 1.5 2 2.01 3 1000 -0.01
255 64 153 255 127 254 1 253 24 254
65535 16384 39321 65535 32767 65534 653 65533 64536 64882
END
echo "as before"
