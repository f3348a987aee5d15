"""What Boule reads of particle files, for the tests beside libraries of Python."""
import importlib
import json
import os
import subprocess
import sys

import numpy as np

PROGRAM = sys.argv[1]  # boule_print_particles


def run(path, *arguments, modules=""):
    """What it prints. `modules`: a folder whose modules come first."""
    environment = {**os.environ, "BOULE_PYTHON": sys.executable, "PYTHONPATH": str(modules)}
    done = subprocess.run([PROGRAM, str(path), *map(str, arguments)], capture_output=True, text=True,
                          env=environment)
    return done.returncode, done.stdout


def read(path, *arguments, **more):
    code, text = run(path, *arguments, **more)
    assert code == 0, f"{path}: {text}"
    return [json.loads(line) for line in text.splitlines()]


def numbers(texts, *shape):
    return np.array([float.fromhex(text) for text in texts]).reshape(*shape)


def same(path, mine, positions, cell=None, species=None, origin=(0, 0, 0)):
    """One frame: the same bits."""
    assert np.array_equal(numbers(mine["positions"], -1, 3), np.float64(positions)), f"{path}: positions"
    if cell is not None:
        read_cell = numbers(mine["cell"], 4, 3)
        assert np.array_equal(read_cell, np.vstack([np.float64(cell), [origin]])), f"{path}: cell"
    if species is not None:
        assert mine["species"] == list(species), f"{path}: {mine['species']}"


def module(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        print(f"{name} is not there: its formats are left out")
        return None
