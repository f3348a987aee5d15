"""Renders a scene of path_peers.py with Cycles: blender -b -P path_peers_cycles.py -- SCENE.json SAMPLES SEED OUT.exr

SCENE.json has "spheres": "points" or "meshes".
"""
import json
import math
import sys

import bpy
from mathutils import Vector

TRIANGLES = 5  # subdivisions of an icosahedron: 5120 triangles a sphere


def matte(name, albedo):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (albedo, albedo, albedo, 1)
    material.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    return material


def glowing(radiance):
    material = bpy.data.materials.new("lamp")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    emission, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    emission.inputs["Strength"].default_value = radiance
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def ball_mesh(material):
    """A sphere of radius 1; its material is the object's, so that all balls share the mesh."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=TRIANGLES, radius=1)
    ball = bpy.context.object
    mesh = ball.data
    bpy.data.objects.remove(ball)
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(material)
    return mesh


def add_meshes(spheres, material):
    mesh = ball_mesh(material)
    for x, y, z, radius in spheres:
        ball = add("ball", mesh)
        ball.location, ball.scale = (x, y, z), (radius, radius, radius)


def points_of_vertices(material):
    """Geometry nodes: each vertex becomes a point with the radius of its attribute."""
    tree = bpy.data.node_groups.new("points", "GeometryNodeTree")
    tree.inputs.new("NodeSocketGeometry", "Geometry")
    tree.outputs.new("NodeSocketGeometry", "Geometry")
    begin, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    radius, points = tree.nodes.new("GeometryNodeInputNamedAttribute"), tree.nodes.new("GeometryNodeMeshToPoints")
    paint = tree.nodes.new("GeometryNodeSetMaterial")
    radius.data_type = "FLOAT"
    radius.inputs["Name"].default_value = "size"
    paint.inputs["Material"].default_value = material
    link = tree.links.new
    link(begin.outputs[0], points.inputs["Mesh"])
    link(next(s for s in radius.outputs if s.enabled and s.name == "Attribute"), points.inputs["Radius"])
    link(points.outputs[0], paint.inputs["Geometry"])
    link(paint.outputs[0], end.inputs[0])
    return tree


def add_points(spheres, material):
    mesh = bpy.data.meshes.new("points")
    mesh.from_pydata([sphere[:3] for sphere in spheres], [], [])
    size = mesh.attributes.new("size", "FLOAT", "POINT")
    size.data.foreach_set("value", [sphere[3] for sphere in spheres])
    cloud = add("points", mesh)
    cloud.modifiers.new("points", "NODES").node_group = points_of_vertices(material)


def add_ground(scene):
    half = scene["ground_half"]
    mesh = bpy.data.meshes.new("ground")
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(matte("ground", scene["ground"]))
    add("ground", mesh)


def add_camera(scene):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.sensor_height = 24
    data.lens = 12 / math.tan(math.radians(scene["fov"]) / 2)
    data.clip_end = 10000
    camera = add("camera", data)
    eye, aim = Vector(scene["eye"]), Vector(scene["look_at"])
    camera.location = eye
    camera.rotation_euler = (aim - eye).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = camera


def add_light(scene):
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = scene["background"]
    if "emitter" in scene:
        add_meshes([scene["emitter"][:4]], glowing(scene["emitter"][4]))
    if "lamp" in scene:
        x, y, z, radius, radiant_intensity = scene["lamp"]
        data = bpy.data.lights.new("lamp", "POINT")
        data.shadow_soft_size = radius
        data.energy = 4 * math.pi * radiant_intensity
        lamp = add("lamp", data)
        lamp.location = (x, y, z)
        lamp.visible_camera = False


def set_render(scene, samples, seed, out):
    settings = bpy.context.scene
    render, cycles = settings.render, settings.cycles
    render.engine = "CYCLES"
    cycles.device, cycles.samples, cycles.seed = "CPU", samples, seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    # Cycles sends shadow rays to the sky at the last hit too, and Boule none: so it has one bounce less there.
    cycles.max_bounces = cycles.diffuse_bounces = scene["depth"] - (scene["background"] > 0)
    cycles.min_light_bounces = 3  # Russian roulette after three bounces, as Boule
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    cycles.light_sampling_threshold = 0
    render.threads_mode, render.threads = "FIXED", 1
    render.resolution_x, render.resolution_y = scene["size"]
    render.resolution_percentage = 100
    render.use_compositing = render.use_sequencer = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth, render.image_settings.exr_codec = "32", "NONE"
    render.image_settings.color_mode = "RGB"
    render.filepath = out
    settings.view_settings.view_transform = "Raw"


def main():
    path, samples, seed, out = sys.argv[sys.argv.index("--") + 1:]
    with open(path) as file:
        scene = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    put = add_points if scene["spheres"] == "points" else add_meshes
    for albedo, spheres in scene["groups"]:
        put(spheres, matte("matte", albedo))
    add_ground(scene)
    add_camera(scene)
    add_light(scene)
    set_render(scene, int(samples), int(seed), out)
    bpy.ops.render.render(write_still=True)


main()
