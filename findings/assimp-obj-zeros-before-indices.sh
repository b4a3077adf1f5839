#!/usr/bin/env bash
# Assimp 5.2.5 (Debian 12: assimp-utils 5.2.5~ds0-1+b1): faces of a Wavefront OBJ file whose indices are padded by zeros.
#
# Expected: "f 01 02 03" is the face "f 1 2 3", or it is refused. Seen: it is a face of six corners, 1 1 2 2 3 3, as the
# reader goes on behind as many digits as the number has, which is one, and reads the rest of its text as a further index.
# "f 08 09 10" becomes 8 8 9 9 10. Nothing is said; cut into triangles the face becomes several, of which some have no
# area.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends assimp-utils=5.2.5~ds0-1+b1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for face in "1 2 3" "01 02 03" "08 09 10"; do
  { for i in $(seq 10); do echo "v $i $((i * i)) 0"; done; echo "f $face"; } >face.obj
  assimp export face.obj out.obj >/dev/null
  corners=$(grep '^f ' out.obj | tr -d '\r' | tr ' ' '\n' | grep -c /)
  echo "f $face: $corners corners"
done | tee seen
diff - seen <<'END'
f 1 2 3: 3 corners
f 01 02 03: 6 corners
f 08 09 10: 5 corners
END
echo "as before"
