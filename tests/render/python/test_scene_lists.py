"""What a scene holds in lists and dictionaries: their types, names, objects of derived classes."""

import copy

import numpy as np
import pytest

import boule


@pytest.mark.parametrize("name", [
    "lights", "spheres", "planes", "instances", "materials", "groups"])  # fmt: skip
@pytest.mark.parametrize("value", [None, 3])
def test_a_list_that_is_none_is_an_error(ball, name, value):
    setattr(ball, name, value)
    for call in (boule.render, boule.Tracer):
        with pytest.raises(boule.Error, match="expected a (list|dictionary)") as caught:
            call(ball)
        assert caught.value.key == name
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
    with pytest.raises(boule.Error) as caught:
        ball.add_instance(boule.Group(3))
    assert caught.value.key == "group"
    ball.add_instance(boule.Group(None))
    assert np.array_equal(np.asarray(boule.render(ball)), told)
    ball.instances[-1].group.name = 3
    with pytest.raises(boule.Error, match="must be text, is int"):
        boule.render(ball)


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
