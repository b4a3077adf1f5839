#!/usr/bin/env bash
# OpenImageIO's idiff 2.4.7.1 (Debian 12: openimageio-tools 2.4.7.1+dfsg-2): a picture that holds NaN.
#
# Renderers' tests compare a picture with a kept one by idiff, and NaN is what goes wrong first. Expected: FAILURE and
# exit status 2, as of a pixel that is infinite or off by 0.4. Seen: PASS and exit status 0 where a pixel is NaN, and
# also where all of them are; which of the two pictures it is makes no difference. (In pictures of one channel an
# infinite pixel passes, too.)
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install python3 openimageio-tools=2.4.7.1+dfsg-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 - <<'END'
import math, struct
def write(name, grey):
    with open(f"{name}.pfm", "wb") as file:
        file.write(b"PF\n4 4\n-1.0\n" + b"".join(struct.pack("<3f", x, x, x) for x in grey))
half = [0.5] * 16
write("half", half)
for name, value in (("nan", math.nan), ("inf", math.inf), ("bright", 0.9)):
    write(f"one_{name}", half[:5] + [value] + half[6:])
write("all_nan", [math.nan] * 16)
END
for picture in one_bright one_inf one_nan all_nan; do
  for pair in "half.pfm $picture.pfm" "$picture.pfm half.pfm"; do
    status=0
    # shellcheck disable=SC2086
    idiff $pair >said || status=$?
    echo "idiff $pair: $(tail -n 1 said), exit status $status"
  done
done | tee seen
cat >expected <<'END'
idiff half.pfm one_bright.pfm: FAILURE, exit status 2
idiff one_bright.pfm half.pfm: FAILURE, exit status 2
idiff half.pfm one_inf.pfm: FAILURE, exit status 2
idiff one_inf.pfm half.pfm: FAILURE, exit status 2
idiff half.pfm one_nan.pfm: PASS, exit status 0
idiff one_nan.pfm half.pfm: PASS, exit status 0
idiff half.pfm all_nan.pfm: PASS, exit status 0
idiff all_nan.pfm half.pfm: PASS, exit status 0
END
diff expected seen
