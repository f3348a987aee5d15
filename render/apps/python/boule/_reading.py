"""From what was read to a Scene."""

from __future__ import annotations

from . import _objects as objects
from ._core import Data
from ._scene import Capsules, Group, Scene, Spheres

_CLASSES = {
    kind: {cls._type: cls for cls in vars(objects).values() if getattr(cls, "_kind", "") == kind}
    for kind in ("camera", "background", "material", "light")
}


def _object(kind, values):
    """The object of a table with a type."""
    keys = dict(values)
    cls = _CLASSES[kind][keys.pop("type")]
    return _made(cls, keys)


def _made(cls, keys):
    """An object of keys that were read, and so are right."""
    if isinstance(keys.get("file"), Data):
        keys = {cls._array if name == "file" else name: value for name, value in keys.items()}
    made = cls.__new__(cls)
    made.__setstate__(keys)
    return made


def _camera(values):
    if values is None:
        return None
    keys = dict(values)
    if "distortion" in keys:
        keys["distortion"] = _made(objects.Distortion, keys["distortion"])
    if keys.pop("fit", False):
        return _made(objects.Fit, keys)
    return _object("camera", keys)


def _fill(target, values):
    """Gives a scene or a group its objects."""
    if values["spheres"] is not None:
        target.spheres.append(Spheres._of(values["spheres"]))
    target.planes = [_made(objects.Plane, keys) for keys in values["planes"]]
    if values["capsules"] is not None:
        target.capsules.append(Capsules._of(values["capsules"]))
    target.instances = [_made(objects.Instance, keys) for keys in values["instances"]]


def scene_of(values):
    """A scene of what _core.read() returns."""
    scene = Scene(
        image=_made(objects.ImageSettings, values["image"]),
        render=_made(objects.RenderSettings, values["render"]),
        camera=_camera(values["camera"]),
        background=_object("background", values["background"]),
        ambient=values["ambient"],
        backdrop=values["backdrop"],
        materials={name: _object("material", keys) for name, keys in values["materials"]},
        lights=[_object("light", keys) for keys in values["lights"]],
        clips=[_made(objects.Clip, keys) for keys in values["clips"]],
        origin=values["origin"],
    )
    _fill(scene, values)
    for name, group in values["groups"]:
        _fill(scene.groups.setdefault(name, Group(name)), group)
    scene.notes = values["notes"]
    scene.warnings = values["warnings"]
    scene.legend = values["legend"]
    return scene
