"""Capsules: arrays to hits and pictures, what is refused, and reading them back."""

import copy
import pickle

import numpy as np
import pytest

import boule

A = np.array([[-1, 0, 0], [0, 2, 0], [3, -1, 1]], np.float64)
B = np.array([[1, 0, 0], [0, 2, 0], [3, 1, 1]], np.float64)
R = np.array([0.5, 0.25, 0.125], np.float32)


def lit(scene):
    scene.camera = boule.Pinhole(eye=(0, 1, 8), look_at=(0, 0.5, 0))
    scene.lights.append(boule.PointLight(position=(3, 6, 5)))
    scene.image.size = (64, 48)
    return scene


def picture(scene):
    pixels = np.asarray(boule.render(scene))
    assert pixels.any()
    return pixels


def test_hits_are_those_of_the_formula():
    scene = boule.Scene()
    scene.add_sphere(center=(0, 0, -20))
    scene.add_plane(point=(0, -9, 0))
    scene.add_capsules(A, B, R)
    tracer = boule.Tracer(scene)
    hits = tracer.closest([[0.5, 0.5, 9], [0, 2, 9], [3, 0.5, 9], [3, 1.1, 9]], (0, 0, -1))
    assert hits.id.tolist() == [2, 3, 4, 4]
    assert hits.t[:3].tolist() == [9, 8.75, 7.875]
    assert hits.t[3] == pytest.approx(8 - (0.125**2 - 0.1**2) ** 0.5, rel=1e-9)
    assert np.allclose(hits.normal[:3], [[0, 1, 0], [0, 0, 1], [0, 0, 1]], atol=1e-6)
    assert hits.entering.all()
    assert tracer.chord((-9, 0, 0), (1, 0, 0)).tolist() == [3]
    assert tracer.count((-9, 0, 0), (1, 0, 0)).tolist() == [2]
    chords = tracer.chord((-9, 0, 0), (1, 0, 0), per_sphere=True)
    assert chords.id.tolist() == [2] and chords.length.tolist() == [3]
    assert tracer.closest((0, 0, 0.5), (0, 0, -1), source=2, inside=True).t.tolist() == [1]


def test_one_end_or_radius_serves_all():
    star = boule.Capsules((0, 0, 0), B, 0.1)
    assert len(star) == 3 and star.a.tolist() == [[0, 0, 0]] * 3
    assert star.radius.tolist() == [np.float32(0.1)] * 3
    assert len(boule.Capsules((0, 0, 0), (1, 0, 0), [1, 2])) == 2
    assert len(boule.Capsules((0, 0, 0), (1, 0, 0), 1)) == 1
    assert len(boule.Capsules(np.zeros((0, 3)), np.zeros((0, 3)), 1)) == 0


@pytest.mark.parametrize("number", [np.float32, np.float64])
def test_arrays_are_kept_and_told(number):
    capsules = boule.Capsules(A.astype(number), B.astype(number), R, colors=np.eye(3))
    assert np.array_equal(capsules.a, A) and np.array_equal(capsules.b, B)
    assert capsules.a.dtype == number and np.array_equal(capsules.radius, R)
    assert not capsules.a.flags.writeable
    assert capsules.colors.tolist() == [[255, 0, 0], [0, 255, 0], [0, 0, 255]]
    assert capsules.range is None and repr(capsules) == "<boule.Capsules, 3 of them>"
    mapped = boule.Capsules(A, B, R, scalar=[1, 2, 3], map="grey", range=(1, 3))
    assert mapped.range == [1, 3]
    assert mapped.colors[0].tolist() != mapped.colors[2].tolist()


