"""Scene and its objects: what scene files say, by the same names."""

import copy
import inspect
import pickle
import re
import subprocess

import numpy as np
import pytest
from conftest import ROOT, program

import boule
from boule import _core, _objects

FIELDS = _core.fields()
TABLES = [
    cls
    for cls in vars(_objects).values()
    if isinstance(cls, type) and issubclass(cls, _objects.Table) and cls is not _objects.Table
]


def test_every_listed_type_has_a_class():
    kinds = {kind: set(types) for kind, types in FIELDS.items() if kind != "scene"}
    known = {}
    for cls in TABLES:
        kind = "fit" if cls is boule.Fit else cls._kind
        known.setdefault(kind, set()).add(cls._type or kind)
    for kind, types in kinds.items():
        assert known[kind] == types, kind
    assert all(cls.__name__ in boule.__all__ for cls in TABLES)


@pytest.mark.parametrize("cls", TABLES, ids=lambda cls: cls.__name__)
def test_arguments_are_the_fields_with_their_defaults(cls):
    kind = "fit" if cls is boule.Fit else cls._kind
    arguments = inspect.signature(cls.__init__).parameters
    required, _ = _objects._required(kind, cls._type or kind)  # see test_objects.py
    for name, default, of_file in FIELDS.get(kind, {}).get(cls._type or kind, []):
        if of_file and name == "size":
            continue
        assert arguments[name].default == (None if name in required else default), name
        assert hasattr(cls, name)
    assert all(name in cls.__doc__ for name in arguments if name != "self")


def test_scene_has_every_field_as_attribute():
    scene = boule.Scene()
    names = {"camera.distortion": "camera", "background.ambient": "ambient",
             "background.backdrop": "backdrop"}  # fmt: skip
    for key in FIELDS["scene"]:
        name = names.get(key, key)
        assert hasattr(scene, name) or hasattr(scene, name + "s"), key
    assert hasattr(scene, "origin")


def test_every_documented_key_is_an_argument():
    text = (ROOT / "docs" / "scene_format.md").read_text()
    section = text[text.index("### `[[particles]]`") :]
    keys = re.findall(r"^\| `(\w+)`", section[: section.index("The table")], flags=re.M)
    assert len(keys) > 8
    for key in keys:
        assert key in boule.Particles._defaults, key
    section = text[text.index("### `[[spheres]]`") :]
    keys = re.findall(r"^\| `(\w+)`", section[: section.index("```")], flags=re.M)
    arguments = set(inspect.signature(boule.Spheres).parameters)
    for key in set(keys) - {"file", "radius"}:  # which are `centers` and `radii`
        assert key in arguments, key


def test_every_program_option_is_an_argument():
    told = subprocess.run([program(), "render", "--help"], capture_output=True, text=True).stdout
    options = {name.replace("-", "_") for name in re.findall(r"--([a-z][a-z-]+)", told)}
    assert len(options) > 30
    # Of files, messages and processes; save() has exposure and compression, frames() the frames, and
    # a scene its camera.
    not_here = {"camera", "checkpoint", "claim", "mpi", "resume", "shard", "help", "output", "format",
                "legend", "stats", "quiet", "verbose", "skip_existing", "frames", "turn", "load_limit",
                "fps", "exposure", "compression", "interpolate", "preview"}  # fmt: skip
    arguments = set(inspect.signature(boule.render).parameters)
    assert options - not_here <= arguments
    for name in ("exposure", "compression"):
        assert name in boule.Picture.save.__doc__


def test_values_are_set_checked_and_kept():
    camera = boule.Pinhole(eye=(0, 0, 5), look_at=np.zeros(3))
    assert camera.fov == 45 and camera.look_at == (0.0, 0.0, 0.0)
    camera.fov = np.float32(30)
    assert camera.fov == 30
    with pytest.raises(boule.Error) as caught:
        camera.fov = 180
    assert caught.value.key == "fov" and camera.fov == 30
    with pytest.raises(boule.Error, match="did you mean 'fov'"):
        camera.fvo = 3
    assert camera == boule.Pinhole(eye=(0, 0, 5), look_at=(0.0, 0.0, 0.0), fov=30)
    for copied in (copy.copy(camera), copy.deepcopy(camera), pickle.loads(pickle.dumps(camera))):
        assert copied == camera
        copied.fov = 20
        assert camera.fov == 30


