#!/usr/bin/python3
"""edge_pictures.py BOULE SPHEREFLAKE [--size N] [--repeats N] [--scenes NAME...] [-o FIGURES.json] [--keep FOLDER]

The error of whole pictures over the processor's time: Boule with as many samples everywhere, Boule with --aa,
POV-Ray's adaptive antialiasing, and Tachyon with as many samples everywhere (where no sphere is of glass), on scenes without
noise. BOULE and SPHEREFLAKE are the programs boule and boule_sphereflake; run it in the repository's root. Errors are root
mean squares in codes of 255, of displayed colours that are not rounded, against the program's own reference, because
shading differs: 1024 samples a pixel by Boule, 144 by POV-Ray (12 x 12 a pixel, averaged in linear light), 256 by Tachyon.
Seconds are of one thread, the least of turns, less those of a picture of 8 x 8 pixels. bench/report/publish.py draws the
figures. Needs povray, tachyon, python3-numpy, and boule on PYTHONPATH.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import boule
import numpy as np

from stick_pictures import ELEMENTS, run, tachyon_camera, text

UNIFORM = (1, 2, 4, 8, 16, 32, 64)
ADAPTIVE = (64, 32, 16, 8, 4, 2)
POV = ("-A", "+AM1 +A0.3 +R2", "+AM1 +A0.3 +R3", "+AM1 +A0.1 +R3", "+AM1 +A0.05 +R4", "+AM2 +A0.3 +R2",
       "+AM2 +A0.1 +R2", "+AM2 +A0.1 +R3", "+AM2 +A0.05 +R3")
TACHYON = (1, 2, 4, 8, 16, 32)
TACHYON_FINE = 256
OF_GLASS = ("lecture", "metal_glass_plastic")
FINE = 12  # POV-Ray's reference has so many samples along each side of a pixel


def crambin(folder):
    """The look plain: two lights without position, white paper."""
    rows = [line.split() for line in Path("scenes/crambin.xyz").read_text().splitlines()[2:]]
    file = """[camera]
eye = [-54.4, 77.8, 45.3]
look_at = [8.55, 10.03, 7.1]
up = [0.368, 0.692, -0.621]
fov = 20
[background]
color = [1, 1, 1]
ambient = [0.2, 0.2, 0.2]
[[light]]
type = "directional"
direction = [0.9, -0.4, -0.2]
intensity = [0.5, 0.5, 0.5]
[[light]]
type = "directional"
direction = [0.629, -0.677, -0.381]
intensity = [0.2, 0.2, 0.2]
"""
    for element in sorted({row[0] for row in rows}):
        color, radius = ELEMENTS[element]
        np.save(folder / f"{element}.npy",
                np.array([[*row[1:4], 4 * radius] for row in rows if row[0] == element], "<f4"))
        file += f"""[material.{element}]
type = "plastic"
color = [{color[0]}, {color[1]}, {color[2]}]
specular = 0.04
[[spheres]]
file = "{element}.npy"
material = "{element}"
"""
    return file


def pour(folder):
    """The gallery's grains, some of which still fall, coloured by speed; a floor and two lights."""
    subprocess.run([sys.executable, Path("scenes/particles.py").resolve()], cwd=folder, check=True)
    heap = [[float(x) for x in line.split()] for line in (folder / "heap.xyz").read_text().splitlines()[2:]]
    groups = {}
    for i, (x, y, z, r, *_) in enumerate(heap):
        t = 2 - 3 * i / len(heap)  # since it was let go, 4 above the floor
        is_falling = t < math.sqrt((4 - z) / 4.9)
        if t > 0:
            groups.setdefault(1 + int(9.8 * t / 2) if is_falling else 0, []).append(
                [x, y, 4 - 4.9 * t * t if is_falling else z, r])
    file = """[camera]
eye = [3.4, -6.4, 3.0]
look_at = [0, 0, 1.5]
up = [0, 0, 1]
fov = 38
[background]
color = [1, 1, 1]
ambient = [0.2, 0.2, 0.2]
[material.floor]
color = [0.8, 0.8, 0.8]
[[plane]]
normal = [0, 0, 1]
material = "floor"
[[light]]
type = "directional"
direction = [-0.5, 0.6, -0.9]
intensity = [0.7, 0.7, 0.7]
[[light]]
type = "directional"
direction = [0.8, 0.5, -0.4]
intensity = [0.2, 0.2, 0.2]
"""
    for group, grains in sorted(groups.items()):
        np.save(folder / f"grains{group}.npy", np.array(grains, "<f4"))
        file += f"""[material.m{group}]
color = [{0.25 + 0.12 * group}, {0.3 + 0.08 * group}, 0.5]
[[spheres]]
file = "grains{group}.npy"
material = "m{group}"
"""
    return file


