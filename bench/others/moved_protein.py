#!/usr/bin/python3
"""moved_protein.py BOULE: what moving a protein far from 0 does to hits, with an origin and without.

Crambin (scenes/crambin.xyz), its positions rounded to 1/1024 so that the moved ones are exact, is moved by
(1, -2, 0.5) 10^k and hit by 200,000 rays that are aimed at its atoms. A line for each k: how many hits of a
million are other ones than at 0, the 99th percentile of the error of t in ulp of float, and the largest
distance of a hit from its atom's surface, in radii. Needs python3-numpy.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

RAYS = 200_000
RADII = {"C": 1.77, "N": 1.66, "O": 1.50, "S": 1.89}  # Alvarez 2013


def crambin():
    lines = (Path(__file__).parents[2] / "scenes" / "crambin.xyz").read_text().split("\n")
    words = [line.split() for line in lines[2:2 + int(lines[0])]]
    positions = np.array([[float(word) for word in row[1:4]] for row in words])
    return [row[0] for row in words], np.round(positions * 1024) / 1024


def aimed_rays(positions):
    """N x 8: from a sphere of radius 64, at origins that are short binary fractions."""
    random = np.random.default_rng(5)
    outward = random.normal(size=(RAYS, 3))
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    rays = np.zeros((RAYS, 8))
    rays[:, 0:3] = np.round((np.round(positions.mean(0)) + 64 * outward) * 64) / 64
    aims = positions[random.integers(0, len(positions), RAYS)] + random.normal(size=(RAYS, 3))
    way = aims - rays[:, 0:3]
    rays[:, 4:7] = (way / np.linalg.norm(way, axis=1)[:, None]).astype(np.float32)
    rays[:, 7] = np.inf
    return rays


class Tracer:
    def __init__(self, program, folder):
        self.program, self.folder = program, Path(folder)
        self.elements, self.positions = crambin()
        self.rays = aimed_rays(self.positions)

    def hits(self, shift, origin):
        rows = (f"{e} {x!r} {y!r} {z!r}\n" for e, (x, y, z) in
                zip(self.elements, (self.positions + shift).tolist()))
        (self.folder / "atoms.xyz").write_text(f"{len(self.elements)}\n\n" + "".join(rows))
        scene = self.folder / "scene.toml"
        scene.write_text(f'schema = 1\norigin = {origin}\n[[particles]]\nfile = "atoms.xyz"\n')
        rays = self.rays.copy()
        rays[:, 0:3] += shift
        np.save(self.folder / "rays.npy", rays)
        out = self.folder / "hits.npy"
        subprocess.run([self.program, "trace", scene, "--rays", self.folder / "rays.npy", "-o", out, "-q"],
                       check=True)
        return np.load(out)

    def errors(self, hits, right):
        """Wrong hits of a million, p99 of the error of t in ulp, largest distance in radii."""
        both = (hits["id"] == right["id"]) & (right["id"] >= 0)
        t, expected, ids = hits["t"][both], right["t"][both], right["id"][both]
        ulp = np.spacing(expected.astype(np.float32)).astype(float)
        points = self.rays[both, 0:3] + t[:, None] * self.rays[both, 4:7]
        radii = np.array([RADII[e] for e in self.elements])[ids]
        off = np.abs(np.linalg.norm(points - self.positions[ids], axis=1) - radii) / radii
        return (1e6 * np.mean(hits["id"] != right["id"]), np.percentile(np.abs(t - expected) / ulp, 99),
                off.max())


def main():
    with tempfile.TemporaryDirectory() as folder:
        tracer = Tracer(sys.argv[1], folder)
        right = tracer.hits(np.zeros(3), "[0, 0, 0]")
        for k in range(3, 8):
            shift = np.array([1, -2, 0.5]) * 10.0**k
            for origin in ('"auto"', "[0, 0, 0]"):
                wrong, ulp, off = tracer.errors(tracer.hits(shift, origin), right)
                print(f"10^{k} origin = {origin:10}: {wrong:8.0f} wrong in a million, {ulp:8.0f} ulp of t, "
                      f"{off:.1g} radii from the surface")


if len(sys.argv) != 2 or not Path(sys.argv[1]).is_file():
    sys.exit(__doc__)
main()
