#!/usr/bin/env python3
"""as_rare_libraries.py PROGRAM DATA: as as_libraries.py, for formats that no library writes.

The files are written here, and a TPR file by GROMACS where that is. Exit code 77: no library is there.
"""
import itertools
import json
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("numpy is missing")
    sys.exit(77)

from printed_particles import module, numbers, read, run, same

warnings.simplefilter("ignore")
PLACES = np.float32([[0.5, 0.25, 0.125], [1.5, 0.0, -0.25], [-0.875, 2.5, 3.125]])
NAMES, BONDS = ["OW", "HW1", "HW2"], [[0, 1], [0, 2]]


def outcar(folder):
    """Two steps, as VASP writes them."""
    potentials = "".join(f" POTCAR:    PAW_PBE {name} 08Apr2002\n" for name in ("O", "H") * 2)
    head = (potentials + "   ions per type =               1   2\n   ISPIN  =      1    spin polarized calculation?\n"
            "   k-points           NKPTS =      1   k-points in BZ     NKDIM =      1   number of bands    NBANDS=      4\n"
            " k-points in reciprocal lattice and weights: made\n   0.00000000  0.00000000  0.00000000       1.000\n"
            "--------------------------------------- Iteration      1(   1)  ---------------------------------------\n")
    text = head
    for step in range(2):
        rows = "".join("".join(f"{x:13.5f}" for x in [*place + step, *place / 8]) + "\n" for place in PLACES)
        text += ("      direct lattice vectors                 reciprocal lattice vectors\n"
                 "     9.000000000  0.000000000  0.000000000     0.1  0.0  0.0\n"
                 "     1.000000000  8.000000000  0.000000000     0.0  0.1  0.0\n"
                 "     0.000000000  0.500000000  7.000000000     0.0  0.0  0.1\n"
                 " POSITION                                       TOTAL-FORCE (eV/Angst)\n ----\n" + rows +
                 "  FREE ENERGIE OF THE ION-ELECTRON SYSTEM (eV)\n  ----\n  free  energy   TOTEN  =       -14.5 eV\n\n"
                 "  energy  without entropy=      -14.5  energy(sigma->0) =      -14.25\n")
    (folder / "OUTCAR").write_text(text)
    return folder / "OUTCAR", "vasp-out", 2


def chemical_json(folder):
    data = {"chemical json": 0, "atoms": {"elements": {"number": [8, 1, 1]},
                                          "coords": {"3d": PLACES.astype(float).ravel().tolist()}},
            "unit cell": {"a": 9, "b": 8, "c": 7, "alpha": 90, "beta": 80, "gamma": 100}}
    (folder / "a.cml").write_text(json.dumps(data))
    return folder / "a.cml", "cml", 1


def with_ase(folder):
    ase_io = __import__("ase.io").io
    for path, form, frames in (outcar(folder), chemical_json(folder)):
        expected, mine = ase_io.read(path, index=":", format=form), read(path)
        assert len(mine) == len(expected) == frames, path
        for a, b in zip(mine, expected):
            same(path, a, b.get_positions(), b.cell[:], ["O", "H", "H"])
    forces = [numbers(read(folder / "OUTCAR")[1]["numbers"][f"forces_{k}"], -1) for k in "xyz"]
    assert np.array_equal(np.array(forces).T, expected_forces()), forces
    print("ASE: 2 files")


def expected_forces():
    """Five digits of them are in the file."""
    return np.array([[float(f"{x:13.5f}") for x in place / 8] for place in PLACES])


