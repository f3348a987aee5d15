"""Tracer: rays in arrays to hits in arrays."""

import gc
import subprocess
import threading

import numpy as np
import pytest
from conftest import interrupt_after, program

import boule


def cloud(count=500, seed=1):
    rng = np.random.default_rng(seed)
    return rng.uniform(-5, 5, (count, 3)).astype(np.float32), rng.uniform(0.1, 0.5, count).astype(
        np.float32
    )


def rays(count=3000, seed=2):
    rng = np.random.default_rng(seed)
    return (
        rng.uniform(-8, 8, (count, 3)).astype(np.float32),
        rng.normal(size=(count, 3)).astype(np.float32),
    )


def nearest_by_hand(centers, radii, org, dir):
    """The nearest hits in extended precision, by the textbook's formula."""
    c, r = centers.astype(np.longdouble), radii.astype(np.longdouble)
    o, d = org.astype(np.longdouble), dir.astype(np.longdouble)
    t = np.full(len(o), np.inf)
    ids = np.full(len(o), -1)
    for k in range(len(o)):
        offset = o[k] - c
        a = d[k] @ d[k]
        b = offset @ d[k]
        root = b * b - a * ((offset * offset).sum(axis=1) - r * r)
        with np.errstate(invalid="ignore"):
            both = np.stack([(-b - np.sqrt(root)) / a, (-b + np.sqrt(root)) / a])
        both = np.where((root >= 0) & (both > 0), both, np.inf)
        first = both.min(axis=0)
        if np.isfinite(first.min()):
            ids[k] = int(first.argmin())
            t[k] = float(first.min())
    return t, ids


def test_hits_are_those_of_the_formula():
    centers, radii = cloud()
    org, dir = rays(400)
    t, ids = nearest_by_hand(centers, radii, org, dir)
    hits = boule.Tracer(centers, radii).closest(org, dir)
    assert hits.t.dtype == np.float64 and hits.id.dtype == np.int32
    assert hits.normal.dtype == np.float32 and hits.normal.shape == (400, 3)
    assert (hits.id == ids).all()
    # t is solved in double: a few units in the last place, more where a ray grazes.
    assert np.allclose(hits.t, t, rtol=1e-9, atol=0)
    met = hits.id >= 0
    point = org[met] + hits.t[met, None] * dir[met]
    outward = (point - centers[hits.id[met]]) / radii[hits.id[met], None]
    turned = outward * -np.sign((outward * dir[met]).sum(axis=1))[:, None]
    assert np.abs(hits.normal[met] - turned).max() < 1e-5
    assert (hits.normal[~met] == 0).all() and np.isinf(hits.t[~met]).all()


def test_hits_are_the_programs(tmp_path):
    centers, radii = cloud()
    org, dir = rays()
    np.save(tmp_path / "s.npy", np.column_stack([centers, radii]))
    table = np.zeros((len(org), 8), np.float32)
    table[:, 0:3], table[:, 3], table[:, 4:7], table[:, 7] = org, 0.5, dir, 9
    np.save(tmp_path / "r.npy", table)
    subprocess.run(
        [program(), "trace", tmp_path / "s.npy", "--rays", tmp_path / "r.npy",
         "-o", tmp_path / "h.npy", "-q"],
        check=True,
    )  # fmt: skip
    told = np.load(tmp_path / "h.npy")
    hits = boule.Tracer(centers, radii).closest(org, dir, 0.5, 9)
    assert (told["t"] == hits.t).all() and (told["id"] == hits.id).all()
    assert (told["normal"] == hits.normal).all() and (told["entering"] == hits.entering).all()


def test_any_agrees_with_closest():
    centers, radii = cloud()
    org, dir = rays()
    tracer = boule.Tracer(centers, radii)
    met = tracer.any(org, dir)
    assert met.dtype == np.bool_
    assert (met == (tracer.closest(org, dir).id >= 0)).all()
    ends = np.full(len(org), 2.0)
    assert (tracer.any(org, dir, tmax=ends) == (tracer.closest(org, dir, tmax=ends).id >= 0)).all()


