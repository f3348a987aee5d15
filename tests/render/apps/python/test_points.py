"""Nearest primitives of points, what points are in, and pairs of spheres."""

import numpy as np
import pytest

import boule


@pytest.fixture(scope="module")
def cloud():
    rng = np.random.default_rng(3)
    centers = rng.uniform(-1, 1, (300, 3)).astype(np.float32)
    radii = rng.uniform(0.01, 0.3, 300).astype(np.float32)
    return centers, radii, boule.Tracer(centers, radii, origin=(0, 0, 0))


def distances(centers, radii, points):
    """Of each point from each sphere, in long double."""
    way = points[:, None, :].astype(np.longdouble) - centers.astype(np.longdouble)
    return np.sqrt((way**2).sum(axis=-1)) - radii.astype(np.longdouble)


@pytest.fixture(scope="module")
def points():
    return np.random.default_rng(4).uniform(-1.5, 1.5, (500, 3))


def test_nearest_is_the_least_distance(cloud, points):
    centers, radii, tracer = cloud
    every = distances(centers, radii, points)
    order = np.argsort(every, axis=1)
    for k in (1, 5, 400):
        found = tracer.nearest(points, k)
        most = min(k, 300)
        distance, id = (np.reshape(a, (500, k)) for a in found)
        assert found.distance.shape == ((500,) if k == 1 else (500, k))
        assert (id[:, :most] == order[:, :most]).all()
        rounded = np.take_along_axis(every, order, 1).astype(np.float64)
        assert np.allclose(distance[:, :most], rounded[:, :most], rtol=1e-15, atol=1e-17)
        assert (id[:, most:] == -1).all() and (distance[:, most:] == np.inf).all()


def test_nearest_stops_at_the_limit(cloud, points):
    _, _, tracer = cloud
    all_of = tracer.nearest(points, 8)
    some = tracer.nearest(points, 8, limit=0.05)
    near = all_of.distance <= 0.05
    assert 0 < near.sum() < near.size
    assert (some.id == np.where(near, all_of.id, -1)).all()
    assert (some.distance == np.where(near, all_of.distance, np.inf)).all()


def lists(found):
    return [list(part) for part in np.split(found.id, found.offset[1:-1])]


def test_members_are_those_within(cloud, points):
    centers, radii, tracer = cloud
    every = distances(centers, radii, points)
    radius = np.random.default_rng(5).uniform(-0.1, 0.4, len(points))
    for found, limit in (
        (tracer.inside(points), np.zeros(len(points))),
        (tracer.within(points, 0.2), np.full(len(points), 0.2)),
        (tracer.within(points, radius), radius),
        (tracer.within(points, radius.astype(np.float32)), radius.astype(np.float32)),
    ):
        assert found.offset.dtype == np.int64 and found.id.dtype == np.int32
        assert lists(found) == [list(np.flatnonzero(d <= at)) for d, at in zip(every, limit)]
    first = tracer.inside(points, first=True)
    inside = lists(tracer.inside(points))
    assert list(first) == [ids[0] if ids else -1 for ids in inside]


def test_pairs_touch_or_overlap(cloud):
    centers, radii, tracer = cloud
    gaps = distances(centers, radii, centers.astype(float)) - radii[:, None].astype(np.longdouble)
    i, j = np.triu_indices(len(radii), 1)
    for gap in (-0.05, 0, 0.1):
        found = tracer.pairs(gap)
        near = gaps[i, j] <= gap
        assert near.sum() > 50
        assert (found.first == i[near]).all() and (found.second == j[near]).all()
        assert np.allclose(found.gap, gaps[i, j][near].astype(float), rtol=1e-15, atol=1e-16)


def test_points_keep_their_shape(cloud, points):
    _, _, tracer = cloud
    flat = tracer.nearest(points, 2)
    shaped = tracer.nearest(points.reshape(20, 25, 3), 2)
    assert shaped.id.shape == (20, 25, 2) and (shaped.id.reshape(500, 2) == flat.id).all()
    assert tracer.nearest(points.reshape(20, 25, 3)).distance.shape == (20, 25)
    assert tracer.inside(points.reshape(20, 25, 3), first=True).shape == (20, 25)
    members = tracer.within(points.reshape(20, 25, 3), np.full((20, 25), 0.1))
    assert (members.id == tracer.within(points, 0.1).id).all()
    assert tracer.nearest([0, 0, 0]).id.shape == (1,)
    assert (tracer.nearest(points[::-1]).id[::-1] == flat.id[:, 0]).all()
    single = points.astype(np.float32)
    assert (tracer.nearest(single).id == tracer.nearest(single.astype(float)).id).all()
    assert tracer.nearest(np.empty((0, 3)), 3).id.shape == (0, 3)
    assert list(tracer.inside(np.empty((0, 3))).offset) == [0]


