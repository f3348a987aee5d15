"""What a scene holds in lists and dictionaries: their types, names, objects of derived classes."""

import copy

import numpy as np
import pytest

import boule


@pytest.mark.parametrize("name", [
    "lights", "clips", "spheres", "planes", "capsules", "instances", "materials", "groups"])  # fmt: skip
@pytest.mark.parametrize("value", [None, 3])
def test_a_list_that_is_none_is_refused(ball, name, value):
    before = getattr(ball, name)
    with pytest.raises(boule.Error, match="expected a (list|dictionary)") as caught:
        setattr(ball, name, value)
    assert caught.value.key == name and getattr(ball, name) is before
    if value is not None:
        with pytest.raises(boule.Error) as caught:
            boule.Scene(**{name: value})
        assert caught.value.key == name


def test_names_may_be_empty_or_missing(ball):
    twice = [(-1, 0.5, 0), (1, 0.5, 0)]
    named = copy.copy(ball)
    named.instances = []
    for place in twice:
        named.add_group(str(place)).add_sphere(center=place, radius=0.5)
        named.add_instance(str(place), translate=(0, 0, 1))
    told = np.asarray(boule.render(named))
    ball.groups, ball.instances = {}, []
    for place in twice:
        group = boule.Group()
        group.add_sphere(center=place, radius=0.5)
        ball.add_instance(group, translate=(0, 0, 1))
    assert np.array_equal(np.asarray(boule.render(ball)), told)
    assert boule.Tracer(ball).closest((-1, 9, 1), (0, -1, 0)).t[0] == 8
    assert ball.groups == {}
    ball.groups[""] = ball.instances[0].group
    ball.materials[""] = boule.Matte()
    ball.instances[0].group = ""
    assert np.array_equal(np.asarray(boule.render(ball)), told)
    with pytest.raises(boule.Error, match="must be text, is int") as caught:
        ball.add_instance(boule.Group(3))
    assert caught.value.key == "name"
    ball.add_instance(boule.Group(None))
    assert np.array_equal(np.asarray(boule.render(ball)), told)
    with pytest.raises(boule.Error, match="must be text, is int"):
        ball.instances[-1].group.name = 3


WRONG_VALUES = {
    "image": [None, 3, boule.Sphere()],
    "render": [None, "path", boule.ImageSettings()],
    "camera": [3, "pinhole", boule.Matte()],
    "background": [None, "#ffffff", boule.Matte()],
    "ambient": ["dark", 3, (1, 2), (-1, 0, 0), (0, 0, float("nan"))],
    "backdrop": ["dark", (1, 2, 3, 4), {}],
    "materials": [[1], {"a": 3}, {3: boule.Matte()}, {"a": boule.Sphere()}],
    "lights": [3, [3], boule.PointLight(position=(0, 0, 0)), [boule.Sphere()]],
    "clips": [3, boule.Clip(), [boule.Plane()]],
    "spheres": [boule.Sphere(), [boule.Plane()], [[0, 0, 0, 1]]],
    "planes": [boule.Plane(), [boule.Sphere()]],
    "capsules": [boule.Capsule(), [boule.Sphere()], [[0, 0, 0, 1, 1, 1, 1]]],
    "groups": [{"a": 3}, [boule.Group("a")]],
    "instances": [["a"], [boule.Group("a")]],
    "origin": ["moon", 3, (1, 2), (1, 2, 3, 4), (0, 0, float("inf")), ("1", "a", 2), None],
    "notes": [3, [3]],
    "warnings": [None],
    "legend": [None, 3],
}


@pytest.mark.parametrize("name", WRONG_VALUES)
def test_wrong_scene_value_is_refused_when_set(ball, name):
    before = getattr(ball, name)
    for value in WRONG_VALUES[name]:
        with pytest.raises(boule.Error) as caught:
            setattr(ball, name, value)
        assert caught.value.key.startswith(name.rstrip("s")), value
        assert getattr(ball, name) is before
    setattr(ball, name, before)
    assert boule.render(ball, size=(4, 3)).finished


@pytest.mark.parametrize(
    "make, wrong, right",
    [
        (boule.Scene, "camrea", "camera"),
        (boule.Scene, "light", "lights"),
        (boule.Scene, "add_spheres", None),
        (boule.Group, "sphere", "spheres"),
        (boule.Group, "camera", None),
        (lambda: boule.Spheres([[0, 0, 0]], 1), "colour", "color"),
        (lambda: boule.Spheres([[0, 0, 0]], 1), "radius", "radii"),
        (lambda: boule.Capsules([[0, 0, 0]], [1, 0, 0], 1), "radii", "radius"),
        (lambda: boule.Tracer([[0, 0, 0]], 1), "solver", None),
        (lambda: boule.render(boule.Scene(), size=(4, 3)), "exposure", None),
    ],
)
def test_unknown_attribute_is_refused(make, wrong, right):
    made = make()
    with pytest.raises(AttributeError, match=wrong) as caught:
        setattr(made, wrong, getattr(made, wrong, 1))
    if right:
        assert f"did you mean {right!r}?" in str(caught.value)


def test_values_from_arrays_are_read_only():
    spheres = boule.Spheres([[0, 0, 0]], 1)
    for name in ("centers", "radii", "colors", "range"):
        with pytest.raises(AttributeError):
            setattr(spheres, name, getattr(spheres, name))
    capsules = boule.Capsules([[0, 0, 0]], (1, 0, 0), 1)
    for name in ("a", "b", "radius", "colors", "range"):
        with pytest.raises(AttributeError):
            setattr(capsules, name, getattr(capsules, name))


def test_a_list_stays_the_callers_own(ball):
    lights = [boule.PointLight(position=(1, 2, 3))]
    ball.lights = lights
    assert ball.lights is lights
    ball.planes = (plane for plane in [boule.Plane()])
    assert ball.planes == [boule.Plane()]


def test_classes_may_be_derived_from(ball):
    classes = (boule.Sphere, boule.Spheres, boule.Plane, boule.Plastic, boule.Scene, boule.Group)
    sphere, spheres, plane, plastic, scene, group = (type("My", (cls,), {}) for cls in classes)
    made = scene(camera=ball.camera, lights=ball.lights, image=ball.image)
    made.spheres = [sphere(center=(0, 1, 0), material=plastic(color="#c83214"))]
    made.planes = [plane()]
    assert np.array_equal(np.asarray(boule.render(made)), np.asarray(boule.render(ball)))
    for one in (made, ball):
        one.spheres.append((spheres if one is made else boule.Spheres)([[1, 1, 1]], 0.5))
        one.add_instance((group if one is made else boule.Group)("g"))
    assert np.array_equal(np.asarray(boule.render(made)), np.asarray(boule.render(ball)))