def test_every_layout_gives_the_same_bits():
    centers, radii = cloud()
    org, dir = rays()
    tracer = boule.Tracer(centers, radii)
    expected = tracer.closest(org, dir)
    unaligned = np.zeros((len(org), 3), np.dtype({"names": ["x"], "formats": ["f4"], "offsets": [1],
                                                  "itemsize": 5}))["x"]  # fmt: skip
    unaligned[:] = org
    layouts = [
        (org.astype(np.float64), dir.astype(np.float64)),
        (np.asfortranarray(org), np.asfortranarray(dir)),
        (np.repeat(org, 2, axis=0)[::2], np.repeat(dir, 2, axis=1)[:, ::2]),
        (org[::-1].copy()[::-1], dir[:, ::-1].copy()[:, ::-1]),
        (org.astype(">f4"), dir.astype(">f8")),
        (unaligned, dir),
        (org.tolist(), dir.tolist()),
    ]
    for one_org, one_dir in layouts:
        hits = tracer.closest(one_org, one_dir)
        assert all((a == b).all() for a, b in zip(hits, expected))
    for one_centers in (centers.astype(np.float64), np.asfortranarray(centers), centers.tolist()):
        hits = boule.Tracer(one_centers, radii).closest(org, dir)
        assert all((a == b).all() for a, b in zip(hits, expected))


def test_one_value_serves_all_rays():
    centers, radii = cloud()
    org, dir = rays()
    tracer = boule.Tracer(centers, radii)
    one = tracer.closest((0, 0, 20), dir)
    many = tracer.closest(np.tile(np.float32([0, 0, 20]), (len(dir), 1)), dir)
    assert all((a == b).all() for a, b in zip(one, many))
    one = tracer.closest(org, (0, 0, -1), tmin=0.25)
    many = tracer.closest(org, np.tile([0, 0, -1], (len(org), 1)), np.full(len(org), 0.25))
    assert all((a == b).all() for a, b in zip(one, many))
    assert len(tracer.closest((0, 0, 20), (0, 0, -1)).t) == 1
    assert (boule.Tracer(centers, 0.25).closest(org, dir).id
            == boule.Tracer(centers, np.full(len(centers), 0.25)).closest(org, dir).id).all()  # fmt: skip


def test_origins_are_taken_in_double():
    tracer = boule.Tracer([[0.0, 0.0, 0.0]], 1.0)
    far = 1e9 + 1 / 1024
    assert tracer.closest([[0, 0, far]], [[0, 0, -1]]).t[0] == far - 1


def test_far_spheres_are_counted_from_an_origin():
    centers, radii = cloud()
    org, dir = rays()
    near = boule.Tracer(centers, radii).closest(org, dir)
    shift = np.array([1e6, -2e6, 3e6])
    far = boule.Tracer(centers + shift, radii).closest(org + shift, dir)
    assert all((a == b).all() for a, b in zip(near, far))
    fixed = boule.Tracer(centers + shift, radii, origin=(0, 0, 0)).closest(org + shift, dir)
    assert (fixed.t != near.t).any()


def test_arrays_may_change_and_go_afterwards():
    centers, radii = cloud()
    org, dir = rays()
    tracer = boule.Tracer(centers, radii)
    expected = tracer.closest(org, dir)
    centers[:] = 100
    radii[:] = 0.001
    del centers, radii
    gc.collect()
    again = tracer.closest(org, dir)
    assert all((a == b).all() for a, b in zip(again, expected))
    t = tracer.closest(org, dir).t
    del tracer
    gc.collect()
    assert (t == expected.t).all()


def test_a_scene_can_be_traced(ball, scenes):
    hits = boule.Tracer(ball).closest([[0, 5, 0], [3, 5, 0]], [[0, -1, 0], [0, -1, 0]])
    assert list(hits.id) == [0, 1] and list(hits.t) == [3, 5]
    assert boule.Tracer(scenes / "first_light.toml").closest([[0, 50, 0]], [[0, -1, 0]]).id[0] >= 0


def test_nothing_to_trace():
    tracer = boule.Tracer(np.zeros((0, 3)), np.zeros(0))
    assert tracer.closest(np.zeros((0, 3)), np.zeros((0, 3))).t.shape == (0,)
    assert tracer.closest([[0, 0, 0]], [[1, 0, 0]]).id[0] == -1