def prmtop():
    """A topology of Amber: a water molecule."""
    pointers = [3, 2, 2, 0, 0, 0, 0, 0, 0, 0, 3, 1] + [0] * 19
    sections = {
        "TITLE": ("20a4", ["made"]),
        "POINTERS": ("10I8", [f"{n:8d}" for n in pointers]),
        "ATOM_NAME": ("20a4", [f"{name:4}" for name in NAMES]),
        "CHARGE": ("5E16.8", [f"{q * 18.2223:16.8E}" for q in (-0.75, 0.375, 0.375)]),
        "ATOMIC_NUMBER": ("10I8", [f"{n:8d}" for n in (8, 1, 1)]),
        "MASS": ("5E16.8", [f"{m:16.8E}" for m in (16, 1, 1)]),
        "ATOM_TYPE_INDEX": ("10I8", [f"{n:8d}" for n in (1, 2, 2)]),
        "RESIDUE_LABEL": ("20a4", ["WAT "]),
        "RESIDUE_POINTER": ("10I8", [f"{1:8d}"]),
        "BONDS_INC_HYDROGEN": ("10I8", [f"{n:8d}" for n in (0, 3, 1, 0, 6, 1)]),
        "BONDS_WITHOUT_HYDROGEN": ("10I8", []),
        "ANGLES_INC_HYDROGEN": ("10I8", []),
        "ANGLES_WITHOUT_HYDROGEN": ("10I8", []),
        "DIHEDRALS_INC_HYDROGEN": ("10I8", []),
        "DIHEDRALS_WITHOUT_HYDROGEN": ("10I8", []),
        "AMBER_ATOM_TYPE": ("20a4", [f"{name:4}" for name in NAMES]),
    }
    text = "%VERSION  VERSION_STAMP = V0001.000  DATE = 01/01/20  00:00:00\n"
    for name, (form, values) in sections.items():
        each = int("".join(itertools.takewhile(str.isdigit, form)))
        lines = ["".join(values[i:i + each]) for i in range(0, len(values), each)] or [""]
        text += f"%FLAG {name}\n%FORMAT({form})\n" + "\n".join(lines) + "\n"
    return text


def desres(path):
    with sqlite3.connect(path) as file:
        file.execute("create table particle (id, anum, name, x, y, z, vx, vy, vz, mass, charge, resname, "
                     "resid, chain, segid)")
        for i, (name, place) in enumerate(zip(NAMES, PLACES.tolist())):
            file.execute("insert into particle values (?,?,?,?,?,?,0,0,0,?,?,'WAT',1,'A','S')",
                         (i, [8, 1, 1][i], name, *place, [16, 1, 1][i], [-0.75, 0.375, 0.375][i]))
        file.execute("create table bond (p0, p1, 'order')")
        file.executemany("insert into bond values (?,?,1)", BONDS)
        file.execute("create table global_cell (id, x, y, z)")
        file.executemany("insert into global_cell values (?,?,?,?)",
                         [(1, 9, 0, 0), (2, 0, 8, 0), (3, 0, 0, 7)])
    file.close()


def same_molecule(mda, path, mine):
    """Names, charges, bonds, positions and the cell."""
    universe = mda.Universe(str(path))
    atoms, step = universe.atoms, universe.trajectory.ts
    assert mine["texts"]["name"] == list(atoms.names) and mine["texts"]["resname"] == list(atoms.resnames)
    assert np.array_equal(numbers(mine["numbers"]["charge"], -1), np.float64(atoms.charges)), path
    if hasattr(atoms, "bonds"):
        assert mine["bonds"] == sorted(sorted(pair) for pair in atoms.bonds.indices.tolist()), path
    same(path, mine, step.positions, None if step.dimensions is None else step.triclinic_dimensions)


def amber_trajectory(mda, folder):
    """Text coordinates, which take names from a topology, and how many there are."""
    values = [f"{x:8.3f}" for step in range(2) for x in (PLACES + step).ravel()]
    frames = [values[:9], values[9:]]
    for ending, box in (("mdcrd", ""), ("trj", ""), ("crdbox", "   9.000   8.000   7.000\n")):
        path = folder / f"run.{ending}"
        path.write_text("made\n" + "".join("".join(frame) + "\n" + box for frame in frames))
        code, text = run(path)
        assert code != 0 and "--topology" in text, text
        mine = read(path, "", "", folder / "a.prmtop")
        with mda.coordinates.core.get_reader_for(str(path), "TRJ")(str(path), n_atoms=3) as steps:
            expected = [(step.positions.copy(), step.dimensions is not None) for step in steps]
        assert len(mine) == len(expected) == 2, path
        for one, (positions, has_cell) in zip(mine, expected):
            same(path, one, positions, np.diag([9, 8, 7]) if has_cell else None, ["O", "H", "H"])
        assert has_cell == bool(box), path


