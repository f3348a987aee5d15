"""Scenes to pictures."""

from __future__ import annotations

import os

from . import _core
from ._objects import error, path_of
from ._progress import reporter
from ._scene import Scene
from ._sources import load, look_keys, particles_of, with_look


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during render(). picture is the unfinished Picture, or None before there is one."""

    def __init__(self, picture=None):
        super().__init__("rendering was interrupted")
        self.picture = picture


@with_look(also=_core.render_choices)
def render(scene, *, time_limit=None, partial=False, progress=False, frame=None, **given):
    """Renders a scene to a Picture. Arguments that you leave out come from the scene.

    scene: a Scene, or what load() would read: atoms, or the name of a file; then frame, polygons and look are
        as there. Of a packed scene, .boule, it is always the name, and trust=True opens it without
        checking it: for your own files only.
    size: (width, height) in pixels. spp: samples per pixel. filter: "box" or "tent".
    noise: each pixel gets samples, min_spp to spp of them, until it is right to so much of 0..1 as
        it is shown with this exposure, with a probability of 95 %; 0: all pixels get spp.
    aa: adaptive antialiasing, for method "whitted": pixels that differ from one around by more than
        so many codes of 255 (8, say) get up to spp samples (64), the others one; 0: all get spp.
    background: the colour behind all objects: "#rrggbb" or "transparent". outline: in pixels, or
        "0.5pt". fog: the share of the background in what is farthest, 0 to 1. width ("85mm") and dpi: the size in print; of size the shape counts then.
    overlay: what is drawn on the picture where it is shown or saved in 8 bits, PDF or SVG: any of
        legend, scale, axes, time, or "none". np.asarray(picture) has none of it.
    seed: of the random numbers. crop: (x0, y0, x1, y1), pixels of the frame to render.
    aov: names of extra channels: "depth,normal" or a list of them (depth, normal, position, id,
        albedo, z; with noise or aa also noise, samples).
    method: "whitted" or "path". max_depth: bounces after the first hit. least_weight: mirrored and
        refracted rays are left out whose weights in a sample add up to at most this, 0 to 1.
    shadow_epsilon: for teaching: where shadow rays begin, a length or "none", in place of Boule's way
        without an epsilon. It makes false shadows.
    time_limit: seconds of rendering. partial: when the time limit or Ctrl-C comes, return the
        unfinished picture (Picture.finished is False) in place of an exception.
    order: "rows", "tiles", "progressive" (with partial) or "frameless"; never shows in a finished
        picture. tile: its side in pixels. solver, threads, isa: as for Tracer.
    progress: True shows a bar (tqdm's if it is installed); or a function, called with the share
        that is done, 0 to 1; 1 comes once, at the end of a render that was not stopped.

    Raises Interrupted, a KeyboardInterrupt, after Ctrl-C; it has the unfinished picture.
    """
    look = {name: given.pop(name) for name in look_keys() if name in given}
    if particles_of(scene) is not None:
        scene, look = load(scene, **look), {}
    if isinstance(scene, Scene):
        source = scene._tree()
    elif isinstance(scene, (str, os.PathLike)):
        source = path_of(scene)
    else:
        raise _core.Error(
            f"expected a Scene or the name of a scene file, got {type(scene).__name__}"
        )
    keys = {**look_keys(**look), "frame": frame}
    keys.update((name, given.pop(name, None)) for name in ("polygons", "trust"))
    options = {**given, "time_limit": time_limit, "partial": partial}
    with reporter(progress) as tick:
        picture, stopped = _wait_for(_core.Rendering(source, keys, options), tick)
        if tick is not None and stopped is None and picture.finished:
            tick.finish()
    if stopped is None or (partial and picture is not None and _is_stop(stopped)):
        return picture
    if isinstance(stopped, KeyboardInterrupt):
        raise Interrupted(picture) from None
    if isinstance(stopped, BaseException):
        raise stopped
    end = "before the first sample" if partial else "first; partial=True gives what there is"
    raise error("time_limit", f"the time limit of {time_limit} s came {end}")


def _wait_for(rendering, tick):
    """A picture or None, and what stopped it: an exception, "time" or None."""
    try:
        while not rendering.wait(tick is not None):
            tick(rendering.share())
    except BaseException as exception:  # of tick, or of a signal meanwhile
        return rendering.stop(), exception
    return rendering.end()


def _is_stop(stopped):
    return stopped == "time" or isinstance(stopped, KeyboardInterrupt)
