"""Copies and pickles, in this process and in others."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import boule


def cloud(count=200, dtype=np.float64, shift=0.0):
    rng = np.random.default_rng(1)
    return (rng.uniform(-3, 3, (count, 3)) + shift).astype(dtype), rng.uniform(0.1, 0.5, count)


def rays(count=500):
    rng = np.random.default_rng(2)
    return rng.uniform(-8, 8, (count, 3)), rng.normal(size=(count, 3))


def full_scene(shift=0.0):
    """Something of every kind."""
    scene = boule.Scene(camera=boule.Fit(distortion=boule.Distortion(st=np.full((2, 2, 2), 0.5))))
    gold = boule.Metal(color="#ffcc44")
    scene.materials["gold"] = gold
    scene.add_spheres(*cloud(shift=shift), scalar=np.arange(200.0), map="viridis", material=gold)
    scene.add_spheres(*cloud(50, np.float32), color="#ff0000")
    scene.add_capsules([[0, 0, 0]], [[1, 2, 3]], 0.5, colors=[[1, 0, 0]])
    scene.add_sphere(center=(0, 0, 0), radius=2, material=gold)
    scene.add_plane(point=(0, -9, 0))
    scene.add_group("pair").add_sphere(radius=0.3)
    scene.add_instance("pair", translate=(0, 5, 0))
    scene.background = boule.EnvironmentBackground(pixels=np.full((2, 4, 3), 0.25))
    scene.lights.append(boule.PointLight(position=(9, 9, 9)))
    return scene


def pickled(one, protocol):
    return pickle.loads(pickle.dumps(one, protocol))


WAYS = {
    "deepcopy": copy.deepcopy,
    "oldest": lambda one: pickled(one, 2),
    "newest": lambda one: pickled(one, pickle.HIGHEST_PROTOCOL),
}


def picture_of(scene):
    return boule.render(scene, size=(40, 30), spp=2, aov="depth,id", background="transparent")


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("shift", [0.0, 1e7])
def test_copied_scenes_have_the_same_picture(way, shift):
    scene = full_scene(shift)
    expected = picture_of(scene)
    copied = WAYS[way](scene)
    made = picture_of(copied)
    assert (np.asarray(made) == np.asarray(expected)).all()
    assert made.stats["scene_hash"] == expected.stats["scene_hash"]
    # Shared objects stay shared, and a copy changes by itself.
    assert copied.spheres[0].material is copied.materials["gold"]
    copied.materials["gold"].color = "#000000"
    copied.spheres.pop()
    assert picture_of(scene).stats["scene_hash"] == expected.stats["scene_hash"]


@pytest.mark.parametrize("way", WAYS)
def test_copied_scenes_of_files_too(way, tmp_path):
    (tmp_path / "water.xyz").write_text("3\n\nO 0 0 0\nH 0.9 0 0\nH 0 0.9 0\n")
    scene = boule.load(tmp_path / "water.xyz")
    copied = WAYS[way](scene)
    assert copied.legend == scene.legend and copied.notes == scene.notes
    assert (np.asarray(picture_of(copied)) == np.asarray(picture_of(scene))).all()


@pytest.mark.parametrize("way", WAYS)
def test_copied_pictures_write_the_same_file(way, tmp_path):
    made = boule.render(
        full_scene(), size=(40, 30), crop=(3, 4, 30, 20), noise=0.1, spp=64, aov="depth,id,noise",
        background="transparent",
    )  # fmt: skip
    copied = WAYS[way](made)
    for name, picture in (("a.exr", made), ("b.exr", copied)):
        picture.save(tmp_path / name)
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
    assert copied.stats == made.stats and copied.notes == made.notes
    assert (copied.finished, copied.share) == (made.finished, made.share)
    assert (copied.aovs["depth"] == made.aovs["depth"]).all()
    assert (copied.alpha == made.alpha).all()


def test_unfinished_pictures_stay_unfinished():
    made = boule.render(full_scene(), size=(400, 300), spp=4096, partial=True, time_limit=0.05)
    copied = pickled(made, 4)
    assert not copied.finished and copied.share == made.share


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("shift", [0.0, 1e7])
def test_copied_tracers_answer_alike(way, shift):
    org, dir = rays()
    for tracer in (boule.Tracer(*cloud(shift=shift)), boule.Tracer(full_scene(shift))):
        copied = WAYS[way](tracer)
        for one, other in zip(tracer.closest(org + shift, dir), copied.closest(org + shift, dir)):
            assert (one == other).all()


def test_copied_tracers_keep_options_and_moves():
    centers, radii = cloud()
    tracer = boule.Tracer(centers, radii, solver="fast", threads=2, origin=(1, 2, 3))
    tracer.update(centers + 1)
    copied = pickled(tracer, 4)
    assert copied.stats["solver"] == "fast"
    for one in (tracer, copied):
        one.update(centers + 2, radii / 2)
    org, dir = rays()
    assert (copied.closest(org, dir).t == tracer.closest(org, dir).t).all()


def test_copied_tracers_keep_all_copies():
    """More equal spheres than a leaf holds."""
    centers, radii = cloud()
    centers = np.concatenate([centers, np.repeat(centers[:1], 40, axis=0)])
    radii = np.concatenate([radii, np.repeat(radii[:1], 40)])
    tracer = boule.Tracer(centers, radii)
    org, dir = rays()
    for one, other in zip(tracer.all_hits(org, dir), pickled(tracer, 4).all_hits(org, dir)):
        assert (one == other).all()


def test_copied_tracers_of_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "water.xyz").write_text("3\n\nO 0 0 0\nH 0.9 0 0\nH 0 0.9 0\n")
    tracer = boule.Tracer("water.xyz")
    data = pickle.dumps(tracer)
    monkeypatch.chdir("/")
    org, dir = rays()
    assert (pickle.loads(data).closest(org, dir).t == tracer.closest(org, dir).t).all()


SPAWNED = """
import multiprocessing
import numpy as np
import boule

