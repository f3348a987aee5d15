"""Scenes from files, from trajectories and from arrays of particles."""

from __future__ import annotations

import functools
import inspect
import sys

from . import _core
from ._objects import error, path_of
from ._reading import scene_of

# Files that Boule does not read itself are read in another process, with the packages of this one.
if sys.executable:
    _core.use_python(sys.executable)


# How particles are shown, and the value of each argument that is not given. What "frame" means depends
# on the function.
_LOOK = {name: value for name, value in _core.look_choices.items() if name != "frame"}


def look_keys(**look):
    """All arguments that say how particles are shown, as a dictionary."""
    return {**_LOOK, **look}


def given_of(look):
    """Those of the arguments that are given."""
    return {name: one for name, one in look.items() if one is not None and one is not False}


def with_look(*names, also=()):
    """Takes the arguments of _LOOK, or those named, as the function's own: help(), type checkers and errors
    have them. So it does with those of `also`."""
    defaults = {**dict(also), **{name: _LOOK[name] for name in names or _LOOK}}
    kind = inspect.Parameter.KEYWORD_ONLY
    shown = [
        inspect.Parameter(name, kind, default=default) for name, default in defaults.items()
    ]

    def decorate(function):
        own = inspect.signature(function)
        kept = [one for one in own.parameters.values() if one.kind is not one.VAR_KEYWORD]
        signature = own.replace(parameters=kept + shown)

        @functools.wraps(function)
        def call(*arguments, **keywords):
            for name in keywords:
                if name not in signature.parameters:
                    raise TypeError(
                        f"{function.__name__}() got an unexpected keyword argument {name!r}"
                    )
            return function(*arguments, **keywords)

        call.__signature__ = signature
        return call

    return decorate


# What is said of particles in memory: not how a file is read.
_OF_MEMORY = [name for name in _LOOK if name not in _core.file_choices]


@with_look()
def load(source, *, frame=None, polygons="plane", **look):
    """Reads a scene: .toml, .nff, .npy, or a file of particles, for which a scene is made.

    source: the name of the file; or atoms: of ASE, a universe or a group of atoms of MDAnalysis, a
        structure or a molecule of pymatgen. Of atoms the look is as for from_particles().
    frame: of a file of particles its frame, -1 is the last; of other scenes the frame of a series.
    polygons: NFF polygons become planes ("plane"), are left out ("skip"), or refused ("error").
    look: for files of particles, as the options of `boule render`: look ("paper", "plain", "dark"),
        quick, floor, input_format, columns (names, "-" skips one), water, topology (a file that
        tells the kinds of the particles), color, colors (a dictionary of colours by kind), map,
        range, nan_color, radius, radii (a dictionary of radii by species), scale,
        outline_by (what outlines go around: "chain", "molecule", ...), style ("space-filling",
        "balls-and-sticks", "sticks"), bonds (a rule, or a distance), bond_radius, bond_color,
        cell_edges, axes, arrows (three columns, or the one name that they have before x, y, z),
        arrow_scale, select, clip ("x<5", or a list of such), ghost (which particles you see
        through) and opacity, labels and label_text (texts of particles, which render() of the file
        draws and a Scene does not keep), wrap, unwrap, boundary, replicate, view, up, roll, ortho, fov, margin.

    Raises boule.Error with file, line, column and key.
    """
    atoms = particles_of(source)
    if atoms is not None:
        return from_particles(**atoms, **given_of(look))
    keys = {**look_keys(**look), "frame": frame, "polygons": polygons}
    return scene_of(_core.read(path_of(source), keys))


