"""Boule renders scenes of spheres, planes and capsules: exact hits, the same bits on every machine.

    import boule
    hits = boule.Tracer(centers, radii).closest(org, dir)
    picture = boule.render("scene.toml", size=(640, 480), spp=16)
    scene = boule.Scene()
    scene.add_spheres(centers, radii, colors=rgb, material=boule.Plastic())
    boule.render(scene).save("spheres.png")

Lengths are in the units of the scene, angles in degrees, colours linear RGB or "#rrggbb". Faults
raise boule.Error, a ValueError with file, line, column and key; too little memory is a MemoryError.
You may call all functions from any thread; they give way to other threads of Python.
Ctrl-C ends every call within a tenth of a second.
"""

from . import _objects
from ._camera import Rays
from ._core import Error as Error
from ._core import Picture as Picture
from ._core import isa as isa
from ._core import version as __version__
from ._objects import *  # noqa: F403
from ._pickling import install as _install
from ._rendering import Interrupted, render
from ._scene import Capsules, Group, Scene, Spheres
from ._sources import frames, from_ase, from_particles, load, series
from ._tracing import Chords, Crossings, Hits, Members, Nearest, Pairs, Tracer
from ._viewing import View, view

_install()
del _install

__all__ = [
    *_objects.__all__,
    "Capsules",
    "Chords",
    "Crossings",
    "Error",
    "Group",
    "Hits",
    "Interrupted",
    "Members",
    "Nearest",
    "Pairs",
    "Picture",
    "Rays",
    "Scene",
    "Spheres",
    "Tracer",
    "View",
    "__version__",
    "frames",
    "from_ase",
    "from_particles",
    "isa",
    "load",
    "render",
    "series",
    "view",
]

for _name in __all__:  # as they are known to those who use them
    if hasattr(globals()[_name], "__module__"):
        globals()[_name].__module__ = "boule"
del _name
