"""A picture and its depth in false colours, side by side in matplotlib.

Run it: python3 matplotlib_depth.py FIGURE.png
"""

from __future__ import annotations

import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import boule

rng = np.random.default_rng(3)
scene = boule.Scene(background=boule.GradientBackground(), ambient=(0.3, 0.3, 0.3))
centers = rng.uniform(-2.0, 2.0, (400, 3))
scene.add_spheres(centers, 0.25, scalar=centers[:, 1], map="coolwarm", material=boule.Plastic())
scene.lights.append(boule.DirectionalLight(direction=(-1, -2, -1)))
picture = boule.render(scene, size=(400, 300), spp=16, aov="depth")

depth = picture.aovs["depth"]
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
left.imshow(picture.to_srgb())
left.set_title("picture")
shown = right.imshow(np.where(np.isfinite(depth), depth, np.nan), cmap="viridis")
right.set_title("distance")
figure.colorbar(shown, ax=right)
for axes in (left, right):
    axes.set_axis_off()
figure.savefig(sys.argv[1], dpi=100)
