#!/usr/bin/env bash
# three.js 0.180.0 (npm): numbers turned into half floats, as its EXRExporter does unless told otherwise.
#
# Expected: the nearest half float, as IEEE 754, OpenEXR and graphics processors round. Seen: DataUtils.toHalfFloat()
# cuts the mantissa off. Of 100,000 numbers in [1, 2) half become a half float that is not the nearest one, all of them
# the one below, none above; on average a number loses 3.4e-4 of itself, and 1.9999 becomes 1.999. So a picture written
# so is darker than the one it was made from, and the mean over any number of pixels does not get nearer.
set -euo pipefail
command -v npm >/dev/null || { echo "skipped: no npm here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --silent --no-audit --no-fund three@0.180.0 >/dev/null
cat >halves.mjs <<'END'
import { DataUtils } from 'three';
const count = 100000, spacing = 2 ** -10;
let below = 0, above = 0, lost = 0;
for (let i = 0; i < count; ++i) {
  const x = 1 + i / count;
  const half = DataUtils.fromHalfFloat(DataUtils.toHalfFloat(x));
  const nearest = Math.round(x / spacing) * spacing;
  below += half < nearest;
  above += half > nearest;
  lost += (x - half) / x / count;
}
console.log(`below the nearest ${below}, above it ${above}, lost ${lost.toExponential(1)}`);
console.log(`1.9999 becomes ${DataUtils.fromHalfFloat(DataUtils.toHalfFloat(1.9999))}`);
END
node halves.mjs | tee seen
cat >expected <<'END'
below the nearest 49984, above it 0, lost 3.4e-4
1.9999 becomes 1.9990234375
END
diff expected seen