@with_look()
def frames(source, frames=None, *, interpolate=1, polygons="plane", **look):
    """The scenes of a series, one after the other: frames of a file of particles, or of files whose
    names have #### for the number of the frame.

    frames: a range of frames, such as range(0, 100, 10); None: all of a file of particles.
    interpolate: how many scenes there are from frame to frame of range(a, b), 1 to 1000: particles
        move in between.

    Boule makes its choices once, from all of them, as `boule render --frames` does: radii, the ranges
    of colour maps, the colours of kinds, the floor, the camera. A file of one frame without #### in
    its name shows it under every number, as there.
    """
    path = path_of(source)
    keys = {**look_keys(**look), "polygons": polygons}
    if frames is None:
        frames = range(_core.count_frames(path, keys))
    if not isinstance(frames, range) or len(frames) == 0 or frames.step < 1:
        raise error("frames", f"expected a range of frames, counting up, got {frames!r}")
    if frames.start < 0 or frames[-1] > 2**31 - 1:
        raise error("frames", f"must be from 0 to {2**31 - 1}")
    if not isinstance(interpolate, int) or not 1 <= interpolate <= 1000:
        raise error("interpolate", f"expected a whole number from 1 to 1000, got {interpolate!r}")
    if interpolate > 1:
        if frames.step != 1:
            raise error("interpolate", "needs all frames, a range without a step")
        frames = range(frames[0] * interpolate, frames[-1] * interpolate + 1)
    series = _core.Series(path, frames[0], frames[-1], frames.step, interpolate, keys)
    return _frames(series, frames)


def _frames(series, frames):
    for frame in frames:
        yield scene_of(series.read(frame))


def particles(positions, *, species=None, columns=None, cell=None, periodic=(), angstrom=1.0):
    """Particles in memory, as a file of particles would hold them."""
    if columns is not None and not isinstance(columns, dict):
        raise error("columns", f"expected a dictionary, got {type(columns).__name__}")
    return _core.particles(positions, species, columns or {}, cell, _along(periodic), angstrom)


def _along(periodic):
    """For each edge of a cell whether it is periodic."""
    if type(periodic).__name__ in ("bool", "bool_"):  # of Python, or of numpy 2 or 1
        return [bool(periodic)] * 3
    try:
        along = [bool(one) for one in periodic]
    except (TypeError, ValueError):
        raise error("periodic", f"expected three bools, got {type(periodic).__name__}") from None
    if len(along) not in (0, 3):
        raise error("periodic", f"expected three bools, got {len(along)}")
    return along


@with_look(*_OF_MEMORY)
def from_particles(
    positions, *, species=None, columns=None, cell=None, periodic=(), angstrom=1.0, **look
):
    """The scene that shows particles, as `boule render` shows a file of them.

    positions: N x 3, finite. species: N symbols, as text or bytes, or atomic numbers, whole from 0
        (ASE's X) to 118; other texts are species that are not elements.
    columns: a dictionary of N numbers or texts by name, which color, radius and select may name. A
        number is missing if it is NaN, or masked by numpy.ma; other masked arrays are refused.
    cell: 3 x 3, its edges; periodic: along which of them, three bools, or one for all.
    angstrom: how many one unit of length has (10 for nm), finite and above 0.
    look: as for load().

    Raises boule.Error with the argument as its key, such as "species".
    """
    data = particles(
        positions, species=species, columns=columns, cell=cell, periodic=periodic,
        angstrom=angstrom,
    )  # fmt: skip
    return scene_of(_core.show_particles(data, look_keys(**look)))


@with_look(*_OF_MEMORY)
def from_ase(atoms, **look):
    """The scene that shows atoms of ASE: anything with get_positions(), get_atomic_numbers() and
    cell. look: as for load(); the arrays of the atoms are columns ("tags", "momenta_x", ...)."""
    return from_particles(**_of_ase(atoms), **look)


def _of_ase(atoms):
    """The arguments of from_particles() that atoms of ASE are."""
    columns = {}
    count = len(atoms.get_atomic_numbers())
    for name, values in getattr(atoms, "arrays", {}).items():
        if name in ("positions", "numbers"):
            continue
        if values.shape == (count,):
            columns[name] = values
        elif values.shape == (count, 3):
            columns.update({f"{name}_{axis}": values[:, i] for i, axis in enumerate("xyz")})
    edges = [[float(x) for x in edge] for edge in atoms.cell]
    return {
        "positions": atoms.get_positions(),
        "species": atoms.get_atomic_numbers(),
        "columns": columns,
        "cell": edges if _volume(edges) != 0 else None,
        "periodic": [bool(one) for one in getattr(atoms, "pbc", ())],
    }


