"""What a scene is made of, by the keys of scene files.

Every class here has the keys of one table of a scene file (docs/scene_format.md) as its keyword
arguments and attributes, with the same defaults. Values are checked as they are set, by the reader
of scene files: what it refuses is a boule.Error. The classes and their arguments come from the one
list of fields that the library has.
"""

from __future__ import annotations

import inspect
import os

from . import _core

_FIELDS = _core.fields()
# Keys that stand for a field in another way, or that the table has besides its fields.
_MORE = {
    "camera": ("distortion", "key"),  # of all kinds
    "thin_lens": ("f_number", "focal_length"),
    "lens": ("surfaces", "f_number"),
    "environment": ("pixels",),
    "distortion": ("st",),
    "fit": ("distortion",),
    "sphere": ("color",),
    "plane": ("color",),
    "capsule": ("color",),
    "particles": (
        "file", "frame", "format", "columns", "water", "topology", "radius", "radii", "scale",
        "color", "colors", "nan_color", "outline_by", "style", "bonds", "bond_radius", "bond_color",
        "cell_edges", "axes", "arrows", "arrow_scale", "select", "ghost", "opacity", "labels", "label_text", "wrap",
        "unwrap", "boundary",
        "replicate", "material",
    ),
}  # fmt: skip
# Arrays that take the place of a file: how many numbers each element has, and what makes data of
# them.
_ARRAYS = {
    "pixels": (3, lambda value: _core.picture(value, "pixels", 3)),
    "st": (2, lambda value: _core.picture(value, "st", 2)),
    "surfaces": (4, _core.lens),
}
# Keys without which there is no such object, and what is said of them.
_REQUIRED = {
    "camera": (("eye", "look_at"), "eye and look_at, each here or in key"),
    "thin_lens": (
        ("eye", "look_at", "aperture"),
        "eye, look_at and aperture, each here or in key; or f_number with focal_length in place "
        "of aperture",
    ),
    "lens": (("eye", "look_at"), "eye and look_at, each here or in key; file or surfaces"),
    "environment": ((), "file or pixels"),
    "distortion": ((), "file or st"),
    "instance": (("group",), "group"),
    "particles": (("file",), "file"),
}


def error(key, message):
    """A boule.Error about a key."""
    made = _core.Error(f"{message} (key '{key}')")
    made.key = key
    return made


def path_of(name, key="source"):
    """The bytes of a file's name, which need not be text."""
    try:
        path = os.fsencode(name)
    except UnicodeEncodeError:
        raise error(key, "is no name of a file") from None
    if b"\0" in path:
        raise error(key, "is no name of a file: it has a NUL")
    return path


class Table:
    """A table of a scene file. Each key is an attribute; None stands for one that is not given."""

    _kind = ""
    _type = ""
    _array = None  # the key that has an array in place of 'file', if any
    _defaults: dict = {}

    def __init__(self, **keys):
        object.__setattr__(self, "_keys", self._checked(keys))

    @classmethod
    def _checked(cls, keys):
        """The keys with plain values, if the reader of scene files takes them."""
        keys = {name: value for name, value in keys.items() if value is not None}
        array = cls._array
        if array in keys:
            if "file" in keys:
                raise error(array, "cannot stand beside 'file'")
            if not isinstance(keys[array], _core.Data):
                keys[array] = _ARRAYS[array][1](keys[array])
        moves = keys.get("key", ())
        if not isinstance(moves, (list, tuple)) or not all(isinstance(one, dict) for one in moves):
            raise error("key", "expected a list of dictionaries, each with 'frame'")
        plain = _core.check(cls._kind, cls._table_of(keys, _short_name), array or "")
        return {name: _kept(name, value, plain) for name, value in keys.items()}

    @classmethod
    def _table_of(cls, keys, names):
        """The keys as a scene file has them. `names` gives materials and groups their names."""
        table = {} if cls._type == "" else {"type": cls._type}
        for name, value in keys.items():
            if isinstance(value, Table) and name == "distortion":
                value = value._table(names)
            elif name in ("material", "group") and not isinstance(value, str):
                value = names(name, value)
            table["file" if name == cls._array else name] = value
        return table

    def _table(self, names):
        return self._table_of(self._keys, names)

    def __setattr__(self, name, value):
        if name not in self._defaults:
            self._checked({**self._keys, name: value})
            raise AttributeError(f"{type(self).__name__} has no key {name!r}")
        object.__setattr__(self, "_keys", self._checked({**self._keys, name: value}))

    def __eq__(self, other):
        return type(self) is type(other) and self._keys == other._keys

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __getstate__(self):
        return self._keys

    def __setstate__(self, keys):
        object.__setattr__(self, "_keys", keys)

    def __repr__(self):
        keys = ", ".join(f"{name}={value!r}" for name, value in self._keys.items())
        return f"{type(self).__name__}({keys})"


