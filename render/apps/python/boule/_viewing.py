"""The page of `boule view` from Python: in a cell of a notebook, or in a browser."""

from __future__ import annotations

import html
import os
import pathlib
import shutil
import subprocess
import tempfile
import weakref
import webbrowser

from ._core import Error
from ._objects import error, path_of
from ._scene import Scene
from ._sources import given_of, load, particles_of, with_look

_FRAME = (
    '<iframe src="{url}" title="{title}" width="100%" height="{height}" style="border: 0" '
    'allow="fullscreen; clipboard-write"></iframe>'
)


class View:
    """A server of `boule view`, which ends with close(), at the end of a with block, or with Python.

    url: the address of its page, for browsers on this machine. notes: what the program has said. In
    a notebook the last value of a cell shows the page.
    """

    def __init__(self, process, url, notes, title, height, folder):
        self.url, self.notes = url, notes
        self._title, self._height = title, height
        self._end = weakref.finalize(self, _end, process, folder)

    def close(self):
        """Ends the server."""
        self._end()

    def open(self):
        """Opens the page in your browser; False if there is none."""
        return webbrowser.open(self.url)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return f"<boule.View of {self._title}: {self.url if self._end.alive else 'closed'}>"

    def _repr_html_(self):
        if not self._end.alive:
            return html.escape(repr(self))
        return _FRAME.format(
            url=html.escape(self.url), title=html.escape(self._title), height=self._height
        )


@with_look()
def view(scene, *, size=None, spp=None, frames=None, threads=None, height=640, **look):
    """Shows a scene in a page that you turn with the mouse: in a notebook, as the last value of a
    cell, or in a browser, by View.open(). Needs the program, which wheels have inside.

    scene: a Scene, atoms as for load(), or the name of a file that `boule view` opens: scenes,
        packed ones, particles; of a trajectory you get all frames with a time line.
    size: (width, height) in pixels of the picture at rest. spp: its samples per pixel.
    frames: a range of frames: of files whose names have #### for the number.
    threads: 0: as many as the process can run at once. height: of the cell, in pixels.
    look: for files of particles, as for load().

    The page belongs to this machine. If your notebook's browser runs on another one, make its port,
    which is in View.url, known there: ssh -L PORT:127.0.0.1:PORT, or port forwarding of your editor.
    Raises boule.Error if the program says no.
    """
    if isinstance(height, bool) or not isinstance(height, int) or height < 1:
        raise error("height", f"expected a number of pixels, got {height!r}")
    if frames is not None and not isinstance(frames, range):
        raise error("frames", f"expected a range of frames, got {frames!r}")
    options = _options(size=size, spp=spp, threads=threads)
    if particles_of(scene) is not None:
        scene, look = load(scene, **look), {}
    if isinstance(scene, Scene) and (frames is not None or given_of(look)):
        name = "frames" if frames is not None else next(iter(given_of(look)))
        raise error(name, "is of files, and the scene is none")
    folder = tempfile.TemporaryDirectory(prefix="boule-")
    try:
        if isinstance(scene, Scene):
            path = os.path.join(folder.name, "scene.boule")
            scene.save(path)
            title = "a scene"
        else:
            path = title = os.fsdecode(path_of(scene, "scene"))
            options += _options(**look)
            if frames is not None:
                options += ["--frames", f"{frames.start}-{frames.stop - 1}:{frames.step}"]
        return _start(path, options, title, height, folder)
    except BaseException:
        folder.cleanup()
        raise


def _program():
    """The program: of this package, of its build folder, or the installed one."""
    package = pathlib.Path(__file__).parent
    for file in (package / "bin" / "boule", package.parent / "bin" / "boule"):
        if file.exists():
            return str(file)
    found = shutil.which("boule")
    if found is None:
        raise Error("the program boule is not installed, which shows scenes (Debian: boule)")
    return found


def _options(**given):
    """The words of the command line that say so."""
    return [word for name, value in given.items() for word in _option(name, value)]


def _option(name, value):
    option = "--" + name.replace("_", "-")
    if value is None or value is False:
        return []
    if value is True:
        return [option]
    between = "x" if name in ("size", "replicate") else ","
    if isinstance(value, dict):
        text = between.join(f"{key}={one}" for key, one in value.items())
    elif isinstance(value, str) or not hasattr(value, "__iter__"):
        text = str(value)
    else:
        text = between.join(str(one) for one in value)
    return [f"{option}={text}"]


def _start(path, options, title, height, folder):
    said = pathlib.Path(folder.name) / "notes"
    with open(said, "wb") as notes:
        # A session of its own: Ctrl-C in a cell is none of its business.
        process = subprocess.Popen(
            [_program(), "view", "--embed", "--idle", "1h", *options, "--", path],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=notes, text=True,
            start_new_session=True,
        )  # fmt: skip
    try:
        url = process.stdout.readline().strip()
    except BaseException:
        _end(process, folder)
        raise
    lines = said.read_text(errors="replace").splitlines()
    if not url:
        _end(process, folder)
        raise Error("\n".join(line.removeprefix("boule: ") for line in lines) or "no page is there")
    return View(process, url, lines, title, height, folder)


def _end(process, folder):
    process.terminate()
    try:
        process.wait(5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    process.stdout.close()
    folder.cleanup()
