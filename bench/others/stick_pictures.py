#!/usr/bin/python3
"""stick_pictures.py BOULE CRAMBIN.XYZ [--size N] [--repeats N] [--keep FOLDER]

Whole balls-and-sticks pictures by Boule, POV-Ray and Tachyon: caffeine, crambin (scenes/crambin.xyz) and 153 crambins
in a box, 50,031 atoms. Each program has the same atoms, half bonds, camera, light and shadows, one sample in the middle
of each pixel, and one thread. Seconds are the processor's, of the whole process, less those of a picture of 8 x 8
pixels; medians of turns. Pictures are held against Boule's. What is missing is left out. Needs python3-numpy.
"""
import argparse
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

CAFFEINE = """O 0.4700 2.5688 0.0006 O -3.1271 -0.4436 -0.0003 N -0.9686 -1.3125 0 N 2.2182 0.1412 -0.0003
N -1.3477 1.0797 -0.0001 N 1.4119 -1.9372 0.0002 C 0.8579 0.2592 -0.0008 C 0.3897 -1.0264 -0.0004
C 0.0307 1.4220 -0.0006 C -1.9061 -0.2495 -0.0004 C 2.5032 -1.1998 0.0003 C -1.4276 -2.6960 0.0008
C 3.1926 1.2061 0.0003 C -2.2969 2.1881 0.0007 H 3.5163 -1.5787 0.0008 H -1.0451 -3.1973 -0.8937
H -2.5186 -2.7596 0.0011 H -1.0447 -3.1963 0.8957 H 4.1992 0.7801 0.0002 H 3.0468 1.8092 -0.8992
H 3.0466 1.8083 0.9004 H -1.8087 3.1651 -0.0003 H -2.9322 2.1027 0.8881 H -2.9346 2.1021 -0.8849"""
ELEMENTS = {  # colour, and the ball's radius
    "H": ((0.9, 0.9, 0.9), 0.28), "C": ((0.2, 0.2, 0.2), 0.42), "N": ((0.1, 0.2, 0.9), 0.4),
    "O": ((0.9, 0.1, 0.1), 0.38), "S": ((0.9, 0.7, 0.1), 0.45)}
DIFFUSE, BOND_RADIUS = 0.9, 0.15
BACKGROUND = (0.5, 0.6, 0.7)
FOV = 35


def bonds(elements, places):
    """Pairs nearer than 1.95, or 1.25 with a hydrogen: by cubes of that size."""
    cubes = {}
    for i, cube in enumerate(map(tuple, np.floor(places / 1.95).astype(int))):
        cubes.setdefault(cube, []).append(i)
    pairs = []
    for (x, y, z), members in cubes.items():
        near = [j for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                for j in cubes.get((x + dx, y + dy, z + dz), ())]
        for i in members:
            distances = np.linalg.norm(places[near] - places[i], axis=1)
            for j, distance in zip(near, distances):
                if i < j and distance < (1.25 if "H" in (elements[i], elements[j]) else 1.95):
                    pairs.append((i, j))
    return np.array(pairs)


def make_scene(elements, places):
    """Balls and half bonds by element; camera and light."""
    places = places - (places.min(axis=0) + places.max(axis=0)) / 2
    pairs, elements = bonds(elements, places), np.array(elements)
    middle = (places[pairs[:, 0]] + places[pairs[:, 1]]) / 2
    ends = np.concatenate([np.hstack([places[pairs[:, k]], middle]) for k in (0, 1)])
    owners = np.concatenate([elements[pairs[:, k]] for k in (0, 1)])
    reach = np.linalg.norm(places, axis=1).max() + 0.5
    eye = np.array([0.35, -0.9, 0.45]) / np.linalg.norm([0.35, -0.9, 0.45]) * reach / np.sin(np.radians(FOV / 2))
    kinds = [e for e in ELEMENTS if e in elements]
    return {"eye": eye, "light": np.array([-2, -3, 4.0]) * reach,
            "balls": {e: places[elements == e] for e in kinds}, "sticks": {e: ends[owners == e] for e in kinds}}


