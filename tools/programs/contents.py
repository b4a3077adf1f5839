"""Every material, light, shape, medium and transform of scenes/README.md, as cases for tools/compare_programs."""
from programs.cases import SCENES, choices

INTEGRATORS = choices(".type", "photon-map", "path")
TURNED = ("transform=[{scale=[1,0.5,-1]},{rotate={axis=[0,1,0],degrees=30}},{translate=[0,0.2,0.1]},"
          "{matrix=[1,0.1,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}]")


def materials(folder):
    tiles = f'texture="{SCENES / "tiles.png"}"'
    return ['type="lambertian",reflectance=[0.2,0.5,0.8]',
            f'type="lambertian",reflectance={{{tiles}}}',
            f'type="lambertian",reflectance={{{tiles},filter="nearest",raw=true}}',
            f'type="lambertian",reflectance={{texture="{folder / "sky.exr"}",filter="bilinear"}}',
            'type="phong",diffuse=0.4,glossy=[0.3,0.2,0.5],exponent=30',
            'type="mirror"',
            f'type="mirror",reflectance={{{tiles}}}',
            'type="conductor",eta=[0.2,0.9,1.1],k=3',
            *(f'type="conductor",metal="{metal}"' for metal in ("gold", "silver", "copper", "aluminium", "iron")),
            'type="rough-conductor",metal="copper",roughness=0.3',
            'type="rough-conductor",eta=0.3,k=3,roughness=1',
            'type="dielectric",ior=1.3',
            'type="thin-dielectric",ior=1.5',
            'type="rough-dielectric",ior=1.5,roughness=0.2']


def lights(folder):
    return ['type="point",position=[0,0.9,0.6],power=[1,2,3]',
            'type="point",position=[0,0.9,0.6],intensity=2',
            'type="spot",position=[0,1.5,0],direction=[0,-1,0.2],outer_angle=30,inner_angle=10,intensity=[1,2,3]',
            'type="spot",position=[0,1.5,0],target=[0.5,0,0],outer_angle=40,power=3',
            'type="beam",position=[0,1.8,0],direction=[0,-1,0.2],radius=0.1,power=2',
            'type="beam",position=[0,1.8,0],target=[0.5,0.3,0.3],radius=0.1,power=2',
            'type="directional",direction=[0.2,-1,-0.5],irradiance=[3,2,1]',
            'type="environment",radiance=[0.3,0.4,0.5]',
            f'type="environment",path="{folder / "sky.exr"}",scale=5']


def shapes(folder):
    square, ring = f'type="mesh",path="{folder / "square.obj"}"', f'type="mesh",path="{folder / "ring.ply"}"'
    disc = 'type="disc",center=[0,1.4,0],normal=[0,-1,0.3],radius=0.2'
    box = 'type="box",min=[-0.2,0.7,0],max=[0.2,1,0.2]'
    quad = 'type="quad",corner=[-0.2,0.7,0],edge_u=[0.4,0,0],edge_v=[0,0.4,0.1]'
    sphere = 'type="sphere",center=[0,1,0],radius=0.15'
    return [disc, f"{disc},emission=4", box, f"{box},{TURNED}", f"{box},emission=3", quad,
            f"{quad},{TURNED},emission=[1,2,3]", sphere, f"{sphere},emission=4", square, f"{square},{TURNED}",
            f"{square},emission=2", f"{ring},transform=[{{translate=[0,0.8,0]}}]"]


def fogs():
    return ['sigma_s=[1,2,3],sigma_a=0.3', 'sigma_s=0,sigma_a=1', 'measured="skimmilk",scale=0.001',
            'sigma_t=2,albedo=[0.5,0.7,0.9],phase={type="isotropic"}',
            'sigma_t=2,albedo=[0.5,0.7,0.9],phase={type="henyey-greenstein",g=-0.4}',
            'sigma_t=2,albedo=[0.5,0.7,0.9],phase={type="rayleigh"}']


def grids():
    turned = "transform=[{rotate={axis=[1,0,0],degrees=20}},{translate=[0,0.1,0]}]"
    return ["albedo=0.9", 'albedo=0.9,interpolation="nearest"', 'albedo=0.9,interpolation="trilinear"',
            'albedo=0.9,density_scale=0.3,grid="density"', f"albedo=0.9,{turned}", 'albedo=0.9,boundary="box"',
            'albedo=0.9,clamp_negative=true,phase={type="henyey-greenstein",g=-0.4}',
            'albedo=0.9,outside="thin",phase={type="rayleigh"}']


def add_contents(cases):
    """Each in a scene, by photons and by paths."""
    def add(scene, *sets):
        for integrator in INTEGRATORS:
            radius = [".surface.radius=0.2"] if integrator != ".type=path" else []
            cases.add("contents", scene, [integrator, *radius, *sets])
    for material in materials(cases.folder):
        add("cornell", f"shapes.diffuse ball.material={{{material}}}")
    for light in lights(cases.folder):
        add("cornell", f"lights.new={{{light}}}")
        add("fog_box", f"lights.new={{{light}}}")
    for shape in shapes(cases.folder):
        add("cornell", f'shapes.new={{{shape},material="white"}}')
        add("fog_box", f'shapes.new={{{shape},material="wall"}}')
    for fog in fogs():
        add("fog_ball", f'media.fog={{type="homogeneous",{fog}}}')
        add("fog_point", f'media.fog={{type="homogeneous",{fog}}}')
    thin = 'media.thin={type="homogeneous",sigma_s=0.1,sigma_a=0}'
    path = f'type="grid",path="{cases.folder / "smoke.vdb"}",sigma_t=[30,40,50]'
    for grid in grids():
        around = ['shapes.new={type="sphere",center=[0,0.5,0],radius=2,material={type="boundary"},inside="thin"}'] if "thin" in grid else []
        add("smoke", thin, *around, f"media.smoke={{{path},{grid}}}")
    ball = 'shapes.new={type="sphere",center=[0,0.5,0],radius=0.4,material={type="boundary"},inside="smoke"}'
    add("smoke", ball)
    add("smoke", ball, 'media.smoke.boundary="shapes"', 'media.smoke.interpolation="nearest"')