@pytest.mark.parametrize(
    "make, key, words",
    [
        (lambda: boule.Plastic(colour="#ffffff"), "colour", "did you mean 'color'?"),
        (lambda: boule.Plastic(color="rde"), "color", "is no colour"),
        (lambda: boule.Plastic(color=(1, 2)), "color", "3"),
        (lambda: boule.Plastic(specular=-1), "specular", "must be finite and 0 or above, is -1"),
        (lambda: boule.Glass(ior="high"), "ior", "expected a number"),
        (lambda: boule.Glass(ior=float("nan")), "ior", "finite"),
        (lambda: boule.Pinhole(eye=(1, 1, 1)), "look_at", "missing key 'look_at'"),
        (lambda: boule.Pinhole(eye=(1, 1, 1), look_at=(1, 1, 1)), "look_at", "must differ"),
        (lambda: boule.ThinLens(eye=(0, 0, 1), look_at=(0, 0, 0), f_number=2), "focal_length", ""),
        (lambda: boule.Lens(eye=(0, 0, 1), look_at=(0, 0, 0), file="no.lens"), "file", "no.lens"),
        (lambda: boule.Fit(margin=0.5), "margin", "below 0.5"),
        (lambda: boule.PointLight(falloff="cubic"), "falloff", "inverse_square"),
        (lambda: boule.SphereLight(radius=0), "radius", "must be finite and above 0"),
        (lambda: boule.Sphere(radius=object()), "radius", "got object"),
        (lambda: boule.Sphere(radius=10**400), "radius", "too large"),
        (lambda: boule.Plane(normal=(0, 0, 0)), "normal", "zero vector"),
        (lambda: boule.Plane(material=3), "material", "expected a name or a material, got int"),
        (lambda: boule.Instance(), "group", "missing key 'group'"),
        (lambda: boule.ImageSettings(size=(1, 2, 3)), "size", "2"),
        (lambda: boule.RenderSettings(method="magic"), "method", "whitted"),
        (lambda: boule.EnvironmentBackground(), "file", "missing key 'file'"),
        (lambda: boule.EnvironmentBackground(pixels=np.zeros((2, 2))), "pixels", "(H, W, 3)"),
        (lambda: boule.Distortion(st=np.zeros((2, 2, 3))), "st", "(H, W, 2)"),
        (lambda: boule.Particles(file="a.xyz", scale=0), "scale", "above 0"),
        (lambda: boule.Spheres(np.zeros((2, 3)), 1, colors=[[0, 0, 2], [0, 0, 0]]), "colors",
         "row 0: must be from 0 to 1, is 2"),
        (lambda: boule.Spheres(np.zeros((2, 3)), 1, scalar=[1, np.inf]), "scalar", "row 1"),
        (lambda: boule.Spheres(np.zeros((2, 3)), 1, map="viridis"), "map", "goes with 'scalar'"),
    ],
)  # fmt: skip
def test_errors_are_those_of_scene_files(make, key, words):
    with pytest.raises(boule.Error) as caught:
        make()
    assert words in str(caught.value)
    assert caught.value.key == key
    assert caught.value.file is None and caught.value.line is None


