"""load(), frames(), from_ase(), from_particles(): the scenes that `boule render` would show."""

import subprocess

import numpy as np
import pytest
from conftest import program

import boule
from boule import _sources

WATER = "O 0.0 0.0 0.119 -0.8\nH 0.0 0.763 -0.477 0.4\nH 0.0 -0.763 -0.477 0.4\n"
COMMENT = 'Lattice="4 0 0 0 4 0 0 0 4" Properties=species:S:1:pos:R:3:charge:R:1\n'
SIZE = {"size": (48, 36), "spp": 2}


@pytest.fixture
def water(tmp_path):
    path = tmp_path / "water.xyz"
    path.write_text("3\n" + COMMENT + WATER)
    return path


@pytest.fixture
def movie(tmp_path):
    path = tmp_path / "movie.xyz"
    path.write_text("".join(f"2\n\nC 0 0 0\nO {k} 0 0\n" for k in (1, 2, 4)))
    return path


def pixels(scene, **options):
    return np.asarray(boule.render(scene, **{**SIZE, **options}))


def test_particle_file_matches_the_program(water, tmp_path):
    look = {"look": "dark", "color": "charge", "map": ["#0000ff", "#ff0000"], "range": (-1, 1),
            "radius": "covalent", "radii": {"O": 0.8}, "scale": 1.5, "view": "-x", "floor": True,
            "roll": 10, "fov": 30, "margin": 0.1, "wrap": True, "unwrap": True, "boundary": True, "replicate": (2, 1, 1), "nan_color": "white",
            "clip": ["x<0.4", "0,1,1 > -1"], "ghost": "y < 0", "opacity": 0.4}  # fmt: skip
    told = ["--look", "dark", "--color", "charge", "--map", "#0000ff,#ff0000", "--range", "-1,1",
            "--radius", "covalent", "--radii", "O=0.8", "--scale", "1.5", "--view", "-x", "--floor",
            "--roll", "10", "--fov", "30", "--margin", "0.1", "--wrap", "--unwrap", "--boundary", "--replicate", "2x1x1", "--nan-color", "white",
            "--clip", "x<0.4;0,1,1 > -1", "--ghost", "y < 0", "--opacity", "0.4"]  # fmt: skip
    subprocess.run([program(), "render", water, "-o", tmp_path / "a.exr", "--size", "48x36",
                    "--spp", "2", "-q", *told], check=True)  # fmt: skip
    boule.render(water, **SIZE, **look).save(tmp_path / "b.exr")
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
    scene = boule.load(water, **look)
    assert np.array_equal(pixels(scene), pixels(water, **look))
    assert "<svg" in scene.legend and isinstance(scene.camera, boule.Fit)


def test_packed_scene_loads_by_name(water, tmp_path):
    packed = tmp_path / "water.boule"
    subprocess.run([program(), "pack", water, "-o", packed, "-q"], check=True)
    whole = pixels(water)
    assert np.array_equal(pixels(packed), whole)
    assert np.array_equal(pixels(packed, trust=True), whole)
    hits = [boule.Tracer(scene).closest((0, 0, 9), (0, 0, -1)) for scene in (packed, water)]
    assert hits[0].id == hits[1].id and hits[0].t == hits[1].t
    with pytest.raises(boule.Error, match="its spheres cannot be taken apart") as caught:
        boule.load(packed)
    assert caught.value.file == str(packed)
    with pytest.raises(boule.Error, match="is of files"):
        boule.render(boule.Scene(), trust=True)


def test_particles_in_memory_match_the_file(water):
    positions = np.array([[0, 0, 0.119], [0, 0.763, -0.477], [0, -0.763, -0.477]])
    told = pixels(water, color="charge")
    for species in (["O", "H", "H"], np.array(["O", "H", "H"]), [8, 1, 1], np.array([8, 1, 1])):
        made = boule.from_particles(
            positions, species=species, columns={"charge": [-0.8, 0.4, 0.4]},
            cell=np.eye(3) * 4, periodic=(True, True, True), color="charge",
        )  # fmt: skip
        assert np.array_equal(pixels(made), told)


CARBON = boule.from_particles(np.zeros((1, 3)), species=["C"])


@pytest.mark.parametrize(
    "species",
    [
        np.full(3, 6), np.full(3, 6.0), np.full(3, 6, np.float32), np.full(3, 6, np.uint8),
        np.array([b"C"] * 3), [b"C"] * 3, np.array(["C"] * 3, object), [6, "C", np.int64(6)],
        [6.0, np.float32(6), np.str_("C")], [np.array(6)] * 3,
    ],
)  # fmt: skip
def test_species_are_symbols_or_atomic_numbers(species):
    positions = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0.0]])
    made = boule.from_particles(positions, species=species)
    assert (made.spheres[0].radii == CARBON.spheres[0].radii[0]).all()
    assert "C</text>" in made.legend or ">C<" in made.legend


