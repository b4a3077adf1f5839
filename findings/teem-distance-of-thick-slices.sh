#!/usr/bin/env bash
# Teem 1.12.0 (Debian 12: teem-apps 1.12.0~20160122-5): unu dist, the distance of every voxel from an object, in a
# volume whose slices lie farther apart than its pixels, as those of a scanner do.
#
# The voxel in a corner is the object. Expected: the distances from its centre, or from its faces, which lie half a
# spacing away along each axis; and 0 nowhere else. Seen: half of the MEAN spacing of the axes is taken from every
# distance, and what would be below 0 becomes 0. With spacings of 1, 1 and 4 that is 1: the neighbours in the slice, 1
# away, are at 0 like the object itself, the next at 1 in the place of 1.5, and the neighbour in the next slice at 3 in
# the place of 2. With 1, 1 and 7 the diagonal neighbours are at 0, too. With even spacings it is as expected along the
# axes. The program's help says that distances between non-isotropic samples are handled correctly.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends teem-apps=1.12.0~20160122-5 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
for thickness in 1 4 7; do
  printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nspacings: 1 1 %s\nencoding: ascii\n\n' "$thickness" >object.nrrd
  echo "1 $(seq -s' ' 63 | sed 's/[0-9]*/0/g')" >>object.nrrd
  teem-unu dist -th 0.5 -i object.nrrd -o distance.nrrd
  # Along a row of the slice, and from slice to slice.
  row=$(teem-unu slice -a 2 1 -p 0 0 -i distance.nrrd | teem-unu axinsert -a 0 | teem-unu save -f text | paste -sd' ')
  slices=$(teem-unu slice -a 1 0 -p 0 0 -i distance.nrrd | teem-unu axinsert -a 0 | teem-unu save -f text | paste -sd' ')
  zeros=$(teem-unu save -f nrrd -e ascii -i distance.nrrd | sed '1,/^$/d' | tr ' ' '\n' | grep -cx 0)
  echo "slices $thickness apart: in the slice $row, through the slices $slices, zeros $zeros"
done | tee seen
diff - seen <<'END'
slices 1 apart: in the slice 0 0.5 1.5 2.5, through the slices 0 0.5 1.5 2.5, zeros 1
slices 4 apart: in the slice 0 0 1 2, through the slices 0 3 7 11, zeros 3
slices 7 apart: in the slice 0 0 0.5 1.5, through the slices 0 5.5 12.5 19.5, zeros 4
END
echo "as before"