@pytest.mark.parametrize(
    "arguments, key, words",
    [
        ((A, B[:2], R), "b", "expected float32 or float64 of shape (3, 3) or (3,), got"),
        ((A[:, :2], B, R), "a", "of shape (N, 3) or (3,)"),
        ((A, B, R[:2]), "radius", "of shape (3,) or one number"),
        ((A, B, [1, 0, 1]), "radius", "row 1: must be above 0, is 0"),
        ((A, [[0, 0, 0], [0, 0, 0], [0, np.nan, 0]], R), "b", "row 2: must be finite, is nan"),
        (([[0, 0, 0], [1e300, 0, 0], [0, 0, 0]], B, R), "a", "row 1: is too large"),
        ((A, B, [1, np.inf, 1]), "radius", "row 1: must be finite"),
        (("a", B, R), "a", "got str"),
    ],
)
def test_wrong_arrays_are_refused(arguments, key, words):
    with pytest.raises(boule.Error) as caught:
        boule.Scene().add_capsules(*arguments)
    assert caught.value.key == key and words in str(caught.value)


def test_wrong_colors_are_refused():
    for keys, key in [
        ({"colors": np.zeros((2, 3))}, "colors"),
        ({"colors": np.full((3, 3), 2.0)}, "colors"),
        ({"scalar": [1, np.nan, 2]}, "scalar"),
        ({"map": "viridis"}, "map"),
        ({"color": "red", "scalar": [1, 2, 3]}, "color"),
    ]:
        with pytest.raises(boule.Error) as caught:
            boule.Capsules(A, B, R, **keys)
        assert caught.value.key == key


def test_objects_and_arrays_make_one_picture():
    scene, other = lit(boule.Scene()), lit(boule.Scene())
    scene.add_capsules(A, B, R, color="#c83214", material=boule.Plastic())
    for a, b, r in zip(A, B, R.tolist()):
        other.add_capsule(a=a, b=b, radius=r, color="#c83214", material=boule.Plastic())
    assert np.array_equal(picture(scene), picture(other))
    group = other.add_group("rods")
    group.capsules, other.capsules = other.capsules, []
    other.add_instance("rods")
    assert np.array_equal(picture(scene), picture(other))
    for again in (copy.deepcopy(other), pickle.loads(pickle.dumps(boule.Capsule(radius=2)))):
        assert again is not None
    with pytest.raises(boule.Error) as caught:
        other.add_capsule(radius=0)
    assert caught.value.key == "radius"


def test_a_file_is_read_back(tmp_path):
    np.save(tmp_path / "rods.npy", np.hstack([A, B, R[:, None]]).astype(np.float32))
    path = tmp_path / "scene.toml"
    path.write_text(
        'schema = 1\n[material.red]\ncolor = "#ff0000"\n[[capsules]]\nfile = "rods.npy"\n'
        'material = "red"\n[[capsule]]\nb = [0, 1, 0]\ncolor = "#00ff00"\n'
        "[[group.g.capsule]]\nradius = 2\n[[instance]]\ngroup = \"g\"\ntranslate = [0, 0, -9]\n"
    )
    scene = boule.load(path)
    (capsules,) = scene.capsules
    assert len(capsules) == 4 and np.array_equal(capsules.a[:3], A)
    assert capsules.b[3].tolist() == [0, 1, 0]
    assert capsules.colors.tolist() == [[0, 0, 0]] * 3 + [[0, 255, 0]]
    assert len(scene.groups["g"].capsules[0]) == 1
    told = np.asarray(boule.render(path, size=(48, 36)))
    assert np.array_equal(told, np.asarray(boule.render(scene, size=(48, 36))))


def test_far_ones_are_counted_from_the_origin():
    far = np.array([1e6, 0, 0])
    scene, other = lit(boule.Scene()), lit(boule.Scene())
    scene.add_capsules(A, B, R)
    other.add_capsules(A + far, B + far, R)
    other.camera = boule.Pinhole(eye=(1e6, 1, 8), look_at=(1e6, 0.5, 0))
    other.lights = [boule.PointLight(position=(1e6 + 3, 6, 5))]
    assert np.array_equal(picture(scene), picture(other))
