"""Bars that show how far a render is."""

from __future__ import annotations

import contextlib
import sys
import warnings

from ._objects import error


class _Bar:
    """A bar of our own: one line on standard error."""

    width = 40

    def __init__(self):
        self._shown = ""

    def show(self, share):
        full = int(share * self.width)
        text = f"\rrendering [{'#' * full}{'.' * (self.width - full)}] {int(share * 100):3d} %"
        if text != self._shown:
            sys.stderr.write(text)
            sys.stderr.flush()
            self._shown = text

    def close(self):
        sys.stderr.write("\n")
        sys.stderr.flush()


class _Tqdm:
    """The bar of tqdm, which notebooks show as a widget."""

    def __init__(self, tqdm):
        self._bar = tqdm(total=100, desc="rendering", unit="%", leave=False)

    def show(self, share):
        self._bar.update(int(share * 100) - self._bar.n)

    def close(self):
        self._bar.close()


def _open_bar():
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it warns where widgets are missing
            from tqdm.auto import tqdm  # type: ignore[import]
    except ImportError:
        return _Bar()
    return _Tqdm(tqdm)


class _Tick:
    """Passes on the share that is done; None, while the scene is prepared, is 0. All of it is told
    once, by finish()."""

    def __init__(self, show):
        self._show = show

    def __call__(self, share):
        if share is None or share < 1:
            self._show(0.0 if share is None else share)

    def finish(self):
        self._show(1.0)


@contextlib.contextmanager
def reporter(progress):
    """A _Tick for what progress asks for, or None."""
    if progress is None or progress is False:
        yield None
    elif callable(progress):
        yield _Tick(progress)
    elif progress is True:
        bar = _open_bar()
        try:
            yield _Tick(bar.show)
        finally:
            bar.close()
    else:
        raise error("progress", f"expected True, False or a function, got {progress!r}")
