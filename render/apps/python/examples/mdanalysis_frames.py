"""A trajectory of MDAnalysis to pictures, one for each frame, all by one camera.

Run it: python3 mdanalysis_frames.py FOLDER [TOPOLOGY TRAJECTORY]
"""

from __future__ import annotations

import pathlib
import sys
from typing import Any

import MDAnalysis
import numpy as np

import boule


def drifting_water() -> Any:
    """27 molecules of water that drift apart, four frames."""
    corners = np.stack(np.meshgrid(*[np.arange(3.0)] * 3), axis=-1).reshape(-1, 3) * 3.1
    water = np.array([[0.0, 0.0, 0.0], [0.96, 0.0, 0.0], [-0.24, 0.93, 0.0]])
    positions = (corners[:, None, :] + water).reshape(-1, 3)
    count = len(positions)
    universe = MDAnalysis.Universe.empty(count, trajectory=True)
    universe.add_TopologyAttr("elements", ["O", "H", "H"] * (count // 3))
    speeds = np.random.default_rng(1).normal(0.0, 0.4, (count // 3, 3)).repeat(3, axis=0)
    frames = np.stack([positions + k * speeds for k in range(4)])
    universe.load_new(frames, order="fac")
    return universe


def main(folder: str, *files: str) -> None:
    universe = MDAnalysis.Universe(*files) if files else drifting_water()
    atoms = universe.atoms
    camera = None
    for step in universe.trajectory:
        scene = boule.from_particles(atoms.positions, species=atoms.elements, look="plain")
        if camera is None:  # stays where it is: the pictures are one movie
            middle = atoms.positions.mean(axis=0).astype(float)
            reach = float(np.abs(atoms.positions - middle).max())
            eye = middle + np.array([0.0, 2 * reach, 6 * reach])
            camera = boule.Pinhole(eye=eye, look_at=middle, fov=36, fov_axis="y")
        scene.camera = camera
        picture = boule.render(scene, size=(320, 240), spp=4)
        picture.save(pathlib.Path(folder) / f"frame{step.frame:04d}.png")


if __name__ == "__main__":
    main(*sys.argv[1:])