def test_every_element_has_a_symbol():
    made = boule.from_particles(np.arange(357).reshape(119, 3), species=range(119))
    for symbol in ("X", "H", "Og", "Mt", "Ds", "Ts"):
        assert f">{symbol}<" in made.legend
    assert ">118<" not in made.legend and ">0<" not in made.legend


@pytest.mark.parametrize(
    "bad", [6.5, -1, 119, 10**30, np.nan, np.inf, None, True, np.True_, b"\xff", object(), [6]],
)  # fmt: skip
def test_what_is_no_species_is_refused(bad):
    with pytest.raises(boule.Error) as caught:
        boule.from_particles(np.zeros((2, 3)), species=["C", bad])
    assert caught.value.key == "species"
    is_text = isinstance(bad, bytes)
    told = "UTF-8" if is_text else "row 1: expected a symbol or an atomic number from 0 to 118, got "
    assert told in str(caught.value)


def test_columns_take_bytes_and_numpy_numbers():
    points = np.arange(6).reshape(2, 3)
    text = boule.from_particles(points, columns={"t": [b"in", b"out"]}, color="t")
    assert ">in<" in text.legend and ">out<" in text.legend
    flags = boule.from_particles(points, columns={"t": np.array([True, False])}, color="t")
    assert ">True<" in flags.legend
    for numbers in ([np.int64(1), np.int64(2)], [np.float32(1), 2]):
        made = boule.from_particles(points, columns={"q": numbers}, color="q", range=(1, 2))
        assert np.array_equal(made.spheres[0].colors, boule.from_particles(
            points, columns={"q": [1, 2]}, color="q", range=(1, 2)).spheres[0].colors)  # fmt: skip
    with pytest.raises(boule.Error, match="row 1: expected a text, got NoneType") as caught:
        boule.from_particles(points, columns={"t": ["a", None]})
    assert caught.value.key == "t"


@pytest.mark.parametrize("angstrom", [np.nan, np.inf, 0, -1, "nm"])
@pytest.mark.parametrize("species", [None, ["C"]])
def test_a_unit_of_length_is_above_0(angstrom, species):
    with pytest.raises(boule.Error) as caught:
        boule.from_particles(np.zeros((1, 3)), species=species, angstrom=angstrom)
    assert caught.value.key == "angstrom"


@pytest.mark.parametrize(
    ("periodic", "along"),
    [
        (True, [True] * 3), (np.True_, [True] * 3), (False, [False] * 3), ((), []),
        (np.array([True, False, True]), [True, False, True]), ([0, 1, 0], [False, True, False]),
    ],
)  # fmt: skip
def test_cell_edges_are_periodic_or_not(periodic, along):
    assert _sources._along(periodic) == along
    boule.from_particles(np.zeros((1, 3)), cell=np.eye(3), periodic=periodic)


@pytest.mark.parametrize("periodic", [(True,), [True] * 4, 5, None, "xyz1"])
def test_bad_periodic_values_are_refused(periodic):
    with pytest.raises(boule.Error) as caught:
        boule.from_particles(np.zeros((1, 3)), cell=np.eye(3), periodic=periodic)
    assert caught.value.key == "periodic"


def test_masked_values_are_missing_or_refused():
    numbers = np.ma.masked_array([1.0, 2.0, 4.0], mask=[False, True, False])
    positions = [[0, 0, 0], [2, 0, 0], [4, 0, 0]]
    for column in (numbers, [1.0, np.nan, 4.0], numbers.astype("float32")):
        scene = boule.from_particles(positions, columns={"q": column}, color="q", select="x > -1")
        assert [note for note in scene.notes if "1 particle has no number in 'q'" in note]
        shown = boule.from_particles(positions, columns={"q": column}, select="q != missing")
        assert len(shown.spheres[0].radii) == 2
    whole = np.ma.masked_array([1.0, 2.0, 4.0])
    assert not boule.from_particles(positions, columns={"q": whole}, radius="q").warnings
    hidden = np.ma.masked_array(positions, mask=[[0, 0, 0], [1, 1, 1], [0, 0, 0]], dtype=float)
    calls = {
        "positions": lambda: boule.from_particles(hidden),
        "species": lambda: boule.from_particles(
            positions, species=np.ma.masked_array([1, 6, 8], mask=[0, 1, 0])
        ),
        "name": lambda: boule.from_particles(
            positions, columns={"name": np.ma.masked_array(["a", "b", "c"], mask=[0, 1, 0])}
        ),
        "centers": lambda: boule.Tracer(hidden, 1.0),
        "radii": lambda: boule.Tracer(np.asarray(hidden), numbers),
        "org": lambda: boule.Tracer(np.asarray(positions, float), 1.0).closest(hidden, (0, 0, 1)),
    }
    for key, call in calls.items():
        with pytest.raises(boule.Error, match="is a masked array, and") as caught:
            call()
        assert caught.value.key == key