def trace(tracer, org, dir):
    return tracer.closest(org, dir)

def render(scene):
    return boule.render(scene, size=(40, 30))

if __name__ == "__main__":
    rng = np.random.default_rng(1)
    centers, org, dir = rng.uniform(-3, 3, (3, 200, 3))
    scene = boule.Scene()
    scene.add_spheres(centers, 0.3)
    tracer = boule.Tracer(centers, 0.3)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        hits = pool.apply(trace, (tracer, org, dir))
        picture = pool.apply(render, (scene,))
    assert isinstance(hits, boule.Hits) and isinstance(picture, boule.Picture)
    assert (hits.t == trace(tracer, org, dir).t).all()
    assert (np.asarray(picture) == np.asarray(render(scene))).all()
    print("the same")
"""


def test_processes_that_are_spawned(tmp_path):
    script = tmp_path / "spawned.py"
    script.write_text(SPAWNED)
    told = subprocess.run(
        [sys.executable, script], capture_output=True, text=True, timeout=300, check=False
    )
    assert told.stdout == "the same\n", told.stderr


def test_other_values_are_copied():
    error = None
    try:
        boule.Plastic(color="#xyz")
    except boule.Error as caught:
        error = caught
    hits = boule.Tracer([[0, 0, 0]], 1).closest([[0, 0, 5]], [[0, 0, -1]])
    for one in (boule.Plastic(color="#c03020"), boule.Group("pair"), error, hits):
        copied = pickled(one, 4)
        assert type(copied) is type(one)
    assert pickled(error, 4).key == error.key and str(pickled(error, 4)) == str(error)
    assert pickled(boule.Plastic(color="#c03020"), 4) == boule.Plastic(color="#c03020")


def test_wrong_states_are_refused():
    from boule import _core

    scene = full_scene()
    spheres = _core.data_state(scene.spheres[0]._data)
    picture = _core.picture_state(picture_of(scene))
    for make, state in ((_core.data_in, spheres), (_core.picture_in, picture)):
        make(state)
        for place in range(len(state)):
            for wrong in (b"abc", None, -5, "nothing"):
                if isinstance(state[place], str) and wrong == "nothing":
                    continue
                changed = (*state[:place], wrong, *state[place + 1 :])
                try:
                    make(changed)
                except (boule.Error, TypeError):
                    continue
                assert wrong in (None, -5, b"abc")  # of what has no rule
        with pytest.raises(boule.Error):
            make(state[:-1])
    with pytest.raises(boule.Error):
        _core.data_in(("spheres", b"\0" * 20, *spheres[2:]))  # the radius is 0