def write_scene(name, folder, sphereflake):
    """Writes scene.toml, with one frame and no options, into the folder. Returns the bounces."""
    bounces = {"crambin": 0, "pour": 0, "flake4": 8, "flake6": 8, "lecture": 8, "metal_glass_plastic": 5}[name]
    made = {"crambin": crambin, "pour": pour}.get(name)
    source = Path(f"scenes/{'sphereflake' if name.startswith('flake') else name}.toml")
    scene = made(folder) if made else source.read_text()
    if name.startswith("flake"):
        subprocess.run([sphereflake, name[5:], folder / "sphereflake.npy"], check=True, stdout=subprocess.DEVNULL)
    for file in {row["file"] for row in all_of(tomllib.loads(scene), "spheres")}:
        if not (folder / file).exists():
            (folder / file).symlink_to(Path("scenes", file).resolve())
    (folder / "scene.toml").write_text(scene if "schema" in scene else "schema = 1\n" + scene)
    return bounces


def all_of(scene, key):
    return scene.get(key, []) + [row for group in scene.get("group", {}).values() for row in group.get(key, [])]


def triple(numbers):
    return "<" + ",".join(f"{x:.9g}" for x in numbers) + ">"


def turn(degrees):
    """The rotation about x, then y, then z."""
    x, y, z = np.radians(degrees)
    about = [[[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]],
             [[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]],
             [[np.cos(z), -np.sin(z), 0], [np.sin(z), np.cos(z), 0], [0, 0, 1]]]
    return np.array(about[2]) @ np.array(about[1]) @ np.array(about[0])


def placed(scene, part, folder):
    """Pairs of a material and spheres, as rows of centre and radius, of a scene or a group with its instances."""
    rows = [(one["material"], np.array([[*one["center"], one["radius"]]])) for one in part.get("sphere", [])]
    rows += [(one["material"], np.load(folder / one["file"]).astype(float)) for one in part.get("spheres", [])]
    for instance in part.get("instance", []):
        matrix, scale = turn(instance.get("rotate", [0, 0, 0])), instance.get("scale", 1)
        for material, spheres in placed(scene, scene["group"][instance["group"]], folder):
            centers = spheres[:, :3] @ matrix.T * scale + np.array(instance.get("translate", [0, 0, 0]))
            rows.append((material, np.column_stack([centers, spheres[:, 3] * scale])))
    return rows


def pov_texture(material, ambient):
    kind, color = material.get("type", "matte"), material.get("color", [0.8, 0.8, 0.8])
    if kind == "emissive":
        return f"texture {{ pigment {{ rgb {triple(material['radiance'])} }} finish {{ ambient 1 diffuse 0 }} }}"
    if kind == "metal":
        return f"texture {{ pigment {{ rgb 0 }} finish {{ ambient 0 diffuse 0 reflection {{ {triple(color)} }} }} }}"
    if kind == "glass":
        return (f"texture {{ pigment {{ rgbf <{color[0]},{color[1]},{color[2]},1> }} finish {{ ambient 0 diffuse 0 "
                f"reflection {{ 0, 1 fresnel on }} conserve_energy }} }} interior {{ ior {material['ior']} }}")
    shine = ""
    if kind == "plastic":
        shine = (f" phong {material.get('specular', 0)} phong_size {material.get('shininess', 50)} "
                 f"reflection {{ {material.get('reflect', 0)} }}")
    return (f"texture {{ pigment {{ rgb {triple(color)} }} finish {{ ambient {triple(ambient)} diffuse 1{shine} }} }}")


