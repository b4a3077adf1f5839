"""A scene that several files of tests render: a ball of fog over a floor."""

BALL = {
    "camera": {"position": [0, 0, 3], "target": [0, 0, 0]},
    "film": {"width": 24, "height": 16},
    "media": {"fog": {"type": "homogeneous", "sigma_s": [0.5, 0.6, 0.7], "sigma_a": 0.1,
                      "phase": {"type": "henyey-greenstein", "g": 0.3}}},
    "materials": {"white": {"type": "lambertian", "reflectance": 0.5}},
    "shapes": [
        {"name": "ball", "type": "sphere", "material": {"type": "boundary"}, "center": [0, 0, 0], "radius": 1,
         "inside": "fog"},
        {"name": "floor", "type": "quad", "material": "white", "corner": [-2, -1.2, 2], "edge_u": [4, 0, 0],
         "edge_v": [0, 0, -4]},
    ],
    "lights": [{"type": "directional", "direction": [0, -1, 0.2], "irradiance": 3}],
    "integrator": {"photons": {"emitted": 2000}},
}

# The same, as somebody would write it.
BALL_FILE = """
lights = [{ type = "directional", direction = [0, -1, 0.2], irradiance = 3 }]
[camera]
position = [0, 0, 3]
target = [0, 0, 0]
[film]
width = 24
height = 16
[media.fog]
type = "homogeneous"
sigma_s = [0.5, 0.6, 0.7]
sigma_a = 0.1
phase = { type = "henyey-greenstein", g = 0.3 }
[materials.white]
type = "lambertian"
reflectance = 0.5
[[shapes]]
name = "ball"
type = "sphere"
material = { type = "boundary" }
center = [0, 0, 0]
radius = 1
inside = "fog"
[[shapes]]
name = "floor"
type = "quad"
material = "white"
corner = [-2, -1.2, 2]
edge_u = [4, 0, 0]
edge_v = [0, 0, -4]
[integrator.photons]
emitted = 2000
"""