@pytest.mark.parametrize(
    "call, key, words",
    [
        (lambda t: t.closest(np.zeros((4, 2)), np.zeros((4, 3))), "org",
         "expected float32 or float64 of shape (N, 3) or (3,), got float64 of shape (4, 2)"),
        (lambda t: t.closest(np.zeros((4, 3)), np.zeros((5, 3))), "dir",
         "expected float32 or float64 of shape (4, 3) or (3,), got float64 of shape (5, 3)"),
        (lambda t: t.closest(np.zeros((4, 3), complex), np.zeros((4, 3))), "org", "complex128"),
        (lambda t: t.closest(np.zeros((4, 3)), "x"), "dir", "got str"),
        (lambda t: t.closest(np.zeros((4, 3)), np.zeros((4, 3)), tmin=np.zeros(3)), "tmin",
         "expected float32 or float64 of shape (4,) or one number, got float64 of shape (3,)"),
        (lambda t: t.any(None, np.zeros((4, 3))), "org", "got NoneType"),
        (lambda t: t.any(np.zeros((4, 3)), (0, 0, 1), source=[-1, 0, 1, 0]), "source",
         "row 2: must be -1 or an id below 1, is 1"),
        (lambda t: t.closest(np.zeros((4, 3)), (0, 0, 1), source=-2), "source", "row 0: must be -1"),
        (lambda t: t.count(np.zeros((4, 3)), (0, 0, 1), source=0.5), "source", "is 0.5"),
        (lambda t: t.chord(np.zeros((4, 3)), (0, 0, 1), inside=[True]), "inside",
         "of shape (4,) or one number, got float32 of shape (1,)"),
        (lambda t: t.all_hits(np.zeros((4, 3)), (0, 0, 1), limit=-1), "limit", "at least 0, is -1"),
        (lambda t: t.all_hits(np.zeros((4, 3)), (0, 0, 1), limit=1.5), "limit", "whole number"),
        (lambda t: t.closest(np.zeros((4, 5, 3)), np.zeros((5, 4, 3))), "dir",
         "expected rays of shape (4, 5), got (5, 4)"),
        (lambda t: t.any(np.ma.masked_equal(np.zeros((4, 3)), 0), (0, 0, 1)), "org",
         "is a masked array, and 12 of its values are masked"),
        (lambda t: t.any(np.ma.masked_equal(np.zeros((2, 2, 3)), 0), (0, 0, 1)), "org", "masked"),
        (lambda t: t.closest(np.zeros((4, 3)), (0, 0, 1), out=np.zeros(4)), "out",
         "expected Hits, got ndarray"),
        (lambda t: t.any(np.zeros((4, 3)), (0, 0, 1), out=np.zeros(4)), "out",
         "the array: expected bool of shape (4,), in C order and writable, got float64"),
        (lambda t: t.any(np.zeros((4, 3)), (0, 0, 1), out=np.zeros(8, bool)[::2]), "out", "C order"),
        (lambda t: t.any([[1, 2, 3], [4, 5]], np.zeros((2, 3))), "org", "numpy makes no array"),
        (lambda t: boule.Tracer(np.zeros((4, 3)), np.ones(5)), "radii",
         "expected float32 or float64 of shape (4,) or one number, got float64 of shape (5,)"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), [1, -1]), "radii", "row 1: must be above 0, is -1"),
        (lambda t: boule.Tracer([[0, 0, np.nan]], 1), "centers", "row 0: must be finite, is nan"),
        (lambda t: boule.Tracer([[0, 0, 1e300]], 1, origin=(0, 0, 0)), "centers", "too large"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, solver="exact"), "solver", "unknown name"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, solver=3), "solver", "expected text"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, isa="x"), "isa", "expected one of auto"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, isa=3), "isa", "expected text"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, threads=-1), "threads", "0 to 1024, is -1"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, threads=1025), "threads", "0 to 1024"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, threads=1.5), "threads",
         "expected a whole number, got float"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, origin=(0, 0, np.nan)), "origin",
         "must be finite, is nan"),
        (lambda t: boule.Tracer(np.zeros((2, 3)), 1, origin=(0, 0)), "origin",
         "expected float32 or float64 of shape (3,), got int64 of shape (2,)"),
        (lambda t: boule.Tracer(boule.Scene(), origin=3), "origin", "(3,)"),
    ],
)  # fmt: skip
def test_errors_say_what_was_expected(call, key, words):
    with pytest.raises(boule.Error) as caught:
        call(boule.Tracer([[0, 0, 0]], 1))
    assert words in str(caught.value)
    assert caught.value.key == key
    assert isinstance(caught.value, ValueError)


