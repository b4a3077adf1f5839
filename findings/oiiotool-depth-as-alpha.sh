#!/usr/bin/env bash
# OpenImageIO 2.4.7 (Debian 12: openimageio-tools 2.4.7.1+dfsg-2): an EXR with channels R, G, B, Z turned into a PNG.
#
# Z is OpenEXR's reserved name for depth, and A that for alpha; `oiiotool --info -v` names no alpha channel. Expected: a
# PNG of R, G and B, or a refusal, as PNG cannot hold depth. Seen: a PNG with R, G, B, A, whose alpha is the depth. What
# is nearer than 1 m becomes translucent, and a fourth channel with any other name (variance.R) does the same. Colours
# are divided by it, too, since OpenImageIO takes them for premultiplied: 0.25 becomes white.
#
# So pictures with layers are turned into PNGs by `oiiotool in.exr --ch R,G,B -o out.png`.
set -euo pipefail
apt-get -q -y --no-install-recommends install openimageio-tools=2.4.7.1+dfsg-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for fourth in Z variance.R; do
  oiiotool --create 1x1 4 --fill:color=0.25,0.25,0.25,0.25 1x1 --chnames "R,G,B,$fourth" -d float -o picture.exr
  oiiotool picture.exr -o picture.png
  echo "$fourth: $(oiiotool --info -v picture.png | grep 'channel list')"
  python3 - <<'END'
import struct, zlib
data, at, pixels = open("picture.png", "rb").read(), 8, b""
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at : at + 8])
    pixels += data[at + 8 : at + 8 + size] if kind == b"IDAT" else b""
    at += size + 12
print("  bytes of the pixel:", *zlib.decompress(pixels)[1:])
END
done | tee seen
cat >expected <<'END'
Z:     channel list: R, G, B, A
  bytes of the pixel: 255 255 255 64
variance.R:     channel list: R, G, B, A
  bytes of the pixel: 255 255 255 64
END
diff expected seen
