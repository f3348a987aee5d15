"""Attributes that are refused when they are set."""

from __future__ import annotations

import math

from . import _core
from ._objects import KINDS, Table, error


class Strict:
    """An object that refuses attributes when they are set: those that its class does not have, and
    wrong values of those for which _checks has a function that takes name and value, and returns
    what is kept."""

    _checks: dict = {}

    def __setattr__(self, name, value):
        check = self._checks.get(name)
        if check is not None:
            value = check(name, value)
        elif not name.startswith("_"):
            known = getattr(type(self), name, None)
            if known is None or callable(known):
                raise AttributeError(no_attribute(self, name))
        object.__setattr__(self, name, value)


def no_attribute(owner, name):
    from difflib import get_close_matches

    cls = type(owner)
    known = {*owner._checks, *(one for one in dir(cls) if not callable(getattr(cls, one)))}
    near = get_close_matches(name, sorted(one for one in known if not one.startswith("_")), 1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return f"{cls.__name__} has no attribute {name!r} that can be set{hint}"


# What checks an attribute of a scene or a group: functions of its name and its value that return
# what is kept. Lists and dictionaries can change afterwards, so the same is asked of them when the
# scene is rendered.


def list_of(key, expected, is_right):
    """Any number of objects, as a list. key: what one of them is called in errors."""

    def check(name, values):
        try:
            listed = values if isinstance(values, list) else list(values)
        except TypeError:
            raise error(name, f"expected a list, got {type(values).__name__}") from None
        for place, one in enumerate(listed):
            if not is_right(one):
                found = type(one).__name__
                raise error(f"{key}[{place}]", f"expected {expected}, got {found}")
        return listed

    return check


def dictionary_of(key, expected, is_right):
    """Objects by name, as a dictionary."""

    def check(name, values):
        try:
            known = values if isinstance(values, dict) else dict(values)
        except (TypeError, ValueError):
            raise error(name, f"expected a dictionary, got {type(values).__name__}") from None
        for one, value in known.items():
            if not isinstance(one, str):
                raise error(name, f"names must be text, got {type(one).__name__}")
            if not is_right(value):
                found = type(value).__name__
                raise error(f"{key}.{one}", f"expected {expected}, got {found}")
        return known

    return check


def is_kind(kind):
    return lambda value: isinstance(value, Table) and value._kind == kind


def one(kind):
    def check(name, value):
        if not is_kind(kind)(value):
            raise error(name, f"expected a {kind}, got {type(value).__name__}")
        return value

    return check


def is_instance(*classes):
    return lambda value: isinstance(value, classes)


def camera(name, value):
    return None if value is None else one("camera")(name, value)


def color(name, value):
    try:
        KINDS["ConstantBackground"](color=value)  # checks it
    except _core.Error as wrong:
        raise error(name, str(wrong).replace(" (key 'color')", "")) from None
    return value


def origin(name, value):
    if isinstance(value, str) and value == "auto":
        return value
    try:
        numbers = [float(x) for x in value] if not isinstance(value, str) else []
    except (TypeError, ValueError, OverflowError):
        numbers = []
    if len(numbers) != 3 or not all(math.isfinite(x) for x in numbers):
        raise error(name, f"expected 'auto' or three finite numbers, got {value!r}")
    return value


def text(name, value):
    if not isinstance(value, str):
        raise error(name, f"must be text, is {type(value).__name__}")
    return value


def text_or_none(name, value):
    return None if value is None else text(name, value)
