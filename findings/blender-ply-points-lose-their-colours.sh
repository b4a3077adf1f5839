#!/usr/bin/env bash
# Blender 3.4.1 (Debian 12: blender 3.4.1+dfsg-2+b1): import of Stanford PLY, of points alone.
#
# A file of four points has a colour for each (uchar red, green, blue), and the same file with one face has them, too.
# Expected: both meshes have a colour attribute, as the importer reads colours of vertices. Seen: only that with the
# face. Colours are put on the corners of faces, and points without faces have none: a cloud of photons or of a scan is
# imported grey, without a word.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends blender=3.4.1+dfsg-2+b1 >/dev/null 2>&1 ||
  { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >points.ply <<'END'
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face FACES
property list uchar uint vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 0
1 1 0 0 0 255
0 1 0 255 255 0
END
sed 's/FACES/1/' points.ply >face.ply
echo "4 0 1 2 3" >>face.ply
sed -i 's/FACES/0/' points.ply
cat >read.py <<'END'
import addon_utils
import bpy

addon_utils.enable("io_mesh_ply")
for name in ("face", "points"):
    bpy.ops.import_mesh.ply(filepath=name + ".ply")
    mesh = bpy.context.view_layer.objects.active.data
    print("SEEN", name, len(mesh.vertices), "vertices,", len(mesh.color_attributes), "colour attributes on",
          [attribute.domain for attribute in mesh.color_attributes])
END
blender --background --factory-startup --python read.py 2>/dev/null | sed -n 's/^SEEN //p' | tee seen
diff - seen <<'END'
face 4 vertices, 1 colour attributes on ['CORNER']
points 4 vertices, 0 colour attributes on []
END
echo "as before"
