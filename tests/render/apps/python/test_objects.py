"""Objects of a scene one by one: what their keys and attributes hold, and what is refused."""

import inspect

import numpy as np
import pytest

import boule
from boule import _core

EYE = {"eye": (0, 0, 5), "look_at": (0, 0, 0)}
PLANOCONVEX = [[40, 6, 1.5, 20], [0, 30, 1, 20]]
BICONVEX = [[40, 6, 1.5, 20], [-40, 30, 1, 20]]


def refused(call, key=None):
    """The message of the Error that a call raises; its key must be this one."""
    with pytest.raises(boule.Error) as caught:
        call()
    assert caught.value.key == key
    return str(caught.value)


def test_keys_of_a_camera_lose_nothing():
    camera = boule.Pinhole(**EYE, fov=30)
    for key in ("fov", "eye", "look_at"):
        value = 90 if key == "fov" else (1, 2, 3)
        told = refused(lambda: setattr(camera, "key", [{"frame": 0, key: value}]), key)
        assert "in one of them" in told
    camera.key = None
    assert (camera.fov, camera.eye, camera.look_at) == (30, (0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
    moving = boule.Pinhole(look_at=(0, 0, 0), key=[{"frame": 0, "eye": (0, 0, 5), "fov": 90}])
    refused(lambda: setattr(moving, "fov", 30), "fov")
    moving.fov_axis = "y"
    assert moving.fov_axis == "y" and moving.eye is None and moving.fov == 45
    assert moving.key == ({"frame": 0, "eye": (0, 0, 5), "fov": 90},)


@pytest.mark.parametrize(
    "keys, key, words",
    [
        ([{"fov": 90}], "key[0].frame", "missing key 'frame'"),
        ([{"frame": 3, "fov": 90}, {"frame": 3, "fov": 80}], "key[1].frame", "must be above 3"),
        ([{"frame": 0, "fov": 90}, {"frame": 9, "fov": 200}], "fov", "in frame 9"),
        ([{"frame": 0, "fov": 90, "height": 1}], "key[0].height", "height"),
        ([{"frame": 0, "aperture": 1}], "aperture", "aperture"),
        ([], "key", "at least one"),
        (3, "key", "expected a list of dictionaries"),
        ([3], "key", "expected a list of dictionaries"),
    ],
)
def test_camera_keys_are_checked_when_set(keys, key, words):
    camera = boule.Pinhole(**EYE)
    assert words in refused(lambda: setattr(camera, "key", keys), key)
    assert camera == boule.Pinhole(**EYE)


def test_a_fitted_camera_does_not_move():
    assert "'fit'" in refused(lambda: boule.Fit(key=[{"frame": 0, "fov": 3}]), "key")


@pytest.mark.parametrize(
    "make, name, shape",
    [
        (lambda **keys: boule.EnvironmentBackground(**keys), "pixels", (3, 4, 3)),
        (lambda **keys: boule.Distortion(**keys), "st", (3, 4, 2)),
        (lambda **keys: boule.Lens(**EYE, **keys), "surfaces", (2, 4)),
    ],
)
def test_arrays_in_place_of_files_are_attributes(make, name, shape):
    first = np.arange(float(np.prod(shape))).reshape(shape)
    second = first / 2
    if name == "surfaces":
        first, second = np.asarray(PLANOCONVEX), np.asarray(BICONVEX)
    made = make(**{name: first})
    held = getattr(made, name)
    assert held.dtype == np.float32 and np.array_equal(held, first) and made.file is None
    with pytest.raises(ValueError):
        held[0] = 1
    setattr(made, name, second)
    assert np.array_equal(getattr(made, name), second) and np.array_equal(held, first)
    assert "cannot stand beside 'file'" in refused(lambda: setattr(made, "file", "a.exr"), name)
    assert "missing key 'file', or" in refused(lambda: setattr(made, name, None), "file")
    assert f"or '{name}'" in refused(make, "file")
    bad = np.where(np.arange(first.size).reshape(first.shape) == 2, np.nan, first)
    told = refused(lambda: make(**{name: bad}), name)
    assert "array" not in told
    assert np.array_equal(getattr(made, name), second)


def test_arrays_that_were_read_are_attributes(tmp_path, scenes):
    lens = boule.Lens(**EYE, file=str(scenes / "double_gauss_50mm.lens"))
    assert lens.surfaces is None
    scene = boule.Scene(camera=lens)
    scene.add_sphere()
    path = tmp_path / "lens.toml"
    path.write_text(
        "schema = 1\n[[sphere]]\n[camera]\ntype = \"lens\"\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
        f"file = \"{scenes / 'double_gauss_50mm.lens'}\"\n"
    )
    read = boule.load(path)
    assert read.camera.file is None and read.camera.surfaces.shape[1] == 4
    told = np.asarray(boule.render(scene, size=(16, 12)))
    assert np.array_equal(np.asarray(boule.render(read, size=(16, 12))), told)
    read.camera.surfaces = read.camera.surfaces
    assert np.array_equal(np.asarray(boule.render(read, size=(16, 12))), told)


REQUIRED = {
    "ThinLens": ["eye", "look_at", "aperture"],
    "Lens": ["eye", "look_at", "file"],
    "EnvironmentBackground": ["file"],
    "Distortion": ["file"],
    "Instance": ["group"],
    "Particles": ["file"],
}


TABLES = [name for name in boule.__all__ if hasattr(getattr(boule, name), "_kind")]


@pytest.mark.parametrize("name", TABLES)
def test_help_tells_which_keys_are_required(name):
    cls = getattr(boule, name)
    of_kind = ["eye", "look_at"] if cls._kind == "camera" and cls is not boule.Fit else []
    required = REQUIRED.get(name, of_kind)
    if required:
        assert "missing key" in str(pytest.raises(boule.Error, cls).value)
    else:
        cls()
    needed, _, defaults = cls.__doc__.partition("Keys and their defaults: ")
    for key in required:
        assert key in needed.partition("Required: ")[2]
        assert key == "file" or f"{key}=" not in defaults
        assert inspect.signature(cls).parameters[key].default is None
    assert ("Required: " in needed) == bool(required)


def test_range_of_spheres_is_read_only():
    spheres = boule.Spheres(np.zeros((3, 3)), 1, scalar=[1, 2, 3], range=(0, 4))
    assert spheres.range == [0, 4]
    with pytest.raises(AttributeError):
        spheres.range = (0, 100)
    spheres.range[0] = 7
    assert spheres.range == [0, 4]
    assert boule.Spheres(np.zeros((3, 3)), 1).range is None


def test_sphere_colours_are_checked_when_set():
    centers = np.zeros((1, 3))
    spheres = boule.Spheres(centers, 1, color="#ff0000", material="red")
    assert "is no colour" in refused(lambda: setattr(spheres, "color", "zz"), "color")
    assert "got int" in refused(lambda: setattr(spheres, "material", 3), "material")
    assert (spheres.color, spheres.material) == ("#ff0000", "red")
    assert "got int" in refused(lambda: boule.Spheres(centers, 1, material=3), "material")
    spheres.color, spheres.material = (0, 1, 0), boule.Metal()
    assert spheres.color == (0, 1, 0) and spheres.material == boule.Metal()


def test_radius_below_float_is_too_small():
    for call in (boule.Spheres, boule.Tracer):
        told = refused(lambda: call(np.zeros((1, 3)), 1e-46), "radii")
        assert "row 0: is too small for a 32-bit float: 1e-46" in told
    assert boule.Spheres(np.zeros((1, 3)), 1e-45).radii[0] > 0


def test_objects_that_only_calls_make():
    scene = boule.Scene()
    scene.add_sphere()
    picture = boule.render(scene, size=(4, 3))

    class Own(boule.Picture):
        pass

    for cls in (boule.Picture, Own, _core.Data):
        for make in (cls, lambda: cls.__new__(cls), lambda: object.__new__(cls)):
            with pytest.raises(TypeError):
                make()
    # Those that Python may make have no value, and say so.
    for cls, read in ((_core.Tracer, "stats"), (_core.Series, "read")):
        with pytest.raises((RuntimeError, TypeError)):
            getattr(cls.__new__(cls), read)()
    assert "4 x 3" in repr(picture)


def test_every_keyword_argument_is_an_attribute():
    for name in TABLES:
        for key in inspect.signature(getattr(boule, name)).parameters:
            assert isinstance(getattr(getattr(boule, name), key), property), (name, key)