def test_errors_of_files_have_their_place(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text("schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov = 200\n")
    with pytest.raises(boule.Error) as caught:
        boule.load(path)
    assert (caught.value.file, caught.value.line, caught.value.key) == (str(path), 5, "camera.fov")
    assert caught.value.column == 7
    with pytest.raises(boule.Error, match="No such file"):
        boule.render(tmp_path / "none.toml")


def same_as_file(scene, text, tmp_path, **options):
    """Whether a scene and a scene file give one picture."""
    path = tmp_path / "same.toml"
    path.write_text(text)
    told = np.asarray(boule.render(path, size=(48, 36), **options))
    made = np.asarray(boule.render(scene, size=(48, 36), **options))
    assert told.any()
    return np.array_equal(told, made)


def test_scene_matches_the_files_picture(tmp_path):
    scene = boule.Scene()
    scene.materials["red"] = boule.Plastic(color=(0.8, 0.1, 0.1), reflect=0.2)
    scene.add_sphere(center=(0, 1, 0), material="red")
    scene.add_sphere(center=(2, 1, 0), material=boule.Glass(), color=None)
    scene.add_plane(normal=(0, 1, 0), color="#808080")
    scene.add_group("pair").add_sphere(center=(0, 0.3, 2), radius=0.3)
    scene.groups["pair"].add_sphere(center=(1, 0.3, 2), radius=0.2, material="red")
    scene.add_instance("pair")
    scene.add_instance(scene.groups["pair"], translate=(0, 0, 1), material="red")
    scene.camera = boule.ThinLens(
        eye=(0, 2, 8), look_at=(0, 1, 0), f_number=4, focal_length=0.5, focus=(0, 1, 1)
    )
    scene.background = boule.GradientBackground(top=(0.2, 0.4, 1))
    scene.ambient = (0.05, 0.05, 0.06)
    scene.backdrop = "#102030"
    scene.lights = [boule.DirectionalLight(direction=(-1, -1, -1)), boule.SphereLight(
        center=(0, 6, 4), radiance=(9, 9, 9), radius=0.5)]  # fmt: skip
    text = """
schema = 1
sphere = [{center = [0, 1, 0], material = "red"}, {center = [2, 1, 0], material = "glass"}]
plane = [{normal = [0, 1, 0], color = "#808080"}]
instance = [{group = "pair"}, {group = "pair", translate = [0, 0, 1], material = "red"}]
light = [{type = "directional", direction = [-1, -1, -1]},
         {type = "sphere", center = [0, 6, 4], radiance = [9, 9, 9], radius = 0.5}]
[group.pair]
sphere = [{center = [0, 0.3, 2], radius = 0.3}, {center = [1, 0.3, 2], radius = 0.2, material = "red"}]
[material.red]
type = "plastic"
color = [0.8, 0.1, 0.1]
reflect = 0.2
[material.glass]
type = "glass"
[camera]
type = "thin_lens"
eye = [0, 2, 8]
look_at = [0, 1, 0]
f_number = 4
focal_length = 0.5
focus = [0, 1, 1]
[background]
type = "gradient"
top = [0.2, 0.4, 1]
ambient = [0.05, 0.05, 0.06]
backdrop = "#102030"
"""
    for options in ({"spp": 4}, {"spp": 4, "method": "path"}):
        assert same_as_file(scene, text, tmp_path, **options)


def test_arrays_are_the_picture_of_their_files(tmp_path):
    rng = np.random.default_rng(5)
    centers = rng.uniform(-2, 2, (200, 3)).astype(np.float32)
    radii = rng.uniform(0.05, 0.3, 200).astype(np.float32)
    rgb, heat = rng.uniform(0, 1, (200, 3)), rng.normal(size=200)
    np.save(tmp_path / "s.npy", np.column_stack([centers, radii]))
    np.save(tmp_path / "c.npy", centers)
    np.save(tmp_path / "rgb.npy", rgb)
    np.save(tmp_path / "heat.npy", heat)
    scene = boule.Scene()
    shiny = boule.Plastic()
    scene.add_spheres(centers, radii, colors=rgb, material=shiny)
    scene.add_sphere(center=(0, 3, 0))
    scene.add_spheres(centers, 0.1, scalar=heat, map=["#000000", "#ff0000"], material=shiny)
    scene.add_spheres(centers, radii * 0.5, color="#00ff00")
    np.save(tmp_path / "h.npy", np.column_stack([centers, radii * 0.5]))
    text = """
schema = 1
[material.shiny]
type = "plastic"
[[spheres]]
file = "s.npy"
colors = "rgb.npy"
material = "shiny"
[[sphere]]
center = [0, 3, 0]
[[spheres]]
file = "c.npy"
radius = 0.1
scalar = "heat.npy"
map = ["#000000", "#ff0000"]
material = "shiny"
[[spheres]]
file = "h.npy"
color = "#00ff00"
"""
    assert same_as_file(scene, text, tmp_path)
    ids = boule.render(scene, size=(48, 36), aov="id").aovs["id"]
    told = boule.render(tmp_path / "same.toml", size=(48, 36), aov="id").aovs["id"]
    assert np.array_equal(ids, told)


def test_spheres_show_what_they_hold():
    centers = np.arange(12, dtype=np.float32).reshape(4, 3)
    spheres = boule.Spheres(centers, 0.5, colors=np.full((4, 3), 7, np.uint8))
    centers[:] = 0
    assert len(spheres) == 4 and np.array_equal(spheres.centers.ravel(), np.arange(12))
    assert (spheres.radii == 0.5).all() and (spheres.colors == 7).all()
    with pytest.raises(ValueError):
        spheres.radii[0] = 1
    assert boule.Spheres(np.zeros((1, 3)), 1).colors is None
    exact = boule.Spheres([[1e9 + 0.125, 0, 0]], 1)
    assert exact.centers[0, 0] == 1e9 + 0.125
    views = exact.centers
    del exact
    assert views[0, 0] == 1e9 + 0.125


def test_far_spheres_look_as_near_ones():
    rng = np.random.default_rng(6)
    centers = np.round(rng.uniform(-2, 2, (50, 3)) * 1024) / 1024
    near, far = boule.Scene(), boule.Scene()
    near.add_spheres(centers, 0.3)
    far.add_spheres(centers + [1e6, 2e6, -1e6], 0.3)
    assert np.array_equal(*(np.asarray(boule.render(one, size=(40, 30))) for one in (near, far)))
    assert boule.render(far, size=(40, 30)).notes[0].startswith("points are counted from")
    far.origin = (0, 0, 0)
    assert not np.array_equal(
        *(np.asarray(boule.render(one, size=(40, 30))) for one in (near, far))
    )


def test_pictures_and_lenses_in_memory(scenes, tmp_path, ball):
    sky = np.random.default_rng(7).uniform(0, 2, (8, 16, 3)).astype(np.float32)
    ball.background = boule.EnvironmentBackground(pixels=sky, rotation=30)
    rows = [line.split("#")[0].split() for line in open(scenes / "double_gauss_50mm.lens")]
    surfaces = np.array([[float(x) for x in row] for row in rows if row])
    eye = {"eye": (0, 2, 6), "look_at": (0, 1, 0)}
    from_file = boule.Lens(file=str(scenes / "double_gauss_50mm.lens"), film_width=20, **eye)
    ball.camera = from_file
    told = np.asarray(boule.render(ball, spp=4))
    ball.camera = boule.Lens(surfaces=surfaces, film_width=20, **eye)
    assert told.any() and np.array_equal(np.asarray(boule.render(ball, spp=4)), told)
    y, x = np.mgrid[0:3, 0:4]
    st = np.stack([(x + 0.5) / 4, 1 - (y + 0.5) / 3], axis=2)
    ball.camera = boule.Pinhole(**eye)
    straight = np.asarray(boule.render(ball))
    ball.camera.distortion = boule.Distortion(st=st)
    assert np.allclose(np.asarray(boule.render(ball)), straight, atol=0.05)
    ball.camera.distortion = boule.Distortion(st=st * 0.5)
    assert not np.allclose(np.asarray(boule.render(ball)), straight, atol=0.05)


def test_cameras_may_move(tmp_path):
    scene = boule.Scene(camera=boule.Pinhole(look_at=(0, 0, 0), key=[
        {"frame": 0, "eye": (0, 0, 6)}, {"frame": 10, "eye": (6, 0, 0.5)}]))  # fmt: skip
    scene.add_sphere()
    scene.add_sphere(center=(2, 0, 0), radius=0.5)
    first, last = (np.asarray(boule.render(scene, size=(40, 30), frame=k)) for k in (0, 10))
    assert not np.array_equal(first, last)


@pytest.mark.parametrize(
    "spoil, key",
    [
        (lambda s: s.lights.append("lamp"), "light[1]"),
        (lambda s: s.planes.append(boule.Sphere()), "plane[1]"),
        (lambda s: s.spheres.append(3), "spheres[1]"),
        (lambda s: s.materials.update(x=1), "material.x"),
        (lambda s: s.groups.update(x=1), "group.x"),
        (lambda s: s.add_sphere(material="gold"), "sphere[1].material"),
        (lambda s: s.add_instance("nothing"), "instance[0].group"),
    ],
)
def test_wrong_scene_names_its_key(ball, spoil, key):
    spoil(ball)
    with pytest.raises(boule.Error) as caught:
        boule.render(ball)
    assert caught.value.key == key


def test_groups_that_contain_themselves(ball):
    group = ball.add_group("a")
    group.add_instance("a")
    ball.add_instance("a")
    with pytest.raises(boule.Error, match="makes a cycle"):
        boule.render(ball)
    deep = []
    deep.append(deep)
    with pytest.raises(boule.Error, match="nested too deep"):
        boule.Plastic(color=deep)


def test_clips_are_those_of_scene_files(ball, tmp_path):
    whole = np.asarray(boule.render(ball))
    clip = ball.add_clip(point=(0.3, 0, 0), normal=(1, 0, 0.2))
    assert ball.clips == [clip]
    cut = np.asarray(boule.render(ball))
    assert not np.array_equal(cut, whole)
    path = tmp_path / "cut.toml"
    path.write_text(
        'schema = 1\n[image]\nsize = [64, 48]\n[camera]\neye = [0, 2, 6]\nlook_at = [0, 1, 0]\n'
        '[[light]]\ntype = "point"\nposition = [4, 6, 4]\n[material.m]\ntype = "plastic"\n'
        'color = "#c83214"\n[[sphere]]\ncenter = [0, 1, 0]\nmaterial = "m"\n[[plane]]\n'
        "[[clip]]\npoint = [0.3, 0, 0]\nnormal = [1, 0, 0.2]\n"
    )
    assert np.array_equal(np.asarray(boule.render(path)), cut)
    read = boule.load(path)
    assert np.array_equal(np.asarray(boule.render(read)), cut)
    assert np.array_equal(np.asarray(boule.render(pickle.loads(pickle.dumps(read)))), cut)
    assert boule.Tracer(ball).closest((2, 1, 0), (-1, 0, 0)).t[0] == 1  # it meets the whole
    with pytest.raises(boule.Error, match="must not be the zero vector") as caught:
        boule.Clip(normal=(0, 0, 0))
    assert caught.value.key == "normal"
