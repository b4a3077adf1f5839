#!/usr/bin/env bash
# OpenEXR 3.1.5 (Debian 12: openexr 3.1.5-5): the levels of a texture that exrmaketiled -m makes.
#
# Expected: the last level, of one pixel, is the mean of the picture, at least where the picture and its mirror image
# would have the same. Seen: where the level before it is 3 wide, its first pixel counts for a half and its last for an
# eighth. A picture whose left half is white ends as 0.68, and its mirror image as 0.32. Levels of 3 come before the
# last for pictures of 48, 768 or 1920 pixels; with 64 both end as 0.5. It is so in height, too, and whoever takes the
# last level for the mean of a light or of an exposure is off by a third.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends openexr=3.1.5-5 openimageio-tools=2.4.7.1+dfsg-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for size in 48 64; do
  for first in 0 $((size / 2)); do
    oiiotool --create ${size}x$size 1 --fill:color=1 $((size / 2))x$size+$first+0 -d half -o half.exr
    exrmaketiled -m half.exr levels.exr
    line="$size pixels, white from $first on:"
    for level in 0 1 2 3 4 5 6; do
      stats=$(oiiotool -i levels.exr --selectmip $level --printstats 2>/dev/null) || break
      line+=" $(awk '/Stats Avg/ { printf "%.2f", $3 }' <<<"$stats")"
    done
    echo "$line"
  done
done | tee seen
diff - seen <<'END'
48 pixels, white from 0 on: 0.50 0.50 0.50 0.50 0.50 0.68
48 pixels, white from 24 on: 0.50 0.50 0.50 0.50 0.50 0.32
64 pixels, white from 0 on: 0.50 0.50 0.50 0.50 0.50 0.50 0.50
64 pixels, white from 32 on: 0.50 0.50 0.50 0.50 0.50 0.50 0.50
END
echo "as before"
