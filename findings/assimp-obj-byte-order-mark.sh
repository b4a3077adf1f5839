#!/usr/bin/env bash
# Assimp 5.2.5 (Debian 12: assimp-utils 5.2.5~ds0-1+b1): a Wavefront OBJ file that begins with the byte order mark of
# UTF-8, as editors and exporters of Windows write it.
#
# Expected: the mark is skipped, or the file is refused. Seen: the mark and the word after it are taken for an unknown
# keyword, so that the first vertex is missing and every face takes the vertices after those that it names: a triangle
# at the origin comes out 10 m away. The file is refused only where an index then has no vertex at all. A first line
# with a comment takes the harm, which is why most such files are read as they are meant.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends assimp-utils=5.2.5~ds0-1+b1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
vertices='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 10 0 0\n'
printf "${vertices}f 1 2 3\n" >plain.obj
printf "\xef\xbb\xbf${vertices}f 1 2 3\n" >mark.obj
printf "\xef\xbb\xbf# a comment\n${vertices}f 1 2 3\n" >comment.obj
for name in plain mark comment; do
  assimp export $name.obj out.obj >/dev/null
  echo "$name: $(grep '^v ' out.obj | tr -s ' ' | tr -d '\r' | paste -sd, -)"
done | tee seen
diff - seen <<'END'
plain: v 0 0 0,v 1 0 0,v 0 1 0
mark: v 1 0 0,v 0 1 0,v 10 0 0
comment: v 0 0 0,v 1 0 0,v 0 1 0
END
echo "as before"
