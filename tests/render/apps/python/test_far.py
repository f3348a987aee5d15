"""Far from 0: every way in has the picture and the hits that the scene has at 0."""

import subprocess

import boule
import numpy as np
import pytest
from conftest import program

SHIFTS = [(10.0**k, -2 * 10.0**k, 5 * 10.0 ** (k - 1)) for k in (4, 6, 9)]


def grid(values):
    """Multiples of 2^-10, which double has at 10^9 too."""
    return np.round(np.asarray(values) * 1024) / 1024


def balls():
    rng = np.random.default_rng(5)
    centers = grid(rng.normal(size=(60, 3)) * 1.5 + [0.5, 0.25, 0])
    return centers, grid(rng.uniform(0.1, 0.4, 60))


def rays():
    rng = np.random.default_rng(6)
    org = grid(rng.normal(size=(2000, 3)) * 6)
    return org, balls()[0][rng.integers(0, 60, 2000)] + rng.normal(size=(2000, 3)) / 5 - org


def write(folder, shift, form):
    centers, radii = balls()
    rows = np.column_stack([centers + shift, radii])
    path = folder / f"scene.{form}"
    if form in ("npy", "boule"):
        np.save(folder / "scene.npy", rows)
    if form == "boule":
        subprocess.run([program(), "pack", folder / "scene.npy", "-o", path, "-q"], check=True)
    if form == "toml":
        path.write_text(
            "schema = 1\n"
            + "".join(f"[[sphere]]\ncenter = {row[:3].tolist()}\nradius = {row[3]}\n" for row in rows)
        )
    if form == "nff":
        x, y, z = shift
        text = f"v\nfrom {x + 3!r} {y!r} {z + 9!r}\nat {x!r} {y!r} {z!r}\nup 0 1 0\nangle 40\n"
        text += f"resolution 64 48\nl {x + 5!r} {y + 9!r} {z!r}\n"
        path.write_text(text + "".join("s %r %r %r %r\n" % tuple(row) for row in rows.tolist()))
    return path


def same(one, other):
    return all((a == b).all() for a, b in zip(one, other))


def picture(scene):
    return np.asarray(boule.render(scene, size=(64, 48), spp=2))


@pytest.mark.parametrize("form", ["npy", "toml", "nff", "boule"])
def test_files_are_what_they_are_at_zero(tmp_path, form):
    org, dir = rays()
    near = write(tmp_path, (0.0, 0.0, 0.0), form)
    near_picture, near_hits = picture(near), boule.Tracer(near).closest(org, dir)
    assert (near_hits.id >= 0).sum() > 500
    for shift in SHIFTS:
        far = write(tmp_path, shift, form)
        assert (picture(far) == near_picture).all(), shift
        assert same(boule.Tracer(far).closest(org + shift, dir), near_hits), shift
        if form == "boule":
            continue
        scene = boule.load(far)
        assert scene.origin == shift
        assert (picture(scene) == near_picture).all(), shift
        assert same(boule.Tracer(scene).closest(org + shift, dir), near_hits), shift
        centers = np.concatenate([np.asarray(one.centers) for one in scene.spheres])
        assert (centers == balls()[0] + shift).all()


def test_arrays_are_what_they_are_at_zero():
    centers, radii = balls()
    org, dir = rays()
    near = boule.Tracer(centers, radii).closest(org, dir)
    for shift in SHIFTS:
        assert same(boule.Tracer(centers + shift, radii).closest(org + shift, dir), near)
        scene = boule.Scene()
        scene.add_spheres(centers + shift, radii)
        assert same(boule.Tracer(scene).closest(org + shift, dir), near)
        scene.spheres = [boule.Sphere(center=c, radius=r) for c, r in zip(centers + shift, radii)]
        assert same(boule.Tracer(scene).closest(org + shift, dir), near)


def test_floats_too_have_an_origin():
    """Whole numbers are floats out there, but a camera that is fitted to them is not."""
    rng = np.random.default_rng(3)
    centers = rng.integers(-9, 9, (50, 3)).astype(np.float32)
    shift = np.float32([1e7, -2e6, 5e6])
    pictures = []
    for moved in (np.float32([0, 0, 0]), shift):
        scene = boule.Scene()
        scene.add_spheres(centers + moved, np.float32(0.75))
        pictures.append(picture(scene))
    assert (pictures[0] == pictures[1]).all()


def test_groups_that_are_far_inside():
    centers, radii = balls()
    org, dir = rays()
    shift = np.array([1e6, -2e6, 5e5])

    def scene(inside, outside):
        made = boule.Scene()
        made.add_group("all").add_spheres(centers + inside, radii)
        made.add_instance("all", translate=outside)
        return made

    near = boule.Tracer(scene(0 * shift, 0 * shift)).closest(org, dir)
    for inside, outside in ((shift, 0 * shift), (0 * shift, shift), (3 * shift, -2 * shift)):
        assert same(boule.Tracer(scene(inside, outside)).closest(org + shift, dir), near)


def test_positions_are_those_of_the_scene():
    centers, radii = balls()
    shift = np.array([1e7, 2e7, -1e7])
    pictures = []
    for moved in (0 * shift, shift):
        scene = boule.Scene()
        scene.add_spheres(centers + moved, radii)
        pictures.append(boule.render(scene, size=(64, 48), spp=1, aov="position,id"))
    near, far = (one.aovs["position"] for one in pictures)
    assert near.dtype == np.float32 and far.dtype == np.float64
    met = near.any(axis=-1)
    assert 0 < met.sum() < met.size
    assert (far[met] == near[met] + shift).all() and (far[~met] == 0).all()
    assert (pictures[1].channels["P.X"] == pictures[0].channels["P.X"]).all()


def test_what_no_origin_helps_is_told():
    scene = boule.Scene()
    scene.add_sphere(center=(0.3, 0, 0), radius=1)
    scene.add_sphere(center=(1e7 + 0.3, 0, 0), radius=1)
    notes = boule.render(scene, size=(16, 12), spp=1).notes
    assert [note for note in notes if "radii of the smallest sphere" in note] == [
        "positions are rounded by up to 0.3 radii of the smallest sphere: the spheres reach too "
        "far for 32-bit floats"
    ]
