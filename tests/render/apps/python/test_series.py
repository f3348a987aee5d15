"""Series of particles in memory, beside those of files."""

import numpy as np
import pytest

import boule

COUNT = 60


def lattice(frame):
    """An expanding lattice with a column whose range grows."""
    corners = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)[:COUNT]
    return {
        "positions": corners * (1 + 0.5 * frame) + [0, 0, 0.1 * frame],
        "columns": {"speed": np.linspace(0, 1 + frame, COUNT)},
    }


def as_file(path, frames):
    with open(path, "w", encoding="ascii") as file:
        for frame in frames:
            file.write(f"{COUNT}\nProperties=pos:R:3:speed:R:1\n")
            for place, speed in zip(frame["positions"], frame["columns"]["speed"]):
                file.write(" ".join(repr(float(x)) for x in (*place, speed)) + "\n")
    return path


class Structure:
    """As pymatgen has it."""

    class Element(str):
        @property
        def symbol(self):
            return self.rstrip("+-")

    class Lattice:
        matrix = np.eye(3) * 2.8
        pbc = (True, True, False)

    cart_coords = np.array([[0.0, 0, 0], [1.4, 1.4, 1.4]])
    species = [Element("Cs+"), Element("Cl-")]
    lattice = Lattice()


def test_structures_are_read_alike():
    expected = boule.from_particles(
        Structure.cart_coords, species=["Cs", "Cl"], cell=Structure.Lattice.matrix,
        periodic=Structure.Lattice.pbc, replicate=(2, 2, 1), floor=True,
    )  # fmt: skip
    loaded = boule.load(Structure(), replicate=(2, 2, 1), floor=True)
    assert (loaded.spheres[0].centers == expected.spheres[0].centers).all()
    assert (loaded.spheres[0].radii == expected.spheres[0].radii).all()
    assert len(loaded.planes) == len(expected.planes) == 1
    picture = boule.render(Structure(), size=(64, 48), replicate=(2, 2, 1), floor=True)
    assert np.array_equal(picture, boule.render(expected, size=(64, 48)))
    assert len(list(boule.series([Structure(), Structure()]))) == 2
    with pytest.raises(TypeError, match="water"):
        boule.load(Structure(), water=True)
    with pytest.raises(boule.Error, match="scale"):
        boule.load(Structure(), scale=0)


@pytest.mark.parametrize("look", [{}, {"color": "speed"}, {"color": "speed", "floor": True}])
@pytest.mark.parametrize("count", [1, 2, 4])
def test_pictures_are_those_of_files(tmp_path, look, count):
    frames = [lattice(k) for k in range(count)]
    file = as_file(tmp_path / "run.xyz", frames)
    of_file = list(boule.frames(file, **look))
    in_memory = list(boule.series(frames, **look))
    assert len(in_memory) == count
    for scene, expected in zip(in_memory, of_file):
        assert scene.camera == expected.camera and scene.legend == expected.legend
        assert (scene.spheres[0].radii == expected.spheres[0].radii).all()
        pictures = [np.asarray(boule.render(one, size=(64, 48))) for one in (scene, expected)]
        assert (pictures[0] == pictures[1]).all()


def test_one_camera_and_radii_for_all():
    scenes = list(boule.series([lattice(k) for k in range(4)], color="speed"))
    cameras = {repr(scene.camera) for scene in scenes}
    radii = {float(radius) for scene in scenes for radius in scene.spheres[0].radii}
    legends = {scene.legend for scene in scenes}
    assert len(cameras) == len(radii) == len(legends) == 1
    assert type(scenes[0].camera) is boule.Pinhole
    told = [note for scene in scenes for note in scene.notes]
    assert len(told) == len(set(told))


def test_atoms_of_ase():
    class Atoms:
        pbc = (False, False, False)
        cell = np.zeros((3, 3))

        def __init__(self, step):
            self.step = step

        def get_positions(self):
            return np.array([[0, 0, 0], [1.0 + self.step, 0, 0]])

        def get_atomic_numbers(self):
            return np.array([8, 1])

    scenes = list(boule.series([Atoms(0), Atoms(1)], look="plain"))
    assert [scene.spheres[0].centers[1, 0] for scene in scenes] == [1, 2]
    one = boule.from_ase(Atoms(1), look="plain")
    assert (one.spheres[0].radii == scenes[1].spheres[0].radii).all()


def test_trajectories_of_mdanalysis():
    mda = pytest.importorskip("MDAnalysis")
    universe = mda.Universe.empty(3, trajectory=True)
    universe.add_TopologyAttr("elements", ["O", "H", "H"])
    universe.add_TopologyAttr("names", ["OW", "H1", "H2"])
    steps = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[5, 0, 0], [6, 0, 0], [5, 1, 0]]], float)
    universe.load_new(steps, order="fac")
    scenes = list(boule.series((universe for _ in universe.trajectory), look="plain"))
    assert [scene.spheres[0].centers[0, 0] for scene in scenes] == [0, 5]
    assert scenes[0].camera == scenes[1].camera
    chosen = list(boule.series([universe.atoms], select="name == 'OW'"))
    assert len(chosen[0].spheres[0]) == 1


def test_numbers_of_particles_may_change():
    frames = [lattice(k) for k in range(2)]
    frames[1] = {"positions": frames[1]["positions"][:5]}
    scenes = list(boule.series(frames))
    assert [len(scene.spheres[0]) for scene in scenes] == [COUNT, 5]


@pytest.mark.parametrize(
    ("frames", "key"),
    [
        ([], "frames"),
        (5, "frames"),
        ([{"positions": np.zeros((2, 3))}, 7], "frames[1]"),
        ([{"species": ["H"]}], "frames[0]"),
        ([{"positions": np.zeros((2, 3)), "radius": 2}], "frames[0]"),
        ([{"positions": np.zeros((2, 2))}], "positions"),
    ],
)
def test_wrong_frames_are_refused(frames, key):
    with pytest.raises(boule.Error) as caught:
        boule.series(frames)
    assert caught.value.key == key


def test_wrong_looks_are_refused():
    frames = [lattice(k) for k in range(2)]
    with pytest.raises(boule.Error) as caught:
        list(boule.series(frames, color="heat"))
    assert caught.value.file is None
    with pytest.raises(TypeError, match="polygons"):
        boule.series(frames, polygons="skip")
