"""For Blender: prints the layers and passes that the compositor's image node shows of an EXR file, and the values of
one pixel, as the compositor computes with them.

blender -b --factory-startup --python-exit-code 1 --python blender_layers.py -- FILE.exr WIDTH HEIGHT X Y FOLDER

X and Y count from the upper left corner; FOLDER is for files of its own."""
import re
import sys

import bpy

picture, width, height, x, y, folder = sys.argv[sys.argv.index("--") + 1:]
width, height, x, y = int(width), int(height), int(x), int(y)


def other_layers(node):
    """The names of layers besides the one without a name, which Blender tells only who asks for one that is missing."""
    try:
        node.layer = "none of them"
    except TypeError as error:
        return re.findall(r"'([^']*)'", str(error).split("not found in", 1)[1])
    raise RuntimeError("Blender takes any layer")


def pixel_of(scene, composite, socket):
    """What the compositor writes for one pixel of a socket."""
    scene.node_tree.links.new(socket, composite.inputs["Image"])
    scene.render.filepath = folder + "/pixel.exr"
    bpy.ops.render.render(write_still=True)
    written = bpy.data.images.load(scene.render.filepath)
    at = 4 * ((height - 1 - y) * width + x)
    values = list(written.pixels[at:at + 3])
    bpy.data.images.remove(written)
    return values


scene = bpy.context.scene
scene.use_nodes = True
scene.node_tree.nodes.clear()
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
node = scene.node_tree.nodes.new("CompositorNodeImage")
node.image = bpy.data.images.load(picture)
composite = scene.node_tree.nodes.new("CompositorNodeComposite")
for layer in [node.layer, *other_layers(node)]:
    if layer != node.layer:
        node.layer = layer
    for socket in node.outputs:
        if socket.enabled:
            print("pass", repr(layer), repr(socket.name), *pixel_of(scene, composite, socket))