def read_crambin(path, copies):
    rows = [line.split() for line in Path(path).read_text().splitlines()[2:]]
    places = np.array([row[1:4] for row in rows], float)
    step = places.max(axis=0) - places.min(axis=0) + 2
    boxes = [(i % 5, i // 5 % 5, i // 25) for i in range(copies)]
    return [row[0] for row in rows] * copies, np.concatenate([places + step * box for box in boxes])


def text(numbers, separator=" "):
    return separator.join(f"{x:.7g}" for x in numbers)


def write_boule(scene, folder):
    file = f"""schema = 1
[camera]
eye = [{text(scene["eye"], ",")}]
look_at = [0, 0, 0]
up = [0, 0, 1]
fov = {FOV}
[background]
color = [{text(BACKGROUND, ",")}]
[[light]]
position = [{text(scene["light"], ",")}]
intensity = [1, 1, 1]
"""
    for e, balls in scene["balls"].items():
        color, radius = ELEMENTS[e]
        np.save(folder / f"{e}_balls.npy", balls.astype("<f4"))
        np.save(folder / f"{e}_sticks.npy", scene["sticks"][e].astype("<f4"))
        file += f"""[material.{e}]
type = "phong"
color = [{text(color, ",")}]
ka = 0
kd = {DIFFUSE}
ks = 0
[[spheres]]
file = "{e}_balls.npy"
radius = {radius}
material = "{e}"
[[capsules]]
file = "{e}_sticks.npy"
radius = {BOND_RADIUS}
material = "{e}"
"""
    (folder / "scene.toml").write_text(file)


def write_pov(scene, folder):
    """Its world is left-handed: the camera is mirrored."""
    file = f"""#version 3.7;
global_settings {{ assumed_gamma 1 }}
camera {{ location <{text(scene["eye"], ",")}> up y right -x sky z angle {FOV} look_at 0 }}
background {{ color rgb <{text(BACKGROUND, ",")}> }}
light_source {{ <{text(scene["light"], ",")}> color rgb 1 }}
"""
    for e, balls in scene["balls"].items():
        color, radius = ELEMENTS[e]
        file += "union {\n" + "\n".join(f"sphere {{ <{text(p, ',')}>, {radius} }}" for p in balls) + "\n"
        file += "\n".join(f"cylinder {{ <{text(s[:3], ',')}>, <{text(s[3:], ',')}>, {BOND_RADIUS} open }}"
                          for s in scene["sticks"][e])
        file += (f"\ntexture {{ pigment {{ color rgb <{text(color, ',')}> }} "
                 f"finish {{ ambient 0 diffuse {DIFFUSE} }} }} }}\n")
    (folder / "scene.pov").write_text(file)


def tachyon_camera(eye, look_at, up, fov, size, depth):
    """The head of a scene of so many pixels a side. Tachyon's world is left-handed: x is mirrored. The camera is turned by
    half a pixel, since samples lie around the pixels' corners."""
    mirror = np.array([-1, 1, 1])
    half = np.tan(np.radians(fov / 2))
    forward = (np.array(look_at) - eye).astype(float)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    view = forward - (right + np.cross(right, forward)) * half / size
    return f"""BEGIN_SCENE
RESOLUTION {size} {size}
CAMERA
ZOOM {0.5 / half:.9g}
ASPECTRATIO 1
ANTIALIASING 0
RAYDEPTH {depth}
CENTER {text(eye * mirror)}
VIEWDIR {text(view * mirror)}
UPDIR {text(up * mirror)}
END_CAMERA
"""


def write_tachyon(scene, folder, size):
    mirror = np.array([-1, 1, 1])
    file = tachyon_camera(scene["eye"], np.zeros(3), np.array([0, 0, 1]), FOV, size, 2) + f"""\
BACKGROUND {text(BACKGROUND)}
LIGHT CENTER {text(scene["light"] * mirror)} RAD 0.0001 COLOR 1 1 1
"""
    for e, balls in scene["balls"].items():
        color, radius = ELEMENTS[e]
        file += (f"TEXDEF {e} AMBIENT 0 DIFFUSE {DIFFUSE} SPECULAR 0 OPACITY 1 COLOR {text(color)} TEXFUNC 0\n")
        file += "".join(f"SPHERE CENTER {text(p * mirror)} RAD {radius} {e}\n" for p in balls)
        file += "".join(f"FCYLINDER BASE {text(s[:3] * mirror)} APEX {text(s[3:] * mirror)} RAD {BOND_RADIUS} {e}\n"
                        for s in scene["sticks"][e])
    (folder / f"scene_{size}.dat").write_text(file + "END_SCENE\n")


def commands(boule, folder):
    """By name: the command for a picture of so many pixels a side, and whether its bytes are linear."""
    all_of = {"Boule": ([boule, "render", "{folder}/scene.toml", "-o", "{out}", "--size", "{size}x{size}", "-q", "-t",
                         "1"], False),
              "POV-Ray": (["povray", "{folder}/scene.pov", "+W{size}", "+H{size}", "+WT1", "-A", "-D", "-V", "-GA",
                           "+FP8", "File_Gamma=1.0", "+O{out}"], True),
              "Tachyon": (["tachyon", "{folder}/scene_{size}.dat", "-o", "{out}", "-format", "PPM", "-shade_phong",
                           "-raydepth", "2", "-numthreads", "1"], True)}
    return {name: both for name, both in all_of.items() if shutil.which(both[0][0])}


def run(command, folder, size, out):
    words = [word.format(folder=folder, size=size, out=out) for word in command]
    with open(folder / "log", "w") as log:
        process = subprocess.Popen(words, stdout=log, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{words[0]} failed:\n{(folder / 'log').read_text()[-2000:]}")
    return used.ru_utime + used.ru_stime


def read_ppm(path, is_linear):
    with open(path, "rb") as file:
        words = []
        while len(words) < 4:
            words += file.readline().split(b"#")[0].split()
        x = np.frombuffer(file.read(), np.uint8) / 255
    return x if is_linear else np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def measure(name, scene, options, folder):
    write_boule(scene, folder)
    write_pov(scene, folder)
    for size in (8, options.size):
        write_tachyon(scene, folder, size)
    programs, times = commands(options.boule, folder), {}
    for _ in range(options.repeats):
        for program, (command, _) in programs.items():
            start = run(command, folder, 8, folder / "thrown_away.ppm")
            whole = run(command, folder, options.size, folder / f"{program}.ppm")
            times.setdefault(program, []).append((whole - start, start))
    pictures = {p: read_ppm(folder / f"{p}.ppm", linear) for p, (_, linear) in programs.items()}
    ours = statistics.median(t[0] for t in times["Boule"])
    print(f"{name}: {sum(map(len, scene['balls'].values()))} atoms, {sum(map(len, scene['sticks'].values()))} half bonds")
    for program, rows in times.items():
        taken, off = [row[0] for row in rows], np.abs(pictures[program] - pictures["Boule"])
        print(f"  {program}: {statistics.median(taken):.3f} s ({min(taken):.3f} to {max(taken):.3f}), "
              f"{statistics.median(taken) / ours:.1f} times; start {statistics.median(r[1] for r in rows):.3f} s; "
              f"off by {off.mean():.4f} on average, {100 * np.mean(off > 0.1):.2f} % by more than 0.1", flush=True)
        if options.keep:
            shutil.copy(folder / f"{program}.ppm", Path(options.keep) / f"{name}_{program}.ppm")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("boule")
    parser.add_argument("crambin")
    parser.add_argument("--size", type=int, default=512, help="pixels along a side")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--keep", help="a folder for the pictures")
    options = parser.parse_args()
    words = CAFFEINE.split()
    caffeine = words[::4], np.array([words[k::4] for k in (1, 2, 3)], float).T
    for name, atoms in {"caffeine": caffeine, "crambin": read_crambin(options.crambin, 1),
                        "box": read_crambin(options.crambin, 153)}.items():
        with tempfile.TemporaryDirectory() as folder:
            measure(name, make_scene(*atoms), options, Path(folder))


if __name__ == "__main__":
    main()