# What MDAnalysis calls columns, and what files of particles call them.
_COLUMNS_OF_MDANALYSIS = {
    "names": "name", "resnames": "resname", "chainIDs": "chain", "segids": "segment",
    "resids": "resid", "charges": "charge", "masses": "mass",
}  # fmt: skip


def _of_mdanalysis(atoms):
    """The same for a universe or a group of atoms of MDAnalysis, as it is now."""
    atoms = atoms.atoms
    known = {name: getattr(atoms, name, None) for name in ("elements", "types", *_COLUMNS_OF_MDANALYSIS)}
    elements = known["elements"]
    has_elements = elements is not None and all(elements)
    box = getattr(atoms.universe.trajectory.ts, "triclinic_dimensions", None)
    return {
        "positions": atoms.positions,
        "species": elements if has_elements else known["types"],
        "columns": {
            column: known[name]
            for name, column in _COLUMNS_OF_MDANALYSIS.items()
            if known[name] is not None
        },
        "cell": None if box is None else box.astype(float),
        "periodic": box is not None,
    }


def _of_pymatgen(structure):
    """The same for a structure or a molecule of pymatgen."""
    lattice = getattr(structure, "lattice", None)
    return {
        "positions": structure.cart_coords,
        "species": [str(getattr(one, "symbol", one)) for one in structure.species],
        "cell": None if lattice is None else lattice.matrix,
        "periodic": () if lattice is None else getattr(lattice, "pbc", True),
    }


def particles_of(one):
    """The arguments of from_particles() that atoms of another package are; None for other things."""
    if hasattr(one, "get_positions"):
        return _of_ase(one)
    if hasattr(getattr(one, "atoms", None), "positions"):
        return _of_mdanalysis(one)
    if hasattr(one, "cart_coords"):
        return _of_pymatgen(one)
    return None


def _data_of(one, place):
    """A frame of a series as particles."""
    given = one if isinstance(one, dict) else particles_of(one)
    if given is None:
        raise error(
            f"frames[{place}]",
            "expected atoms of ASE, MDAnalysis or pymatgen, or a dictionary with the arguments of "
            f"from_particles(), got {type(one).__name__}",
        )
    known = inspect.signature(particles).parameters
    wrong = [name for name in given if name not in known]
    if wrong or "positions" not in given:
        problem = f"there is no {wrong[0]!r}" if wrong else "'positions' is missing"
        raise error(f"frames[{place}]", f"{problem}; it may have {', '.join(known)}")
    return particles(**given)


@with_look(*_OF_MEMORY)
def series(frames, **look):
    """The scenes of a series of particles in memory, one after the other.

    frames: each one atoms of ASE, a universe or a group of atoms of MDAnalysis, a structure of
        pymatgen, or a dictionary with the arguments of from_particles() but for the look. They are read at once: of a
        trajectory that goes on in place, give a generator, (u.atoms for _ in u.trajectory).
    look: as for load().

    As for the files of frames(), Boule makes its choices once, from all frames: radii, the ranges of
    colour maps, the colours of kinds, the floor, the camera. Raises boule.Error.
    """
    try:
        data = [_data_of(one, place) for place, one in enumerate(frames)]
    except TypeError as wrong:
        if hasattr(frames, "__iter__"):
            raise
        raise error("frames", f"expected several, got {type(frames).__name__}") from wrong
    if not data:
        raise error("frames", "expected one or more")
    return _frames(_core.series_of(data, look_keys(**look)), range(len(data)))


def _volume(edges):
    (a, b, c), (d, e, f), (g, h, i) = edges
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
