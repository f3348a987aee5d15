"""Rays to hits."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, NamedTuple

from . import _core
from ._checks import Strict
from ._objects import error, path_of
from ._scene import Scene

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Hits(NamedTuple):
    """The hits of N rays. A miss has t = inf, id = -1 and the normal 0.

    t: N, float64, in units of the length of dir.
    id: N, int32: of the sphere or plane, spheres first.
    normal: N x 3, float32: unit length, turned against the ray.
    """

    t: NDArray[np.float64]
    id: NDArray[np.int32]
    normal: NDArray[np.float32]


class Tracer(Strict):
    """Traces rays against spheres, or against the objects of a scene, on all cores.

    Tracer(centers, radii): N x 3 and N (or one number), float32 or float64, read where they are and
        rounded once; origin ("auto" or a point) is subtracted before, and from rays too.
    Tracer(scene): a Scene or the name of a scene file. Rays are given as if it had no origin.
    solver: "robust", "fast" or "reference". threads: 0 to 1024, 0 is all. isa: see `boule isa`.

    The arrays may be changed or dropped afterwards. Any threads may call a Tracer; one call at a
    time works, the others wait.
    """

    def __init__(
        self, source, radii=None, *, origin="auto", solver="robust", threads=0, isa="auto"
    ):
        if radii is None and isinstance(source, (str, os.PathLike)):
            source = path_of(source)
        elif radii is None and isinstance(source, Scene):
            source = source._tree()
        elif radii is None:
            raise _core.Error(
                f"expected centers and radii, a Scene or the name of a scene file, got one "
                f"{type(source).__name__}"
            )
        if isinstance(origin, str):
            if origin != "auto":
                raise error("origin", f'expected "auto" or a point, got {origin!r}')
            origin = None
        options = {"solver": solver, "threads": threads, "isa": isa}
        self._tracer = _core.Tracer(source, radii, origin, options)

    def closest(self, org, dir, tmin=0.0, tmax=float("inf")):
        """The nearest hits with tmin < t <= tmax, of equally near ones that with the lowest id.

        org, dir: N x 3, float32 or float64, read where they are, whatever their strides; one origin
        or one direction, (3,), serves all rays. dir need not be of unit length; it is rounded to
        float32, org is not. tmin, tmax: N, or one number for all. Returns Hits.
        """
        return Hits(*self._tracer.closest(org, dir, tmin, tmax))

    def any(self, org, dir, tmin=0.0, tmax=float("inf")):
        """Whether each ray meets anything with tmin < t <= tmax: N, bool. Faster than closest()."""
        return self._tracer.any(org, dir, tmin, tmax)

    @property
    def stats(self):
        """The cost so far: rays, prepare_seconds, trace_seconds, isa, width, threads."""
        return self._tracer.stats()
