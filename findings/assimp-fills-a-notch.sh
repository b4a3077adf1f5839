#!/usr/bin/env bash
# Assimp 5.2.5 (Debian 12: assimp-utils 5.2.5~ds0-1+b1): one concave face of a mesh, cut into triangles.
#
# Assimp cuts faces of many corners by clipping ears. Expected: the triangles cover the face, whichever of its corners
# the file begins with, as for an L of 3 x 2 m, whose six beginnings all give 4 m^2. Seen: where the corner of the notch
# lies on the line between the two ends of the arms, as in an L of 2 x 2 m with arms 1 m wide, the file that begins with
# the outer corner gives triangles that overlap and fill the notch, 4 m^2 in the place of 3. The other five give 3. The
# ear that is clipped has the notch's corner on its edge, and counts as empty. A room of 4 x 3 m: 12 m^2 in the place of
# 9. Nothing is said.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends assimp-utils=5.2.5~ds0-1+b1 python3-minimal >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >areas.py <<'END'
import math
import subprocess


def area_of(corners):
    """Of the triangles that Assimp makes of one face."""
    with open("face.obj", "w") as file:
        file.writelines(f"v {x} {y} 0\n" for x, y in corners)
        file.write("f " + " ".join(str(i + 1) for i in range(len(corners))) + "\n")
    subprocess.run(["assimp", "export", "face.obj", "cut.obj", "-tri"], check=True, stdout=subprocess.DEVNULL)
    lines = [line.split() for line in open("cut.obj")]
    places = [list(map(float, words[1:3])) for words in lines if words[:1] == ["v"]]
    total = 0.0
    for words in lines:
        if words[:1] != ["f"]:
            continue
        (ax, ay), (bx, by), (cx, cy) = [places[int(word.split("/")[0]) - 1] for word in words[1:]]
        total += abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
    return total


for name, width, depth in (("3 x 2", 3, 2), ("2 x 2", 2, 2), ("4 x 3", 4, 3)):
    arm_x, arm_y = (1, 1) if width == 3 else (width / 2, depth / 2)
    face = [(0, 0), (width, 0), (width, arm_y), (arm_x, arm_y), (arm_x, depth), (0, depth)]
    print(name, *(f"{area_of(face[first:] + face[:first]):g}" for first in range(6)))
END
/usr/bin/python3 areas.py | tee seen
diff - seen <<'END'
3 x 2 4 4 4 4 4 4
2 x 2 4 3 3 3 3 3
4 x 3 12 9 9 9 9 9
END
echo "as before"