def test_a_unit_of_length_scales_radii():
    nm = boule.from_particles(np.zeros((1, 3)), species=["C"], angstrom=10)
    assert nm.spheres[0].radii[0] == np.float32(CARBON.spheres[0].radii[0] / np.float32(10))


def test_ase_atoms_match_the_file(tmp_path):
    io = pytest.importorskip("ase.io")
    build = pytest.importorskip("ase.build")
    atoms = build.molecule("CH3OH")
    atoms.set_cell([8, 8, 8])
    atoms.set_pbc(True)
    io.write(tmp_path / "a.extxyz", atoms)
    assert np.allclose(pixels(boule.from_ase(atoms)), pixels(tmp_path / "a.extxyz"), atol=1e-4)
    atoms.set_tags(range(6))
    boule.from_ase(atoms, color="tags", quick=True)
    assert boule.from_ase(build.molecule("H2O")).camera is not None  # has no cell


def test_anything_like_atoms_will_do():
    class Two:
        cell = [[0, 0, 0]] * 3

        def get_positions(self):
            return [[0, 0, 0], [1.2, 0, 0]]

        def get_atomic_numbers(self):
            return [6, 8]

    assert pixels(boule.from_ase(Two())).any()


def test_frames_of_a_trajectory(movie, tmp_path):
    subprocess.run([program(), "render", movie, "-o", tmp_path / "f.#.exr", "--frames", "0-2",
                    "--size", "48x36", "--spp", "2", "-q"], check=True)  # fmt: skip
    scenes = list(boule.frames(movie))
    assert len(scenes) == 3
    for number, scene in enumerate(scenes):
        boule.render(scene, **SIZE).save(tmp_path / "one.exr")
        told = (tmp_path / f"f.{number}.exr").read_bytes()
        assert (tmp_path / "one.exr").read_bytes() == told
    assert len(list(boule.frames(movie, range(0, 3, 2)))) == 2
    places = [scene.spheres[0].centers[1, 0] for scene in boule.frames(movie, interpolate=2)]
    assert places == [1, 1.5, 2, 3, 4]
    with pytest.raises(boule.Error, match="without a step"):
        boule.frames(movie, range(0, 3, 2), interpolate=2)
    last = boule.load(movie)
    assert np.array_equal(pixels(boule.load(movie, frame=2)), pixels(last))
    assert not np.array_equal(pixels(boule.load(movie, frame=0)), pixels(last))


def test_frames_choose_once(tmp_path):
    frames = [f"2\n\nA 0 0 0\nA {distance} 0 0\n" for distance in (2, 1, 4)]
    (tmp_path / "grow.xyz").write_text("0\n\n" + "".join(frames))
    scenes = list(boule.frames(tmp_path / "grow.xyz"))
    for scene in scenes[1:]:
        assert list(scene.spheres[0].radii) == [0.5, 0.5]
    notes = [note for scene in scenes for note in scene.notes]
    assert len(notes) == len(set(notes)) == 2
    assert notes[0].endswith("nearest neighbour, 0.5, the smallest of all 4 frames")


def test_files_of_other_programs_are_read(tmp_path):
    ase_io = pytest.importorskip("ase.io")
    from ase import Atoms

    atoms = Atoms("COFe", positions=[(0, 0, 0), (1, 0.5, 0), (0, 2, 1)], cell=[5, 6, 7], pbc=True)
    for name in ("POSCAR", "a.traj", "a.extxyz"):
        ase_io.write(tmp_path / name, atoms)
    own = pixels(tmp_path / "a.extxyz")
    assert np.array_equal(pixels(tmp_path / "a.traj"), own)
    assert np.array_equal(pixels(tmp_path / "POSCAR", topology=str(tmp_path / "a.extxyz")), own)


def test_single_frame_serves_every_number(water, tmp_path):
    scenes = list(boule.frames(water, range(3, 5)))
    assert len(scenes) == 2
    assert np.array_equal(pixels(scenes[0]), pixels(scenes[1]))
    subprocess.run([program(), "render", water, "-o", tmp_path / "f.#.exr", "--frames", "3-4",
                    "--size", "48x36", "--spp", "2", "-q"], check=True)  # fmt: skip
    boule.render(scenes[1], **SIZE).save(tmp_path / "one.exr")
    assert (tmp_path / "one.exr").read_bytes() == (tmp_path / "f.4.exr").read_bytes()
    with pytest.raises(boule.Error, match="has no frame 3"):
        boule.load(water, frame=3)


