"""The camera of a scene: its rays, and the numbers of a fitted one."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from . import _core
from ._objects import KINDS, Fit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_FITTED = {"pinhole": KINDS["Pinhole"], "orthographic": KINDS["Orthographic"]}


class Rays(NamedTuple):
    """Rays of a camera, one for each pixel. Tracer.closest(*rays) traces them.

    origin: H x W x 3, float64.
    direction: H x W x 3, float32; 0 where the camera has no ray: such rays miss everything.
    """

    origin: NDArray[np.float64]
    direction: NDArray[np.float32]


def rays_of(tree, frame, options):
    return Rays(*_core.camera_rays(tree, {"frame": frame}, options))


def fitted_camera(tree, camera, size):
    """The camera that a fit of the scene's, or the usual one, finds. tree: without a camera."""
    fit = camera if isinstance(camera, Fit) else None
    if fit is not None:
        tree["camera"] = fit._table(None)
    keys = dict(_core.fitted_camera(tree, {"size": size}))
    found = _FITTED[keys.pop("type")](**keys)
    if fit is not None and fit.distortion is not None:
        found.distortion = fit.distortion
    return found