def test_options_of_a_tracer_change_no_hit():
    centers, radii = cloud()
    org, dir = rays()
    expected = boule.Tracer(centers, radii).closest(org, dir)
    for options in ({"threads": 1}, {"isa": "scalar"}, {"solver": "reference"},
                    {"origin": np.zeros(3)}, {"origin": "auto"}):  # fmt: skip
        hits = boule.Tracer(centers, radii, **options).closest(org, dir)
        assert all((a == b).all() for a, b in zip(hits, expected)), options


def test_threads_may_share_a_tracer():
    centers, radii = cloud()
    org, dir = rays(20000)
    tracer = boule.Tracer(centers, radii)
    expected = tracer.closest(org, dir)
    found = [None] * 6

    def trace(k):
        found[k] = tracer.closest(org, dir)

    threads = [threading.Thread(target=trace, args=(k,)) for k in range(len(found))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for hits in found:
        assert all((a == b).all() for a, b in zip(hits, expected))


def test_interrupted_tracer_stays_usable():
    centers, radii = cloud(200_000)
    tracer = boule.Tracer(centers, radii)
    dir = np.random.default_rng(3).normal(size=(2000, 3)).astype(np.float32)
    many = np.lib.stride_tricks.as_strided(
        dir, shape=(40_000_000, 3), strides=(0, dir.strides[1]), writeable=False
    )
    interrupt_after(0.2)
    with pytest.raises(KeyboardInterrupt):
        tracer.closest((0, 0, 0), many)
    assert (tracer.closest((0, 0, 0), dir).id >= -1).all()


def test_too_many_rays_for_memory():
    tracer = boule.Tracer([[0, 0, 0]], 1)
    one = np.zeros(3, np.float32)
    many = np.lib.stride_tricks.as_strided(one, shape=(2**31 - 1, 3), strides=(0, 4))
    import resource

    limits = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, limits[1]))
    try:
        with pytest.raises(MemoryError):
            tracer.closest(many, (0, 0, 1))
    finally:
        resource.setrlimit(resource.RLIMIT_AS, limits)


def test_ends_are_compared_in_double():
    centers, radii = cloud()
    org, dir = rays(2000)
    tracer = boule.Tracer(centers, radii)
    every = tracer.all_hits(org, dir)
    tmin = np.zeros(len(org))
    steps = 0
    for step in range(40):
        hits = tracer.closest(org, dir, tmin)
        assert (tracer.any(org, dir, tmin) == hits.hit).all()
        at = every.offset[:-1] + step
        more = at < every.offset[1:]  # no two crossings of this cloud are at one t
        assert (hits.hit == more).all()
        assert (hits.t[more] == every.t[at[more]]).all()
        assert (hits.id[more] == every.id[at[more]]).all()
        assert (hits.entering[more] == every.entering[at[more]]).all()
        assert not tracer.any(org, dir, tmin, np.nextafter(hits.t, 0))[more].any()
        assert tracer.any(org, dir, tmin, hits.t)[more].all()
        steps += more.sum()
        tmin = hits.t
        if not more.any():
            break
    assert steps == len(every.t) > 1000


def test_rays_leave_their_sources():
    centers, radii = cloud(300)
    org, dir = rays(2000)
    tracer = boule.Tracer(centers, radii)
    hits = tracer.closest(org, dir)
    met = hits.hit
    point, way = org[met] + hits.t[met, None] * dir[met], dir[met]
    source, enters = hits.id[met], hits.entering[met]
    next_hits = tracer.closest(point, way, source=source, inside=enters)
    crossings = tracer.all_hits(org[met], way, tmin=hits.t[met])
    first = crossings.offset[:-1]
    more = first < crossings.offset[1:]
    assert (next_hits.hit == more).all()
    assert (next_hits.id[more] == crossings.id[first[more]]).all()
    # Without a source many meet their own sphere again, by rounding.
    again = tracer.closest(point, way)
    assert (again.t != next_hits.t).mean() > 0.2


