"""Copies and pickles of what the compiled part holds: it does not change, so copies share it."""

from __future__ import annotations

import copyreg

from . import _core


def data(state):
    return _core.data_in(state)


def picture(state):
    return _core.picture_in(state)


def _reduce_data(one):
    return data, (_core.data_state(one),)


def _reduce_picture(one):
    return picture, (_core.picture_state(one),)


def _same(self, memo=None):
    return self


def install():
    for cls, reduce in ((_core.Data, _reduce_data), (_core.Picture, _reduce_picture)):
        copyreg.pickle(cls, reduce)
        cls.__copy__ = cls.__deepcopy__ = _same