def _short_name(kind, value):
    """A name for what is checked without its scene."""
    if isinstance(value, Table) and value._kind == "material":
        return "a material"
    if kind == "group" and hasattr(value, "name"):
        return value.name or "a group"
    raise error(kind, f"expected a name or a {kind}, got {type(value).__name__}")


def _kept(name, value, plain):
    """What a table keeps of a value: objects as they are, all others as plain values."""
    is_object = isinstance(value, (Table, _core.Data)) or name in ("material", "group")
    return value if is_object else plain.get(name, value)


def _property(name, default, is_required):
    def get(self):
        return self._keys.get(name, default)

    def set(self, value):
        self.__setattr__(name, value)

    return property(get, set, doc="required" if is_required else f"default: {default!r}")


def _array_property(name):
    def get(self):
        data = self._keys.get(name)
        return None if data is None else _core.array_of(data, _ARRAYS[name][0])

    def set(self, value):
        self.__setattr__(name, value)

    return property(get, set, doc="float32, a read-only view; None where file is given")


def _defaults_of(kind, type_name):
    defaults = {}
    for name, default, of_file in _FIELDS.get(kind, {}).get(type_name, ()):
        if name == "size" and of_file:
            continue  # that of the file
        defaults[name] = default
    for name in (*_MORE.get(type_name, ()), *(_MORE["camera"] if kind == "camera" else ())):
        defaults.setdefault(name, None)
    for name in _required(kind, type_name)[0]:
        defaults[name] = None
    return defaults


def _required(kind, type_name):
    """The keys without which there is no such object, and what is said of them."""
    return _REQUIRED.get(type_name) or _REQUIRED.get(kind, ((), ""))


def _fill(cls, kind, type_name, type_key):
    """Gives a class its keys."""
    defaults = _defaults_of(kind, type_name)
    required, told = _required(kind, type_name)
    cls._kind = "camera" if kind == "fit" else kind
    cls._type = type_name if type_key else ""
    cls._defaults = defaults
    for name, default in defaults.items():
        if name in _ARRAYS:
            cls._array = name
            setattr(cls, name, _array_property(name))
        else:
            setattr(cls, name, _property(name, default, name in required))
    parameters = [inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)] + [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default)
        for name, default in defaults.items()
    ]

    def __init__(self, **keys):
        Table.__init__(self, **keys)

    __init__.__signature__ = inspect.Signature(parameters)
    cls.__init__ = __init__
    shown = ", ".join(f"{n}={default!r}" for n, default in defaults.items() if n not in required)
    needed = f"\n\nRequired: {told}." if told else ""
    cls.__doc__ = (
        f"{inspect.cleandoc(cls.__doc__ or '')}{needed}\n\nKeys and their defaults: {shown}"
    )
    cls.__module__ = "boule"
    return cls


def _of(kind, type_name, type_key=True):
    return lambda cls: _fill(cls, kind, type_name, type_key)