def write_pov(folder, bounces):
    """POV-Ray's world is left-handed: the camera is mirrored."""
    scene = tomllib.loads((folder / "scene.toml").read_text())
    camera = scene["camera"] | scene["camera"].get("key", [{}])[0]
    background = scene["background"]
    file = f"""#version 3.7;
global_settings {{ assumed_gamma 1 max_trace_level {bounces + 1} }}
camera {{ location {triple(camera["eye"])} up y right -x sky {triple(camera.get("up", [0, 1, 0]))} angle {camera["fov"]}
look_at {triple(camera["look_at"])} }}
"""
    if background.get("type") == "gradient":
        file += (f"sky_sphere {{ pigment {{ gradient y color_map {{ [0 rgb {triple(background['bottom'])}] "
                 f"[1 rgb {triple(background['top'])}] }} scale 2 translate -1 }} }}\n")
    else:
        file += f"background {{ rgb {triple(background['color'])} }}\n"
    for light in scene["light"]:
        far = light.get("type") == "directional"
        place = -1e4 * np.array(light["direction"]) if far else light["position"]
        file += (f"light_source {{ {triple(place)} color rgb {triple(light['intensity'])}"
                 f"{' parallel point_at 0' if far else ''} }}\n")
    textures = {name: pov_texture(material, background.get("ambient", [0, 0, 0]))
                for name, material in scene["material"].items()}
    for plane in scene.get("plane", []):
        normal, point = plane.get("normal", [0, 1, 0]), plane.get("point", [0, 0, 0])
        file += f"plane {{ {triple(normal)}, {np.dot(normal, point):.9g} {textures[plane['material']]} }}\n"
    for material, spheres in placed(scene, scene, folder):
        file += "".join(f"sphere {{ {triple(s[:3])}, {s[3]:.9g} {textures[material]} }}\n" for s in spheres)
    (folder / "scene.pov").write_text(file)


def tachyon_texture(name, material, ambient):
    kind, color = material.get("type", "matte"), material.get("color", [0.8, 0.8, 0.8])
    shine = ""
    if kind == "metal":
        light = f"AMBIENT 0 DIFFUSE 0 SPECULAR {max(color)}"
    else:
        light = f"AMBIENT {np.mean(ambient):.9g} DIFFUSE 1 SPECULAR {material.get('reflect', 0)}"
        if material.get("specular", 0) > 0:
            shine = f" PHONG PLASTIC {material['specular']} PHONG_SIZE {material.get('shininess', 50)}"
    return f"TEXDEF {name} {light} OPACITY 1{shine} COLOR {text(color)} TEXFUNC 0\n"


def write_tachyon(folder, bounces, size):
    """Tachyon has no colours of metals, and no ambient light by colour."""
    scene = tomllib.loads((folder / "scene.toml").read_text())
    camera, background, mirror = scene["camera"], scene["background"], np.array([-1, 1, 1])
    up = np.array(camera.get("up", [0, 1, 0]))
    file = tachyon_camera(np.array(camera["eye"]), camera["look_at"], up, camera["fov"], size, bounces + 2)
    if background.get("type") == "gradient":
        file += (f"BACKGROUND_GRADIENT SKY_SPHERE UPDIR 0 1 0 TOPVAL 1 BOTTOMVAL -1 TOPCOLOR {text(background['top'])} "
                 f"BOTTOMCOLOR {text(background['bottom'])}\n")
    else:
        file += f"BACKGROUND {text(background['color'])}\n"
    for light in scene["light"]:
        if light.get("type") == "directional":
            file += f"DIRECTIONAL_LIGHT DIRECTION {text(light['direction'] * mirror)} "
        else:
            file += f"LIGHT CENTER {text(light['position'] * mirror)} RAD 0.0001 "
        file += f"COLOR {text(light['intensity'])}\n"
    for name, material in scene["material"].items():
        file += tachyon_texture(name, material, background.get("ambient", [0, 0, 0]))
    for plane in scene.get("plane", []):
        file += (f"PLANE CENTER {text(plane.get('point', [0, 0, 0]) * mirror)} "
                 f"NORMAL {text(plane.get('normal', [0, 1, 0]) * mirror)} {plane['material']}\n")
    for material, spheres in placed(scene, scene, folder):
        file += "".join(f"SPHERE CENTER {text(s[:3] * mirror)} RAD {s[3]:.9g} {material}\n" for s in spheres)
    (folder / f"scene_{size}.dat").write_text(file + "END_SCENE\n")


def tachyon_command(samples, threads=1):
    return ["tachyon", "{folder}/scene_{size}.dat", "-o", "{out}", "-format", "PPM48", "-shade_phong", "-aasamples",
            str(samples - 1), "-numthreads", str(threads)]


def displayed(linear):
    """Codes of 255, which are not rounded."""
    x = np.clip(linear, 0, 1)
    return 255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def boule_picture(scene, size, bounces, **options):
    picture = boule.render(scene, size=(size, size), max_depth=bounces, **options)
    return displayed(np.asarray(picture)[..., :3].astype(float))


