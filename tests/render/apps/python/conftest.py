"""What the tests of the Python package share. PYTHONPATH names the folder of the package."""

import os
import pathlib
import signal
import threading
import time

import numpy as np
import pytest

import boule

ROOT = pathlib.Path(__file__).resolve().parents[4]


@pytest.fixture
def scenes():
    """The folder of the gallery's scenes."""
    return ROOT / "scenes"


@pytest.fixture
def ball():
    """A ball on a plane, lit by one lamp."""
    scene = boule.Scene()
    scene.add_sphere(center=(0, 1, 0), material=boule.Plastic(color="#c83214"))
    scene.add_plane()
    scene.camera = boule.Pinhole(eye=(0, 2, 6), look_at=(0, 1, 0))
    scene.lights.append(boule.PointLight(position=(4, 6, 4)))
    scene.image.size = (64, 48)
    return scene


@pytest.fixture
def endless():
    """A scene that takes minutes."""
    centers = np.random.default_rng(0).uniform(-5, 5, (5000, 3))
    scene = boule.Scene(background=boule.GradientBackground())
    scene.add_spheres(centers, 0.2)
    scene.image.size = (800, 600)
    scene.image.spp = 100_000
    scene.render.method = "path"
    return scene


def interrupt_after(seconds):
    """Sends this process a SIGINT, as Ctrl-C does."""

    def send():
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=send).start()


def program():
    """The program boule of the same build."""
    return os.environ["BOULE_PROGRAM"]
