#!/usr/bin/env bash
# Open3D 0.16.1 with Assimp 5.2.5 (Debian 12: python3-open3d 0.16.1+ds-2+b4, libassimp5 5.2.5~ds0-1+b1): Wavefront OBJ
# with faces of four corners, as most modelling programs write them.
#
# Expected: read_triangle_mesh() cuts a quad into two triangles, as it does for the same quad in a PLY file, or else
# warns. Seen: the quad of the OBJ file is gone, and so are its vertices; one quad among triangles takes all of these
# with it. With enable_post_processing=True, which asks Assimp for triangles, the mesh is empty as well: Assimp 5.2 marks
# meshes that had quads by another bit beside that of triangles (20 in the place of 4), and Open3D compares with that of
# triangles alone. read_triangle_mesh() succeeds; the one sign is a line of the level INFO.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-open3d=0.16.1+ds-2+b4 libassimp5=5.2.5~ds0-1+b1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >read.py <<'END'
import open3d

PLACES = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0)]
QUAD, TRIANGLE = (0, 1, 2, 3), (1, 4, 2)


def write(faces):
    with open("mesh.obj", "w") as obj:
        obj.writelines(f"v {x} {y} {z}\n" for x, y, z in PLACES)
        obj.writelines("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces)
    with open("mesh.ply", "w") as ply:
        ply.write(f"ply\nformat ascii 1.0\nelement vertex {len(PLACES)}\nproperty float x\nproperty float y\n"
                  f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        ply.writelines(f"{x} {y} {z}\n" for x, y, z in PLACES)
        ply.writelines(f"{len(face)} " + " ".join(map(str, face)) + "\n" for face in faces)


def count(file, post):
    return len(open3d.io.read_triangle_mesh(file, post).triangles)


for name, faces in (("a quad", [QUAD]), ("a triangle and a quad", [TRIANGLE, QUAD])):
    write(faces)
    print(f"{name}: {count('mesh.obj', False)} triangles of OBJ, {count('mesh.obj', True)} with post-processing, "
          f"{count('mesh.ply', False)} of PLY")
END
/usr/bin/python3 read.py 2>/dev/null | grep triangles | grep -v INFO | tee seen
diff - seen <<'END'
a quad: 0 triangles of OBJ, 0 with post-processing, 2 of PLY
a triangle and a quad: 0 triangles of OBJ, 0 with post-processing, 3 of PLY
END
echo "as before"