def test_frames_of_numbered_files(tmp_path):
    for k in (1, 2):
        text = f"schema = 1\n[[sphere]]\nradius = {k}\n[[sphere]]\ncenter = [5, 0, 0]\n"
        (tmp_path / f"s{k}.toml").write_text(text)
    assert len(list(boule.frames(tmp_path / "s#.toml", range(1, 3)))) == 2
    with pytest.raises(boule.Error, match="say which frames"):
        boule.frames(tmp_path / "s1.toml")
    with pytest.raises(boule.Error) as caught:
        list(boule.frames(tmp_path / "s#.toml", range(2, 4)))
    assert "s3.toml" in str(caught.value)


@pytest.mark.parametrize(
    "call, key, words",
    [
        (lambda p: boule.load(p, look="loud"), "look", "unknown name"),
        (lambda p: boule.load(p, color="chrge"), "color", "did you mean 'charge'"),
        (lambda p: boule.load(p, color="#12"), "color", "is not understood"),
        (lambda p: boule.load(p, map="viridis"), "map", "needs 'color'"),
        (lambda p: boule.load(p, colors={"O": "crimsn"}), "colors", "did you mean 'crimson'?"),
        (lambda p: boule.load(p, colors={"Oo": "red"}), "colors", "no particle is of the kind"),
        (lambda p: boule.load(p, nan_color="sliver"), "nan_color", "did you mean 'silver'?"),
        (lambda p: boule.load(p, radius=-1), "radius", "a number above 0"),
        (lambda p: boule.load(p, view=(0, 0, 0)), "view", "three numbers"),
        (lambda p: boule.load(p, frame=7), "frame", "has no frame 7"),
        (lambda p: boule.load(p, frame="last"), "frame", "whole number"),
        (lambda p: boule.load(p, quick=True, look="dark"), "quick", "cannot stand beside"),
        (lambda p: boule.load(p, input_format="doc"), None, "doc"),
        (lambda p: boule.load(p, polygons="fill"), "polygons", "unknown name"),
        (lambda p: boule.frames(p, range(3, 0)), "frames", "expected a range"),
        (lambda p: boule.frames(p, [1, 2]), "frames", "expected a range"),
        (lambda p: boule.from_particles([[0, 0, np.inf]]), "positions", "row 0: must be finite"),
        (lambda p: boule.from_particles([[0, 0, 0]], species=["C", "O"]), "species",
         "expected 1 texts"),
        (lambda p: boule.from_particles([[0, 0, 0]], columns={"q": [1, 2]}), "q", "(1,)"),
        (lambda p: boule.from_particles([[0, 0, 0]], cell=[1, 1, 1]), "cell", "(3, 3)"),
        (lambda p: boule.from_particles([[0, 0, 0]], color="q"), "color", "no column 'q'"),
    ],
)  # fmt: skip
def test_errors_name_the_argument(water, call, key, words):
    with pytest.raises(boule.Error) as caught:
        call(water)
    assert words in str(caught.value)
    if key is not None:
        assert caught.value.key == key


@pytest.mark.parametrize("function", [boule.render, boule.load, boule.frames, boule.from_particles])
def test_unknown_argument_names_the_called_function(function):
    words = rf"{function.__name__}\(\) got an unexpected keyword argument 'colour'"
    with pytest.raises(TypeError, match=f"^{words}$"):
        function("water.xyz", colour="red")


def test_file_error_has_its_place(tmp_path):
    path = tmp_path / "bad.xyz"
    path.write_text("2\n\nC 0 0 0\nC 0 0 x\n")
    with pytest.raises(boule.Error) as caught:
        boule.load(path)
    assert (caught.value.file, caught.value.line) == (str(path), 4)


def test_particles_beside_other_objects(water, tmp_path):
    scene = boule.Scene()
    scene.add_particles(str(water), radius=0.4, material=boule.Metal(), color="#ffcc00")
    scene.add_plane(point=(0, 0, -1), normal=(0, 0, 1))
    path = tmp_path / "same.toml"
    path.write_text(
        'schema = 1\n[material.m]\ntype = "metal"\n[[particles]]\nfile = "water.xyz"\n'
        'radius = 0.4\nmaterial = "m"\ncolor = "#ffcc00"\n'
        "[[plane]]\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"
    )
    assert np.array_equal(pixels(scene), pixels(path))


@pytest.mark.parametrize("columns", ["radius,x,y,z", ["radius", "x", "y", "z"]])
def test_columns_can_be_named(tmp_path, columns):
    path = tmp_path / "a.csv"
    path.write_text("2,1,0,0\n3,0,5,0\n")
    scene = boule.load(path, columns=columns)
    assert [float(r) for r in scene.spheres[0].radii] == [2, 3]