# What the kinds of a table are; one that is not here has the name of its type.
_ABOUT = {
    "material": {
        "matte": "Ideally diffuse.",
        "plastic": "Diffuse with a white highlight and, where reflect > 0, a mirror image.",
        "metal": "A coloured mirror.",
        "glass": "Mirrors and refracts; color tints each crossing, ior is the index of refraction.",
        "emissive": "Radiates on both sides, reflects nothing.",
        "ghost": "A thin film that only the camera sees: you see through it.",
        "phong": "Whitted's model as it stands: ka, kd, ks, shininess, transmission, ior.",
    },
    "camera": {
        "pinhole": "All rays from the eye; fov in degrees, above 0, below 180.",
        "orthographic": "All rays along the view; height of the picture in world units, above 0.",
        "fisheye": "All rays from the eye, equidistant in angle; fov in degrees, up to 360.",
        "thin_lens": (
            "A pinhole opened to a disc: aperture is its radius in world units (or f_number with\n"
            "focal_length); focus is the distance that is sharp, or a point that is."
        ),
        "lens": (
            "A lens of real elements: file names its prescription, or surfaces has it, N x 4:\n"
            "radius, thickness, index, aperture."
        ),
    },
    "background": {
        "constant": "One colour in all directions.",
        "gradient": "From bottom to top, with the mean of both at the horizon.",
        "environment": (
            "A latitude-longitude picture of everything around: file names it, or pixels has it,\n"
            "H x W x 3, linear; its top row is up (+y). rotation in degrees to the right."
        ),
    },
    "light": {
        "point": "Light from a point in all directions.",
        "directional": "Light from infinitely far away; direction is the way it travels.",
        "sphere": (
            "A sphere that radiates alike in all directions. It is no object: rays pass through it."
        ),
    },
}


def _classes_of_kinds():
    """Matte, ThinLens, ConstantBackground, PointLight and so on: a class for each kind of a table."""
    made = {}
    for kind, about in _ABOUT.items():
        ending = kind.title() if kind in ("background", "light") else ""
        for type_name in _FIELDS[kind]:
            name = type_name.title().replace("_", "") + ending
            doc = about.get(type_name, f"The {kind} {type_name!r} of scene files.")
            made[name] = _fill(type(name, (Table,), {"__doc__": doc}), kind, type_name, True)
    return made


KINDS = _classes_of_kinds()
globals().update(KINDS)


@_of("fit", "fit", type_key=False)
class Fit(Table):
    """A camera that is fitted to the spheres: the tightest picture in which all of them lie."""

    @classmethod
    def _table_of(cls, keys, names):
        return {"fit": True, **super()._table_of(keys, names)}


@_of("distortion", "distortion", type_key=False)
class Distortion(Table):
    """An ST map, by which a camera's picture is bent: file names a picture, or st has the numbers,
    H x W x 2 of float32 or float64."""


@_of("image", "image", type_key=False)
class ImageSettings(Table):
    """The picture that a scene asks for: size in pixels (width, height), samples per pixel."""


@_of("render", "render", type_key=False)
class RenderSettings(Table):
    """How a scene asks to be rendered: method "whitted" or "path", max_depth bounces;
    noise, if it is above 0, is asked of each pixel, which gets min_spp samples or more; aa, if it is
    above 0, is the step in codes of 255 above which pixels get more than one sample; rays whose
    weights add up to least_weight are left out."""


@_of("sphere", "sphere", type_key=False)
class Sphere(Table):
    """One sphere. material is a material or the name of one; color replaces its colour."""


@_of("plane", "plane", type_key=False)
class Plane(Table):
    """An infinite plane through point; normal points to its outside."""


@_of("capsule", "capsule", type_key=False)
class Capsule(Table):
    """All points within radius of the segment from a to b; a sphere if they are equal."""


@_of("clip", "clip", type_key=False)
class Clip(Table):
    """A plane through point that cuts spheres and capsules in pictures: normal points to what is
    taken away. Each cut is closed by a flat cap."""


@_of("instance", "instance", type_key=False)
class Instance(Table):
    """A copy of a group, which is scaled, then rotated (degrees about x, y, z), then moved."""


@_of("particles", "particles", type_key=False)
class Particles(Table):
    """The particles of a file, as [[particles]] of a scene file reads them."""


__all__ = [name for name, one in list(globals().items()) if getattr(one, "_kind", "")]