def picture_of(path, size):
    """Of a file in linear light, the mean of the samples of a pixel."""
    with open(path, "rb") as file:
        words = []
        while len(words) < 4:
            words += file.readline().split(b"#")[0].split()
        fine = int(words[1])
        step, rows = fine // size, []
        for _ in range(size):
            x = np.frombuffer(file.read(step * fine * 6), ">u2").reshape(step, size, step, 3)
            rows.append(x.mean(axis=(0, 2)) / 65535)
    return displayed(np.array(rows))


def pov_command(mode, threads=1):
    return ["povray", "{folder}/scene.pov", "+W{size}", "+H{size}", f"+WT{threads}", *mode.split(), "-D", "-V", "-GA",
            "+FP16", "File_Gamma=1.0", "+O{out}"]


def picture_name(mode):
    return mode.replace(" ", "") + ".ppm"


def ways_of(name, options, bounces):
    """Rows of program, mode and command, and the options in Python if it is Boule."""
    common = [options.boule, "render", "{folder}/scene.toml", "-o", "{out}", "--size", "{size}x{size}", "--max-depth",
              str(bounces), "-q", "-t", "1"]
    ways = [("uniform", f"{n} spp", [*common, "--spp", str(n)], {"spp": n}) for n in UNIFORM]
    ways += [("adaptive", f"--aa {x}", [*common, "--aa", str(x)], {"aa": x}) for x in ADAPTIVE]
    ways += [("povray", mode, pov_command(mode), None) for mode in POV]
    if name not in OF_GLASS:
        ways += [("tachyon", f"-aasamples {n - 1}", tachyon_command(n), None) for n in TACHYON]
    return ways


def measure(name, options, folder):
    bounces = write_scene(name, folder, options.sphereflake)
    write_pov(folder, bounces)
    scene, size = folder / "scene.toml", options.size
    for pixels in () if name in OF_GLASS else (8, size):
        write_tachyon(folder, bounces, pixels)
    ways, seconds = ways_of(name, options, bounces), {}
    for _ in range(options.repeats):
        start = {}
        for program, mode, command, ours in ways:
            key = program if ours is None else "boule"
            if key not in start:
                start[key] = run(command, folder, 8, folder / "small.ppm")
            taken = run(command, folder, size, folder / picture_name(mode)) - start[key]
            seconds.setdefault((program, mode), []).append(taken)
    reference = boule_picture(scene, size, bounces, spp=1024)
    run(pov_command("-A", 2), folder, size * FINE, folder / "fine.ppm")
    others = {"povray": picture_of(folder / "fine.ppm", size)}
    if name not in OF_GLASS:
        run(tachyon_command(TACHYON_FINE, 2), folder, size, folder / "fine.ppm")
        others["tachyon"] = picture_of(folder / "fine.ppm", size)
    rows = []
    for program, mode, _, ours in ways:
        if ours is None:
            off = picture_of(folder / picture_name(mode), size) - others[program]
        else:
            off = boule_picture(scene, size, bounces, **ours) - reference
        rows.append({"scene": name, "program": program, "mode": mode, "seconds": max(min(seconds[program, mode]), 0.001),
                     "rmse": float(np.sqrt(np.mean(off ** 2))), "p999": float(np.quantile(np.abs(off), 0.999))})
        print("{scene:20} {program:9} {mode:16} {seconds:8.3f} s, RMSE {rmse:6.3f}, 99.9 % {p999:6.2f}".format(**rows[-1]),
              flush=True)
    for program, picture in others.items():
        apart = np.abs(reference - picture).mean()
        print(f"{name}: the references of boule and {program} differ by {apart:.2f} codes on average", flush=True)
    if options.keep:
        for program, codes in ({"boule": reference} | others).items():
            with open(Path(options.keep) / f"{name}_{program}.ppm", "wb") as file:
                file.write(f"P6 {size} {size} 255\n".encode() + np.rint(codes).astype(np.uint8).tobytes())
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("boule")
    parser.add_argument("sphereflake")
    parser.add_argument("--size", type=int, default=512, help="pixels along a side")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--scenes", nargs="*",
                        default=["crambin", "metal_glass_plastic", "lecture", "flake4", "flake6", "pour"])
    parser.add_argument("-o", dest="figures", help="write the figures as JSON")
    parser.add_argument("--keep", help="a folder for the references")
    options = parser.parse_args()
    rows = []
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            rows += measure(name, options, Path(folder))
        if options.figures:
            Path(options.figures).write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
