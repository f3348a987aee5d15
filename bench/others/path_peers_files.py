"""The files of path_peers.py: scenes for Boule and for Embree's tutorial, and pictures as arrays."""
import math
import struct

import numpy as np


def toml_matte(name, albedo):
    """A material: the colour of an object alone is kept in 8 bits only."""
    return f"[material.{name}]\ncolor = {[albedo] * 3}\n"


def write_toml(scene, path):
    width, height = scene["size"]
    text = f"""schema = 1
[image]
size = [{width}, {height}]
[camera]
eye = {scene["eye"]}
look_at = {scene["look_at"]}
up = [0, 0, 1]
fov = {scene["fov"]}
fov_axis = "y"
[background]
color = {[scene["background"]] * 3}
[render]
method = "path"
max_depth = {scene["depth"]}
{toml_matte("ground", scene["ground"])}
[[plane]]
normal = [0, 0, 1]
material = "ground"
"""
    for k, (albedo, spheres) in enumerate(scene["groups"]):
        text += toml_matte(f"matte{k}", albedo)
        for x, y, z, radius in spheres:
            text += f"[[sphere]]\ncenter = [{x}, {y}, {z}]\nradius = {radius}\nmaterial = \"matte{k}\"\n"
    path.write_text(text + toml_light(scene))


def toml_light(scene):
    if "emitter" in scene:
        x, y, z, radius, radiance = scene["emitter"]
        return (f"[material.lamp]\ntype = \"emissive\"\nradiance = {[float(radiance)] * 3}\n"
                f"[[sphere]]\ncenter = [{x}, {y}, {z}]\nradius = {radius}\nmaterial = \"lamp\"\n")
    if "lamp" not in scene:
        return ""
    x, y, z, radius, intensity = scene["lamp"]
    if radius == 0:
        return (f"[[light]]\nposition = [{x}, {y}, {z}]\nfalloff = \"inverse_square\"\n"
                f"intensity = {[intensity / math.pi] * 3}\n")
    return (f"[[light]]\ntype = \"sphere\"\ncenter = [{x}, {y}, {z}]\nradius = {radius}\n"
            f"radiance = {[intensity / (math.pi * radius**2)] * 3}\n")


def embree_matte(albedo):
    return ('<material><code>"Matte"</code><parameters><float3 name="reflectance">'
            f"{albedo} {albedo} {albedo}</float3></parameters></material>")


def write_embree(scene, path):
    """Writes the scene; gives the options that tell camera, light and depth.

    Points throw no shadows: the tutorial's shadow rays rely on a filter that points do not get. So each sphere is a
    round curve whose length is a hundred thousandth of its radius.

    The tutorial adds a light from everywhere twice: by a shadow ray at every hit, and where a path meets nothing.
    So it gets half of it.
    """
    half = scene["ground_half"]
    corners = f"{-half} {-half} 0 {half} {-half} 0 {half} {half} 0 {-half} {half} 0"
    text = ('<?xml version="1.0"?>\n<scene><Group>\n'
            f"<QuadMesh><positions>{corners}</positions><indices>0 1 2 3</indices>"
            f"{embree_matte(scene['ground'])}</QuadMesh>\n")
    for albedo, spheres in scene["groups"]:
        ends = [(x + side * 1e-5 * r, y, z, r) for x, y, z, r in spheres for side in (0, 1)]
        rows = "\n".join(" ".join(map(str, end)) for end in ends)
        text += (f'<Curves type="round" basis="linear"><positions>\n{rows}\n</positions>'
                 f"<indices>{' '.join(str(2 * k) for k in range(len(spheres)))}</indices>{embree_matte(albedo)}"
                 "</Curves>\n")
    path.write_text(text + "</Group></scene>\n")
    options = ["-i", path, "--size", *scene["size"], "--vp", *scene["eye"], "--vi", *scene["look_at"],
               "--vu", 0, 0, 1, "--fov", scene["fov"], "--max-path-length", scene["depth"] + 1]
    if scene["background"]:
        options += ["--ambientlight", *[scene["background"] / 2] * 3]
    if "lamp" in scene:
        x, y, z, _, intensity = scene["lamp"]
        options += ["--pointlight", x, y, z, *[embree_gain(scene) * intensity] * 3]
    return options


def embree_gain(scene):
    """Its pictures have 8 bits: so a dark one is made brighter, and read darker by as much."""
    return 1 if scene["background"] else 2


def read_ppm(path):
    """The red of Embree's pictures, whose bytes are floor(255.01 x)."""
    with open(path, "rb") as file:
        words = []
        while len(words) < 4:
            words += file.readline().split(b"#")[0].split()
        pixels = np.frombuffer(file.read(), np.uint8)
    width, height = int(words[1]), int(words[2])
    return (pixels.reshape(height, width, 3)[:, :, 0] + 0.5) / 255.01


def exr_header(data):
    """The attributes, and where they end."""
    at, attributes = 8, {}
    while data[at] != 0:
        name, kind = (text.decode() for text in data[at:].split(b"\0", 2)[:2])
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def exr_channels(text):
    """(name, numpy's type) in the order of the file."""
    found = []
    while text[0] != 0:
        name, rest = text.split(b"\0", 1)
        found.append((name.decode(), (np.uint32, np.float16, np.float32)[struct.unpack_from("<i", rest)[0]]))
        text = rest[16:]
    return found


def read_exr(path):
    """Channels by name, of an EXR file of whole lines that are not packed."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = exr_header(data)
    if attributes["compression"] != b"\0" or "tiles" in attributes:
        raise ValueError(f"{path} is packed or in tiles")
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels = exr_channels(attributes["channels"])
    picture = {name: np.zeros((height, width), kind) for name, kind in channels}
    for start in struct.unpack_from(f"<{height}Q", data, at):
        y, at = struct.unpack_from("<i", data, start)[0] - top, start + 8
        for name, kind in channels:
            picture[name][y] = np.frombuffer(data, kind, width, at)
            at += width * np.dtype(kind).itemsize
    return {name: plane if plane.dtype == np.uint32 else plane.astype(float) for name, plane in picture.items()}
