#!/usr/bin/python3
"""path_peers.py BOULE [--scenes LIST] [--samples LIST] [--repeats N] [--reference N] [--size WxH] [--keep FOLDER]

Path tracing beside others: Boule, Embree's tutorial (pathtracer of Debian's embree-tools), and Cycles (Debian's
blender), its spheres as a point cloud and as meshes. Each renders the same scene with one thread and 4, 16 ...
samples a pixel, in turns. The error is against the program's own picture of many samples, so that another model
is no error; how far these pictures are from Boule's is told too.

Seconds are the processor's, of the whole process, less those of a picture of one sample: so reading, preparing
and writing are left out, of all alike. What is missing is left out. Needs python3-numpy.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from path_peers_files import embree_gain, read_exr, read_ppm, write_embree, write_toml

DEPTH = 8           # bounces after the first hit
STATED = 64         # the samples of Boule whose error the others are to reach
MOST_OFF = 0.01     # references agree where means differ by less than this share,
MOST_RMS = 0.02     # and pixels away from rims by less than this share of the mean (root of the mean square)


def spheres_on_ground(count):
    """Three groups of one albedo each; spheres of different sizes stand on the ground and touch no other."""
    random = np.random.default_rng(7)
    found = np.zeros((0, 4))
    while len(found) < count:
        radius = random.uniform(0.15, 0.5)
        new = np.array([*random.uniform(-5, 5, 2), radius, radius])
        if np.all(np.linalg.norm(found[:, :3] - new[:3], axis=1) > found[:, 3] + radius):
            found = np.vstack([found, new])
    found = np.round(found, 6)
    return [(albedo, found[k::3].tolist()) for k, albedo in enumerate((0.5, 0.65, 0.8))]


def make_scenes(size):
    base = dict(size=size, eye=[0, -9, 8], look_at=[0, 0, 0.3], fov=40, depth=DEPTH, ground=0.5, ground_half=2000,
                groups=spheres_on_ground(150), background=0)
    intensity, radius, place = 40, 0.5, [-3, -2, 6]
    return {
        "sky": base | dict(background=1),
        "point": base | dict(lamp=[*place, 0, intensity]),
        "lamp": base | dict(lamp=[*place, radius, intensity]),
        "glow": base | dict(emitter=[*place, radius, intensity / (np.pi * radius**2)]),
    }


class Boule:
    name, own_seed, rounding = "Boule", True, 0

    def __init__(self, program):
        self.program = program

    def knows(self, _scene):
        return True

    def prepare(self, scene, folder):
        self.scene = folder / "boule.toml"
        write_toml(scene, self.scene)

    def command(self, samples, seed, out):
        return [self.program, "render", self.scene, "-o", f"{out}.exr", "--compression", "none", "-q", "-t", "1",
                "--spp", str(samples), "--seed", str(seed)]

    def picture(self, out):
        return read_exr(f"{out}.exr")["R"]


class Embree:
    name, own_seed = "Embree's pathtracer", False

    def knows(self, scene):
        return "emitter" not in scene and ("lamp" not in scene or scene["lamp"][3] == 0)

    def prepare(self, scene, folder):
        self.options = write_embree(scene, folder / "embree.xml")
        self.gain = embree_gain(scene)
        self.rounding = (1 / 255 / self.gain) ** 2 / 12  # the mean square of what 8 bits change

    def command(self, samples, _seed, out):
        return ["pathtracer", *self.options, "--threads", "1", "--spp", str(samples), "-o", f"{out}.ppm"]

    def picture(self, out):
        return read_ppm(f"{out}.ppm") / self.gain


class Cycles:
    own_seed, rounding = True, 0

    def __init__(self, spheres):
        self.spheres, self.name = spheres, f"Cycles, {spheres}"

    def knows(self, _scene):
        return True

    def prepare(self, scene, folder):
        self.scene = folder / f"cycles_{self.spheres}.json"
        self.scene.write_text(json.dumps(scene | {"spheres": self.spheres}))

    def command(self, samples, seed, out):
        script = Path(__file__).with_name("path_peers_cycles.py")
        return ["blender", "-b", "--factory-startup", "-noaudio", "-t", "1", "--python-exit-code", "1", "-P", script,
                "--", self.scene, str(samples), str(seed), f"{out}.exr"]

    def picture(self, out):
        return read_exr(f"{out}.exr")["R"]


def render(contender, samples, seed, folder):
    """The picture, and the seconds of the processor that the process took."""
    out = folder / "picture"
    log = folder / "log.txt"
    with open(log, "w") as file:
        process = subprocess.Popen([str(word) for word in contender.command(samples, seed, out)], stdout=file,
                                   stderr=subprocess.STDOUT)
        _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{contender.name} failed:\n{log.read_text()[-2000:]}")
    return contender.picture(out), used.ru_utime + used.ru_stime


def measure(contenders, references, options, folder):
    """For each contender its rows (samples, seconds, mean squared error): medians, and means of errors."""
    samples = [1, *options.samples]
    seconds, errors = ({(c.name, n): [] for c in contenders for n in samples} for _ in range(2))
    for repeat in range(options.repeats):
        for n in samples:
            for c in contenders:
                picture, used = render(c, n, repeat + 1, folder)
                error = np.mean((picture - references[c.name]) ** 2) - 2 * c.rounding
                if not c.own_seed:  # the first n samples of the reference are the picture's
                    error *= options.reference / (options.reference - n)
                seconds[c.name, n].append(used)
                errors[c.name, n].append(error)
    rows, starts = {}, {c.name: np.median(seconds[c.name, 1]) for c in contenders}
    print("  seconds of a picture of one sample, left out:",
          ", ".join(f"{name} {start:.2f}" for name, start in starts.items()))
    for c in contenders:
        start = starts[c.name]
        rows[c.name] = [(n, (np.median(seconds[c.name, n]) - start) * n / (n - 1), np.mean(errors[c.name, n]))
                        for n in options.samples]
    return rows


def seconds_to(error, rows):
    """Interpolated on logarithmic axes; beyond the ends along the last two points, which the second value tells."""
    rows = sorted((row for row in rows if row[1] > 0), key=lambda row: -row[2])
    if len(rows) < 2:
        return np.nan, True
    errors, seconds = np.log([row[2] for row in rows]), np.log([row[1] for row in rows])
    k = int(np.clip(np.searchsorted(-errors, -np.log(error)), 1, len(rows) - 1))
    share = (np.log(error) - errors[k - 1]) / (errors[k] - errors[k - 1])
    beyond = share < -1e-9 or share > 1 + 1e-9
    return np.exp(seconds[k - 1] + share * (seconds[k] - seconds[k - 1])), beyond


def rim_pixels(program, scene, folder):
    """Where a neighbour shows another object."""
    out = folder / "ids.exr"
    subprocess.run([program, "render", scene, "-o", out, "--spp", "1", "--aov", "id", "--compression", "none", "-q",
                    "-t", "1"], check=True)
    ids = np.pad(read_exr(out)["id"], 1, mode="edge")
    height, width = ids.shape[0] - 2, ids.shape[1] - 2
    shifted = [ids[y:y + height, x:x + width] for y in range(3) for x in range(3)]
    return np.any([part != shifted[4] for part in shifted], axis=0)


def compare_references(references, rims):
    ours = references["Boule"]
    for name, theirs in references.items():
        if name == "Boule":
            continue
        off = (theirs - ours) / ours.mean()
        mean, inner, rim = off.mean(), np.sqrt(np.mean(off[~rims] ** 2)), np.sqrt(np.mean(off[rims] ** 2))
        verdict = "agrees" if abs(mean) < MOST_OFF and inner < MOST_RMS else "DIFFERS"
        print(f"  {name} {verdict}: mean {100 * mean:+.2f} %, pixels {100 * inner:.2f} % away from rims, "
              f"{100 * rim:.2f} % at rims; {100 * np.mean(np.abs(off) > 0.05):.2f} % of pixels are off by more than "
              "5 % of the mean")


def print_rows(rows):
    target = next(row[2] for row in rows["Boule"] if row[0] == STATED)
    ours = seconds_to(target, rows["Boule"])[0]
    for name, table in rows.items():
        for samples, seconds, error in table:
            print(f"  | {name} | {samples} | {seconds:.3f} | {error:.2e} |")
    print(f"  to the error of Boule's {STATED} samples, {target:.2e}:")
    for name, table in rows.items():
        seconds, beyond = seconds_to(target, table)
        print(f"  | {name} | {seconds:.3f} s | {seconds / ours:.2f} times{', beyond its samples' if beyond else ''} |")


def run_scene(name, scene, contenders, options, folder):
    known = [c for c in contenders if c.knows(scene)]
    print(f"\n{name}: {scene['size'][0]} x {scene['size'][1]}, without "
          f"{', '.join(c.name for c in contenders if c not in known) or 'none'}", flush=True)
    for c in known:
        c.prepare(scene, folder)
    references = {c.name: render(c, options.reference, 999, folder)[0] for c in known}
    if options.keep:
        for title, picture in references.items():
            np.save(Path(options.keep) / f"{name}_{title.replace(' ', '_')}.npy", picture)
    compare_references(references, rim_pixels(known[0].program, known[0].scene, folder))
    print_rows(measure(known, references, options, folder))


def version(command):
    return subprocess.run(command, capture_output=True, text=True).stdout.strip().split("\n")[0]


def find_contenders(program):
    found = [Boule(program)]
    print(version([program, "--version"]))
    if shutil.which("pathtracer"):
        found.append(Embree())
        print("Embree's pathtracer:", version(["dpkg-query", "-W", "embree-tools"]))
    else:
        print("no pathtracer: apt-get install embree-tools")
    if shutil.which("blender"):
        found += [Cycles("points"), Cycles("meshes")]
        print("Cycles of", version(["blender", "--version"]))
    else:
        print("no blender: apt-get install blender")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    numbers = lambda text: [int(word) for word in text.split(",")]
    parser.add_argument("boule")
    parser.add_argument("--scenes", default="sky,point,lamp,glow", help="any of sky, point, lamp, glow")
    parser.add_argument("--samples", type=numbers, default=[4, 16, 64, 256], help="of a pixel, 64 among them")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--reference", type=int, default=4096, help="samples of the references")
    parser.add_argument("--size", type=lambda text: [int(word) for word in text.split("x")], default=[128, 96])
    parser.add_argument("--keep", help="a folder for the references, as .npy")
    options = parser.parse_args()
    if STATED not in options.samples or options.reference <= max(options.samples):
        parser.error(f"{STATED} belongs to the samples, and references have more than all of them")
    contenders, scenes = find_contenders(options.boule), make_scenes(options.size)
    for name in options.scenes.split(","):
        with tempfile.TemporaryDirectory() as folder:
            run_scene(name, scenes[name], contenders, options, Path(folder))


main()
