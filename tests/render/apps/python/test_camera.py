"""The camera of a scene: its rays, and the numbers of a fitted one."""

import numpy as np
import pytest

import boule

POSE = {"eye": (1, 2, 9), "look_at": (0, 0.5, 0)}
WIDE_LENS = [[50, 10, 1.6, 20], [-50, 0, 1, 20]]
CAMERAS = {
    "pinhole": boule.Pinhole(fov=40, **POSE),
    "orthographic": boule.Orthographic(height=9, **POSE),
    "fisheye": boule.Fisheye(fov=300, **POSE),
    "thin_lens": boule.ThinLens(aperture=0.5, **POSE),
    "lens": boule.Lens(surfaces=WIDE_LENS, **POSE),
    "fit": None,
    "orthographic fit": boule.Fit(type="orthographic", direction=(1, -1, -2)),
}


def cloud(camera=None, shift=(0, 0, 0), count=300):
    rng = np.random.default_rng(3)
    scene = boule.Scene(camera=camera)
    scene.add_spheres(rng.uniform(-3, 3, (count, 3)) + shift, rng.uniform(0.1, 0.6, count))
    return scene


def unsigned(ids):
    return np.asarray(ids, np.int64) % 2**32


@pytest.mark.parametrize("kind", CAMERAS)
def test_rays_are_those_of_aovs(kind):
    scene = cloud(CAMERAS[kind])
    picture = boule.render(scene, size=(70, 50), aov="depth,id")
    rays = scene.rays((70, 50))
    assert rays.origin.shape == rays.direction.shape == (50, 70, 3)
    assert rays.origin.dtype == np.float64 and rays.direction.dtype == np.float32
    hits = boule.Tracer(scene).closest(*rays)
    x, y, z = np.moveaxis(rays.direction.astype(np.float64), -1, 0)
    length = np.sqrt(x * x + y * y + z * z)
    assert (unsigned(hits.id) == picture.aovs["id"]).all()
    assert hits.hit.any() and not hits.hit.all()
    depth = np.where(hits.hit, hits.t * length, np.inf).astype(np.float32)
    assert (depth == picture.aovs["depth"]).all()


@pytest.mark.parametrize("kind", CAMERAS)
@pytest.mark.parametrize("filter", ["box", "tent"])
def test_samples_are_those_of_pictures(kind, filter):
    """A picture of black and white: its pixels tell how many of their samples hit something."""
    scene = cloud(CAMERAS[kind])
    options = {"size": (40, 30), "spp": 3, "filter": filter, "seed": 7}
    picture = boule.render(scene, background="transparent", **options)
    tracer = boule.Tracer(scene)
    met = [tracer.any(*scene.rays(sample=k, **options)) for k in range(3)]
    assert np.allclose(picture.alpha, np.mean(met, axis=0), rtol=0, atol=1e-6)
    assert (met[0] != met[1]).any()


def test_a_crop_is_part_of_frames():
    scene = cloud(CAMERAS["thin_lens"])
    whole = scene.rays((40, 30), 4, 2)
    part = scene.rays((40, 30), 4, 2, crop=(5, 3, 25, 11))
    assert (part.origin == whole.origin[3:11, 5:25]).all()
    assert (part.direction == whole.direction[3:11, 5:25]).all()


def test_rays_count_from_where_the_scene_does():
    scene = cloud(shift=(5e7, -2e7, 1e7))
    picture = boule.render(scene, size=(64, 48), aov="id")
    hits = boule.Tracer(scene).closest(*scene.rays((64, 48)))
    assert (unsigned(hits.id) == picture.aovs["id"]).all()


def test_moving_cameras_have_rays_per_frame():
    moving = boule.Pinhole(
        key=[
            {"frame": 0, "eye": (0, 0, 9), "look_at": (0, 0, 0)},
            {"frame": 10, "eye": (10, 0, 9), "look_at": (0, 0, 0)},
        ]
    )
    scene = cloud(moving)
    eyes = [scene.rays((2, 2), frame=frame).origin[0, 0, 0] for frame in (0, 10)]
    assert eyes == [0, 10]


def test_directions_are_zero_without_a_ray():
    for fov, corner in ((180, False), (360, True)):
        camera = boule.Fisheye(fov=fov, **POSE)
        none = (cloud(camera).rays((64, 64)).direction == 0).all(axis=-1)
        assert none[0, 0] == none[-1, -1] == corner and not none[32, 32]


@pytest.mark.parametrize("kind", ["fit", "orthographic fit"])
@pytest.mark.parametrize("shift", [(0, 0, 0), (5e7, -2e7, 1e7)])
def test_a_fitted_camera_gives_the_same_picture(kind, shift):
    scene = cloud(CAMERAS[kind], shift)
    fitted = np.asarray(boule.render(scene, size=(60, 40)))
    camera = scene.fitted_camera((60, 40))
    assert type(camera) is (boule.Pinhole if kind == "fit" else boule.Orthographic)
    scene.camera = camera
    assert (np.asarray(boule.render(scene, size=(60, 40))) == fitted).all()


def test_a_fitted_camera_keeps_the_distortion():
    st = np.stack(np.meshgrid(np.linspace(0.1, 0.9, 9), np.linspace(0.1, 0.9, 9)), axis=-1)
    scene = cloud(boule.Fit(distortion=boule.Distortion(st=st)))
    fitted = np.asarray(boule.render(scene, size=(60, 40)))
    scene.camera = scene.fitted_camera((60, 40))
    assert (np.asarray(boule.render(scene, size=(60, 40))) == fitted).all()


def test_any_scene_can_be_fitted():
    scene = cloud(CAMERAS["fisheye"])
    camera = scene.fitted_camera((60, 40))
    assert camera == cloud().fitted_camera((60, 40)) and type(scene.camera) is boule.Fisheye


@pytest.mark.parametrize(
    ("given", "key"),
    [
        ({"size": (0, 5)}, "size"),
        ({"size": "5"}, "size"),
        ({"spp": 0}, "spp"),
        ({"spp": 4, "sample": 4}, "sample"),
        ({"sample": -1}, "sample"),
        ({"sample": 1.5}, "sample"),
        ({"filter": "blur"}, "filter"),
        ({"crop": (0, 0, 900, 900), "size": (8, 8)}, None),
        ({"seed": -1}, "seed"),
    ],
)
def test_wrong_arguments_are_refused(given, key):
    with pytest.raises(boule.Error) as caught:
        cloud(count=3).rays(**given)
    assert key is None or caught.value.key == key
