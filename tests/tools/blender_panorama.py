"""Run by Blender: what its Cycles sees of a panorama.

blender -b --python blender_panorama.py -- PANORAMA.exr OUTPUT.exr PIXELS FOV X Y Z

The camera looks along (X, Y, Z) in Blender's axes, whose z is up, with square films of FOV degrees.
"""

import math
import sys

import bpy
from mathutils import Vector

panorama, output, pixels, fov, *direction = sys.argv[sys.argv.index("--") + 1:]

for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
scene = bpy.context.scene
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.angle = math.radians(float(fov))
camera.rotation_euler = Vector([float(x) for x in direction]).to_track_quat("-Z", "Y").to_euler()
scene.collection.objects.link(camera)
scene.camera = camera

scene.world.use_nodes = True
nodes = scene.world.node_tree.nodes
picture = nodes.new("ShaderNodeTexEnvironment")
picture.image = bpy.data.images.load(panorama)
picture.interpolation = "Closest"
scene.world.node_tree.links.new(picture.outputs["Color"], nodes["Background"].inputs["Color"])

scene.render.engine = "CYCLES"
scene.cycles.samples = 64
scene.cycles.use_denoising = False
scene.cycles.use_adaptive_sampling = False
scene.cycles.pixel_filter_type = "BOX"
scene.render.resolution_x = scene.render.resolution_y = int(pixels)
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = output
bpy.ops.render.render(write_still=True)