def test_crossings_pair_up():
    centers, radii = cloud()
    org, dir = rays(1000)
    tracer = boule.Tracer(centers, radii)
    every = tracer.all_hits(org, dir, tmin=-np.inf)
    assert [a.dtype for a in every] == [np.int64, np.float64, np.int32, np.bool_]
    assert every.offset[0] == 0 and every.offset[-1] == len(every.t) == 2 * every.entering.sum()
    count = tracer.count(org, dir, tmin=-np.inf)
    assert count.dtype == np.int64 and (np.diff(every.offset) == count).all()
    two = tracer.all_hits(org, dir, tmin=-np.inf, limit=2)
    assert (np.diff(two.offset) == np.minimum(count, 2)).all()
    assert (tracer.all_hits(org, dir, limit=0).offset == 0).all()


def test_chords_are_lengths_inside():
    tracer = boule.Tracer([[0, 0, 0], [3, 0, 0], [9, 0, 0]], [2, 2, 1])
    org, dir = [[-4, 0, 0], [0, 0, 0], [0, 9, 0]], (2, 0, 0)
    assert tracer.chord(org, dir).tolist() == [4.5, 3.5, 0]
    each = tracer.chord(org, dir, per_sphere=True)
    assert each.offset.tolist() == [0, 3, 6, 6] and each.id.tolist() == [0, 1, 2, 0, 1, 2]
    assert each.length.tolist() == [2, 2, 1, 1, 2, 1]
    assert tracer.chord(org, dir, tmax=0.25).tolist() == [0, 0.25, 0]
    assert tracer.chord((1, 0, 0), (1, 0, 0), source=1, inside=True).tolist() == [6]
    assert tracer.count((5, 0, 0), (1, 0, 0), source=1).tolist() == [2]


def test_rays_may_have_any_shape():
    centers, radii = cloud()
    org, dir = rays(12)
    tracer = boule.Tracer(centers, radii)
    flat = tracer.closest(org, dir, source=3)
    shape = (3, 2, 2)
    hits = tracer.closest(org.reshape(*shape, 3), dir.reshape(*shape, 3), np.zeros(shape), source=3)
    assert hits.normal.shape == (*shape, 3)
    for one, many in zip(flat, hits):
        assert many.shape[:3] == shape and (many.reshape(one.shape) == one).all()
    assert (tracer.any((0, 0, 0), dir.reshape(4, 3, 3)).ravel() == tracer.any((0, 0, 0), dir)).all()
    assert tracer.count(org.reshape(6, 2, 3), (0, 0, 1)).shape == (6, 2)
    assert tracer.chord(org.reshape(6, 2, 3), (0, 0, 1)).shape == (6, 2)
    assert len(tracer.all_hits(org.reshape(6, 2, 3), (0, 0, 1)).offset) == 13


def test_results_may_have_a_place():
    centers, radii = cloud()
    org, dir = rays(5000)
    tracer = boule.Tracer(centers, radii)
    expected = tracer.closest(org, dir)
    out = boule.Hits(*(np.zeros_like(a) for a in expected))
    assert tracer.closest(org, dir, out=out) is out
    assert all((a == b).all() for a, b in zip(out, expected))
    met = np.zeros(len(org), bool)
    assert tracer.any(org, dir, out=met) is met and (met == expected.hit).all()
    square = boule.Hits(*(np.zeros((50, 100) + a.shape[1:], a.dtype) for a in expected))
    tracer.closest(org.reshape(50, 100, 3), dir.reshape(50, 100, 3), out=square)
    assert (square.t.ravel() == expected.t).all()
    with pytest.raises(boule.Error):
        tracer.closest(org, dir, out=boule.Hits(*expected[:3], expected.entering.astype(int)))


def test_too_many_crossings_for_memory():
    import resource

    tracer = boule.Tracer(np.zeros((16, 3)), np.linspace(1, 2, 16))
    one = np.zeros(3, np.float32)
    many = np.lib.stride_tricks.as_strided(one, shape=(20_000_000, 3), strides=(0, 4))
    limits = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (6 << 30, limits[1]))
    try:
        with pytest.raises(MemoryError, match="the 320000000 crossings of 20000000 rays need"):
            tracer.all_hits(many, (0, 0, 1))
        assert tracer.count(many[:10], (0, 0, 1)).tolist() == [16] * 10
    finally:
        resource.setrlimit(resource.RLIMIT_AS, limits)
