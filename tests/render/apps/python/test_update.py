"""Tracer.update: spheres that move."""

import numpy as np
import pytest

import boule

RNG = np.random.default_rng(5)


def cloud(count, seed=1, shift=(0.0, 0.0, 0.0)):
    rng = np.random.default_rng(seed)
    return rng.uniform(-5, 5, (count, 3)) + shift, rng.uniform(0.05, 0.3, count)


def rays(count=3000):
    rng = np.random.default_rng(2)
    return rng.uniform(-8, 8, (count, 3)), rng.normal(size=(count, 3))


def assert_same(tracer, expected, shift=(0.0, 0.0, 0.0)):
    org, dir = rays()
    org = org + shift
    for call in ("closest", "all_hits"):
        for one, other in zip(getattr(tracer, call)(org, dir), getattr(expected, call)(org, dir)):
            assert one.dtype == other.dtype and np.array_equal(one, other)
    assert np.array_equal(tracer.chord(org, dir), expected.chord(org, dir))


@pytest.mark.parametrize("count", [1, 10, 500, 20000])
@pytest.mark.parametrize("step", [0.0, 0.01, 1.0, 30.0])
def test_answers_are_those_of_new_tracers(count, step):
    centers, radii = cloud(count)
    tracer = boule.Tracer(centers, radii)
    for _ in range(3):
        centers = centers + RNG.normal(0, step, centers.shape)
        tracer.update(centers)
        assert_same(tracer, boule.Tracer(centers, radii))
    tracer.update(centers * 2, radii * 3)
    assert_same(tracer, boule.Tracer(centers * 2, radii * 3))
    tracer.update(centers)
    assert_same(tracer, boule.Tracer(centers, radii * 3))


@pytest.mark.parametrize("origin", ["auto", (1e7, -3e7, 2e7), (0, 0, 0)])
def test_origins_are_chosen_anew(origin):
    there = np.array((1e7, -3e7, 2e7))
    centers, radii = cloud(500, shift=there)
    tracer = boule.Tracer(centers, radii, origin=origin)
    tracer.update(centers + 7, radii)
    assert_same(tracer, boule.Tracer(centers + 7, radii, origin=origin), there)
    tracer.update(centers - there)
    assert_same(tracer, boule.Tracer(centers - there, radii, origin=origin))


def test_copies_and_giants_may_come_and_go():
    centers, radii = cloud(2000)
    piled, huge = centers.copy(), radii.copy()
    piled[:60] = piled[0]
    huge[100:160] = huge[100]
    piled[100:160] = piled[100]
    huge[7] = 1000
    piled[8] = 1e30
    huge[9] = 1e25
    tracer = boule.Tracer(centers, radii)
    for places, sizes in ((piled, huge), (centers, radii), (centers, huge), (piled, radii)):
        tracer.update(places, sizes)
        assert_same(tracer, boule.Tracer(places, sizes))


@pytest.mark.parametrize(
    ("centers", "radii", "key"),
    [
        (np.zeros((9, 3)), None, "centers"),
        (np.zeros((10, 2)), None, "centers"),
        (np.full((10, 3), np.nan), None, "centers"),
        (np.zeros((10, 3)), np.zeros(10), "radii"),
        (np.zeros((10, 3)), np.ones(9), "radii"),
        (np.ma.masked_less(np.zeros((10, 3)), 1), None, "centers"),
    ],
)
def test_wrong_arguments_move_nothing(centers, radii, key):
    right = cloud(10)
    tracer = boule.Tracer(*right)
    with pytest.raises(boule.Error) as caught:
        tracer.update(centers, radii)
    assert caught.value.key == key
    assert_same(tracer, boule.Tracer(*right))


def test_scenes_are_refused():
    scene = boule.Scene()
    scene.add_spheres(*cloud(10))
    with pytest.raises(boule.Error, match="scene"):
        boule.Tracer(scene).update(cloud(10)[0])


def test_results_can_be_reused():
    tracer = boule.Tracer(*cloud(500))
    org, dir = rays(60)
    for shape in ((60,), (5, 12)):
        o, d = org.reshape(*shape, 3), dir.reshape(*shape, 3)
        for call, dtype in (("any", bool), ("count", np.int64), ("chord", np.float64)):
            out = np.empty(shape, dtype)
            assert getattr(tracer, call)(o, d, out=out) is out
            assert (out == getattr(tracer, call)(o, d)).all()
            for wrong in (np.empty(shape, np.int8), np.empty((61,), dtype), out[..., ::2], [1]):
                with pytest.raises(boule.Error) as caught:
                    getattr(tracer, call)(o, d, out=wrong)
                assert caught.value.key == "out"
    with pytest.raises(boule.Error, match="per_sphere"):
        tracer.chord(org, dir, per_sphere=True, out=np.empty(60))