def gromacs(folder):
    """A TPR file: none where GROMACS is missing."""
    if shutil.which("gmx") is None:
        print("gmx is not there: TPR is left out")
        return None
    atoms = "".join(f"{i + 1} {'OH'[i > 0]} 1 WAT {name} 1 {q} {m}\n" for i, (name, q, m) in
                    enumerate(zip(NAMES, (-0.75, 0.375, 0.375), (16, 1, 1))))
    (folder / "water.top").write_text(
        "[ defaults ]\n1 2 yes 0.5 0.8333\n[ atomtypes ]\nO 8 16 0 A 0.3 0.6\nH 1 1 0 A 0 0\n"
        "[ moleculetype ]\nWAT 2\n[ atoms ]\n" + atoms + "[ bonds ]\n1 2 1 0.1 1000\n1 3 1 0.1 1000\n"
        "[ system ]\nmade\n[ molecules ]\nWAT 2\n")
    rows = "".join(f"{1 + i // 3:5d}{'WAT':<5}{NAMES[i % 3]:>5}{i + 1:5d}" +
                   "".join(f"{0.1 * x + i // 3:8.3f}" for x in PLACES[i % 3]) + "\n" for i in range(6))
    (folder / "water.gro").write_text(f"made\n6\n{rows}   3.0   3.0   3.0\n")
    (folder / "run.mdp").write_text("integrator = md\nnsteps = 1\n")
    done = subprocess.run(["gmx", "grompp", "-f", "run.mdp", "-c", "water.gro", "-p", "water.top", "-o", "a.tpr",
                           "-maxwarn", "9"], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder / "a.tpr"


def with_mdanalysis(folder):
    mda = __import__("MDAnalysis")
    tried = 0
    for name in ("a.prmtop", "a.parm7", "a.top"):
        (folder / name).write_text(prmtop())
    (folder / "a.rst7").write_text("made\n3\n" + "".join(f"{x:12.7f}" for x in PLACES.ravel()[:6]) + "\n" +
                                   "".join(f"{x:12.7f}" for x in PLACES.ravel()[6:]) + "\n")
    for name in ("a.prmtop", "a.parm7", "a.top"):
        one, = read(folder / "a.rst7", "", "", folder / name)
        same(name, one, PLACES, species=["O", "H", "H"])
        same_topology(mda, folder / name, "PRMTOP", one)
        tried += 1
    amber_trajectory(mda, folder)
    desres(folder / "a.dms")
    one, = read(folder / "a.dms")
    same_molecule(mda, folder / "a.dms", one)
    assert one["bonds"] == BONDS and one["species"] == ["O", "H", "H"], one["species"]
    rows = "".join(f"ATOM  {i + 1:5d} {name:<4} WAT A   1    " + "".join(f"{x:8.3f}" for x in place) +
                   f"  1.00  0.00    {q:6.3f} {kind:<2}\n" for i, (name, place, q, kind) in
                   enumerate(zip(NAMES, PLACES, (-0.75, 0.375, 0.375), ("OA", "HD", "HD"))))
    (folder / "a.pdbqt").write_text("REMARK made\nROOT\n" + rows + "ENDROOT\nTORSDOF 0\n")
    one, = read(folder / "a.pdbqt")
    same_molecule(mda, folder / "a.pdbqt", one)
    assert one["species"] == ["O", "H", "H"], one["species"]
    run_input = gromacs(folder)
    if run_input:
        one, = read(folder / "water.gro", "", "", run_input)
        same_topology(mda, run_input, "TPR", one)
        assert one["bonds"] == BONDS + [[3, 4], [3, 5]] and one["species"] == ["O", "H", "H"] * 2
        tried += 1
    print(f"MDAnalysis: {tried + 6} files")


def same_topology(mda, path, form, mine):
    """What a file of positions has from a topology."""
    code, text = run(path)
    assert code != 0 and "it has no positions" in text, text
    atoms = mda.Universe(str(path), topology_format=form).atoms
    assert mine["texts"]["name"] == list(atoms.names) and mine["texts"]["resname"] == list(atoms.resnames)
    assert np.array_equal(numbers(mine["numbers"]["charge"], -1), np.float64(atoms.charges)), path
    assert np.array_equal(numbers(mine["numbers"]["mass"], -1), np.float64(atoms.masses)), path
    assert mine["bonds"] == sorted(sorted(pair) for pair in atoms.bonds.indices.tolist()), path


TESTS = {"ase": with_ase, "MDAnalysis": with_mdanalysis}
there = {name: test for name, test in TESTS.items() if module(name)}
for name, test in there.items():
    with tempfile.TemporaryDirectory() as made:
        test(Path(made))
sys.exit(0 if there else 77)
