"""Rays to hits."""

from __future__ import annotations

import math
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
    id: N, int32: of the sphere, plane or capsule, in this order.
    normal: N x 3, float32: unit length, turned against the ray.
    entering: N, bool: the ray goes into the sphere or capsule there, or through the plane against
        its normal.
    hit: N, bool: whether the ray meets anything.
    """

    t: NDArray[np.float64]
    id: NDArray[np.int32]
    normal: NDArray[np.float32]
    entering: NDArray[np.bool_]

    @property
    def hit(self):
        return self.id != -1


class Crossings(NamedTuple):
    """All that N rays cross, in order of t. The crossings of ray k are those from offset[k] to
    before offset[k + 1]: of equal t the lower id comes first, and of one primitive the entry.

    offset: N + 1, int64.
    t: M, float64, in units of the length of dir.
    id: M, int32: of the sphere, plane or capsule, in this order.
    entering: M, bool: as in Hits. A line that touches one crosses it once, entering.
    """

    offset: NDArray[np.int64]
    t: NDArray[np.float64]
    id: NDArray[np.int32]
    entering: NDArray[np.bool_]


class Chords(NamedTuple):
    """The lengths of N rays inside spheres and capsules. Those of ray k are from offset[k] to before
    offset[k + 1], in the order of ids.

    offset: N + 1, int64.
    id: M, int32.
    length: M, float64, above 0, in units of the length of dir.
    """

    offset: NDArray[np.int64]
    id: NDArray[np.int32]
    length: NDArray[np.float64]


class Nearest(NamedTuple):
    """The nearest primitives of N points. Where there is none, the distance is inf and the id -1.

    distance: N, float64; N x k for k above 1: of the surface, negative inside.
    id: as distance, int32: of the sphere, plane or capsule, in this order.
    """

    distance: NDArray[np.float64]
    id: NDArray[np.int32]


class Members(NamedTuple):
    """Primitives of N points. Those of point k are from offset[k] to before offset[k + 1], in the
    order of ids.

    offset: N + 1, int64.
    id: M, int32.
    """

    offset: NDArray[np.int64]
    id: NDArray[np.int32]


class Pairs(NamedTuple):
    """Pairs of spheres, in the order of `first`, then of `second`.

    first, second: M, int32: ids, first < second.
    gap: M, float64: the distance of their surfaces, negative where they overlap.
    """

    first: NDArray[np.int32]
    second: NDArray[np.int32]
    gap: NDArray[np.float64]


def _leading(array, width):
    """The shape of rays in an array of more than one dimension of them, and the array as a list of
    rays. None, and the array as it is, for a list or one value. width: the dimensions of one ray."""
    shape = getattr(array, "shape", ())
    rays = len(shape) - width
    if rays < 2 or not hasattr(array, "reshape"):
        return None, array
    return shape[:rays], array.reshape((math.prod(shape[:rays]), *shape[rays:]))


def _rays(org, dir, tmin, tmax, source, inside):
    """What the compiled part takes as rays, and the shape of the rays: None for a list."""
    given = {"org": org, "dir": dir, "tmin": tmin, "tmax": tmax, "source": source, "inside": inside}
    common = None
    for name in given:
        vectors = name in ("org", "dir")
        if not vectors and common is None:
            continue
        shape, given[name] = _leading(given[name], 1 if vectors else 0)
        if shape is not None and common not in (None, shape):
            raise error(name, f"expected rays of shape {common}, got {shape}")
        common = common or shape
    return given, common


def _flat(arrays, shape):
    """Arrays for rays of this shape as arrays for a list of rays, which share their memory."""
    if shape is None:
        return tuple(arrays)
    flat = []
    for array in arrays:
        if getattr(array, "shape", ())[: len(shape)] != shape or not array.flags.c_contiguous:
            raise error("out", f"expected arrays in C order of shape {shape} and more")
        flat.append(array.reshape((math.prod(shape), *array.shape[len(shape) :])))
    return tuple(flat)


def _number(name, value):
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if math.isnan(number) or isinstance(value, (str, bool)):
        raise error(name, f"expected a number, got {value!r}")
    return number


def _shaped(array, shape):
    return array if shape is None else array.reshape(shape + array.shape[1:])


def _each(query, rays, out):
    """What a query finds for each ray, in `out` if that is given. rays: as _rays() returns them."""
    given, shape = rays
    if out is None:
        return _shaped(query(given, None), shape)
    query(given, out if shape is None else _flat([out], shape)[0])
    return out


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
        if isinstance(source, bytes):
            source = os.path.abspath(source)
        self._made = {"source": source if radii is None else None, "origin": origin, "options": options}

    def update(self, centers, radii=None):
        """Moves the spheres, such as those of the next frame of a simulation: row k of centers is
        that of sphere k.

        centers: N x 3, as many as before. radii: N or one for all; None: they stay.

        All answers are then, to the bit, those of a new Tracer(centers, radii), which would take
        longer: the tree is only adapted, and built anew once that has made it slow. With
        origin="auto" the origin is chosen anew. Only for a Tracer of arrays: raises Error for one
        of a scene, and then, as for any wrong argument, nothing has moved.
        """
        if self._made["source"] is not None:
            raise error("centers", "cannot move the spheres of a scene: make a new Tracer")
        if radii is None:
            radii = self._tracer.spheres()[1]
        self._tracer.update(centers, radii, self._made["origin"])

    def __getstate__(self):
        if self._made["source"] is not None:
            return self._made
        centers, radii, zero = self._tracer.spheres()
        return {**self._made, "centers": centers, "radii": radii, "zero": zero}

    def __setstate__(self, state):
        self._made = {key: state[key] for key in ("source", "origin", "options")}
        options = self._made["options"]
        if self._made["source"] is not None:
            self._tracer = _core.Tracer(self._made["source"], None, None, options)
        else:
            spheres = (state[key] for key in ("centers", "radii", "zero"))
            self._tracer = _core.tracer_at(*spheres, options)

    def closest(
        self, org, dir, tmin=0.0, tmax=float("inf"), *, source=-1, inside=False, out=None
    ):
        """The nearest hits with tmin < t <= tmax, of equally near ones that with the lowest id.

        org, dir: N x 3, float32 or float64, read where they are, whatever their strides; one origin
        or one direction, (3,), serves all rays. dir need not be of unit length; it is rounded to
        float32. The rest is exact in float64.
        tmin, tmax, source, inside: N, or one value for all.
        source: the id of the sphere, plane or capsule that the ray leaves, which it then does not
        meet again by rounding; -1: none. inside: the ray starts on the surface of `source`, a
        sphere or capsule, and goes into it: it meets it at its far side.
        out: Hits of N rays that are written to, in place of new ones.

        Rays may have any shape in place of N: org of H x W x 3 gives t of H x W. Returns Hits.
        """
        rays, shape = _rays(org, dir, tmin, tmax, source, inside)
        if out is None:
            return Hits(*(_shaped(a, shape) for a in self._tracer.closest(rays, None)))
        if not isinstance(out, Hits):
            raise error("out", f"expected Hits, got {type(out).__name__}")
        self._tracer.closest(rays, _flat(out, shape))
        return out

    def any(self, org, dir, tmin=0.0, tmax=float("inf"), *, source=-1, inside=False, out=None):
        """Whether each ray meets anything with tmin < t <= tmax: N, bool. Faster than closest().

        Arguments are those of closest(); out: N, bool.
        """
        return _each(self._tracer.any, _rays(org, dir, tmin, tmax, source, inside), out)

    def all_hits(
        self, org, dir, tmin=0.0, tmax=float("inf"), *, limit=None, source=-1, inside=False
    ):
        """All crossings with tmin < t <= tmax, or the first `limit` of each ray.

        A sphere or capsule is crossed twice, where the ray enters and where it leaves; a plane
        once. Other arguments are those of closest(); rays of other shapes than N are counted in C order.
        Decisions are exact, whatever the solver. Of more than 16 exact copies of one sphere in a
        packed scene, two are found. Returns Crossings.
        """
        if limit is not None and (not isinstance(limit, int) or isinstance(limit, bool)):
            raise error("limit", f"expected a whole number, got {type(limit).__name__}")
        if limit is not None and not 0 <= limit < 2**63:
            raise error("limit", f"must be at least 0, is {limit}")
        rays, _ = _rays(org, dir, tmin, tmax, source, inside)
        return Crossings(*self._tracer.all_hits(rays, limit))

    def count(self, org, dir, tmin=0.0, tmax=float("inf"), *, source=-1, inside=False, out=None):
        """The number of crossings of each ray, as in all_hits(): N, int64. out: N, int64."""
        return _each(self._tracer.count, _rays(org, dir, tmin, tmax, source, inside), out)

    def chord(
        self, org, dir, tmin=0.0, tmax=float("inf"), *, source=-1, inside=False, per_sphere=False,
        out=None,
    ):  # fmt: skip
        """The length of each ray inside the union of all spheres and capsules, between tmin and
        tmax.

        In units of the length of dir: N, float64. Where they overlap it counts once. With
        per_sphere, the length inside each sphere and capsule on its own: Chords. Arguments are those of
        closest(); out: N, float64, not with per_sphere.
        """
        if not isinstance(per_sphere, bool):
            raise error("per_sphere", f"expected True or False, got {type(per_sphere).__name__}")
        rays = _rays(org, dir, tmin, tmax, source, inside)
        if not per_sphere:
            return _each(self._tracer.chord, rays, out)
        if out is not None:
            raise error("out", "cannot stand beside 'per_sphere'")
        return Chords(*self._tracer.chords(rays[0]))

    def nearest(self, points, k=1, limit=float("inf")):
        """The k nearest spheres, planes and capsules of each point, the nearest first.

        points: N x 3, float32 or float64, read where they are, finite and at most 1e150 in size;
        or of any shape in place of N. k: at least 1. limit: the largest distance that counts.

        The distance is that of the surface, negative inside: the exact one, rounded once. At equal
        distance the lower id comes first. A plane bounds the half-space behind it. Returns Nearest.
        """
        if not isinstance(k, int) or isinstance(k, bool):
            raise error("k", f"expected a whole number, got {type(k).__name__}")
        if not 1 <= k < 2**31:
            raise error("k", f"must be at least 1 and below 2^31, is {k}")
        limit = _number("limit", limit)
        shape, points = _leading(points, 1)
        found = self._tracer.nearest(points, k, limit)
        return Nearest(*(_shaped(a[:, 0] if k == 1 else a, shape) for a in found))

    def inside(self, points, *, first=False):
        """The spheres, planes and capsules that each point is in. A point on the surface is inside.

        points: as for nearest(). With first, the lowest id of each point, or -1: N, int32.
        Otherwise Members; points of other shapes than N are counted in C order.
        """
        if not isinstance(first, bool):
            raise error("first", f"expected True or False, got {type(first).__name__}")
        shape, points = _leading(points, 1)
        if first:
            return _shaped(self._tracer.first_inside(points), shape)
        return Members(*self._tracer.members(points, 0.0))

    def within(self, points, radius):
        """The spheres, planes and capsules whose distance is at most `radius`, decided exactly.

        points: as for nearest(), and so is the distance: a negative radius asks for points so deep
        inside. radius: N, or one number for all. Returns Members.
        """
        shape, points = _leading(points, 1)
        given, radius = _leading(radius, 0)
        if given is not None and given != shape:
            raise error("radius", f"expected one number for each point, got shape {given}")
        return Members(*self._tracer.members(points, radius))

    def pairs(self, gap=0.0):
        """All pairs of spheres whose surfaces are at most `gap` apart, decided exactly.

        0 gives the spheres that touch or overlap, a negative gap those that overlap by as much.
        Planes and capsules are left out: within() has them. Returns Pairs.
        """
        return Pairs(*self._tracer.pairs(_number("gap", gap)))

    @property
    def stats(self):
        """The cost so far: rays, points, prepare_seconds, trace_seconds, isa, width, threads."""
        return self._tracer.stats()