def test_surfaces_count_exactly():
    tracer = boule.Tracer([[0, 0, 0], [3, 0, 0]], [1, 2], origin=(0, 0, 0))
    outside = np.nextafter(1.0, 2)
    points = [[-1, 0, 0], [-outside, 0, 0], [1, 0, 0], [-1, 5e-324, 0]]
    assert lists(tracer.inside(points)) == [[0], [], [0, 1], []]
    assert lists(tracer.within(points, outside - 1)) == [[0], [0], [0, 1], [0]]
    assert list(tracer.nearest(points).id) == [0, 0, 0, 0]
    found = tracer.pairs()
    assert (list(found.first), list(found.second), list(found.gap)) == ([0], [1], [0])
    assert len(tracer.pairs(-5e-324).gap) == 0


def test_answers_far_from_zero(cloud, points):
    centers, radii, tracer = cloud
    away = np.array([2**24, -(2**25), 2**26], float)
    centers = np.round(centers * 2**20) / 2**20
    points = np.round(points * 2**20) / 2**20
    near = boule.Tracer(centers, radii)
    far = boule.Tracer(centers + away, radii)
    for one, other in zip(near.nearest(points, 3), far.nearest(points + away, 3)):
        assert (one == other).all()
    assert (far.pairs().gap == near.pairs().gap).all()


def test_planes_and_capsules_have_distances():
    scene = boule.Scene()
    scene.spheres.append(boule.Sphere(center=(0, 2, 0), radius=1))
    scene.planes.append(boule.Plane(point=(0, 0, 0), normal=(0, 1, 0)))
    scene.capsules.append(boule.Capsule(a=(5, 1, 0), b=(9, 1, 0), radius=0.5))
    tracer = boule.Tracer(scene)
    found = tracer.nearest([[0, 0.25, 0], [7, 1.25, 0], [20, -3, 0]], 3)
    assert list(found.id[0]) == [1, 0, 2] and list(found.distance[0][:2]) == [0.25, 0.75]
    assert list(found.id[1][:2]) == [2, 1] and list(found.distance[1][:2]) == [-0.25, 1.25]
    assert found.id[2][0] == 1 and found.distance[2][0] == -3
    assert lists(tracer.inside([[7, 1.5, 0], [0, 0, 0], [0, 2, 0]])) == [[2], [1], [0]]


def test_bad_points_name_the_row(cloud):
    _, _, tracer = cloud
    for bad in (np.nan, np.inf, 1e151):
        points = np.zeros((5, 3))
        points[3, 1] = bad
        for ask in (tracer.nearest, tracer.inside, lambda p: tracer.within(p, 1)):
            with pytest.raises(boule.Error, match="row 3") as raised:
                ask(points)
            assert raised.value.key == "points"
    masked = np.ma.masked_array(np.zeros((5, 3)), mask=np.eye(5, 3))
    with pytest.raises(boule.Error, match="masked"):
        tracer.nearest(masked)
    with pytest.raises(boule.Error, match="row 2"):
        tracer.within(np.zeros((4, 3)), [1, 2, np.nan, 3])


@pytest.mark.parametrize(
    "ask, key",
    [
        (lambda t: t.nearest([[0, 0]]), "points"),
        (lambda t: t.nearest("far"), "points"),
        (lambda t: t.nearest([[0, 0, 0]], 0), "k"),
        (lambda t: t.nearest([[0, 0, 0]], 1.5), "k"),
        (lambda t: t.nearest([[0, 0, 0]], limit=np.nan), "limit"),
        (lambda t: t.nearest([[0, 0, 0]], limit="far"), "limit"),
        (lambda t: t.inside([[0, 0, 0]], first=1), "first"),
        (lambda t: t.within([[0, 0, 0]] * 3, [1, 2]), "radius"),
        (lambda t: t.within(np.zeros((2, 2, 3)), np.zeros((3, 2))), "radius"),
        (lambda t: t.within(np.zeros((4, 3)), np.zeros((2, 2))), "radius"),
        (lambda t: t.pairs(np.nan), "gap"),
        (lambda t: t.pairs(None), "gap"),
    ],
)
def test_wrong_arguments_are_named(cloud, ask, key):
    with pytest.raises(boule.Error) as raised:
        ask(cloud[2])
    assert raised.value.key == key


def test_too_many_results_are_refused(cloud):
    _, _, tracer = cloud
    with pytest.raises(MemoryError, match="MiB of memory"):
        tracer.nearest(np.zeros((1000, 3)), 2**31 - 1)


def test_too_many_pairs_are_refused():
    import resource

    tracer = boule.Tracer(np.zeros((20_000, 3)), np.linspace(1, 2, 20_000))
    limits = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (1 << 30, limits[1]))
    try:
        with pytest.raises(MemoryError, match="pairs of spheres need"):
            tracer.pairs()
        assert 0 < len(tracer.pairs(-3.999).gap) < 1000
    finally:
        resource.setrlimit(resource.RLIMIT_AS, limits)
