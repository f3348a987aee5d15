#!/usr/bin/env python3
"""as_ase.py PROGRAM: what Boule reads from particle files is what ASE reads.

PROGRAM is boule_print_particles. Positions are compared bit for bit, but for fractions of a box,
which ASE multiplies in another order. Exit code 77: ASE is not there.
"""
import glob
import gzip
import json
import struct
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

try:
    import ase.io
    import numpy as np
    from ase import Atoms
    from ase.io.lammpsdata import read_lammps_data
except ImportError:
    print("python3-ase is missing")
    sys.exit(77)

warnings.simplefilter("ignore")
PROGRAM = sys.argv[1]
EXAMPLES = "/usr/share/lammps/examples"
GROMACS = "/usr/share/gromacs/top"


def read(path, *arguments):
    """All frames as Boule reads them."""
    done = subprocess.run([PROGRAM, str(path), *arguments], capture_output=True, text=True)
    assert done.returncode == 0, f"{path}: {done.stdout}"
    return [json.loads(line) for line in done.stdout.splitlines()]


def numbers(texts, *shape):
    return np.array([float.fromhex(t) for t in texts]).reshape(*shape)


def compare(path, mine, atoms, exact=True, species=True):
    """One frame. Fractions are not exact, and ASE counts them from the box's own corner."""
    positions = numbers(mine["positions"], -1, 3)
    theirs = atoms.get_positions()
    if exact:
        assert np.array_equal(positions, theirs), f"{path}: positions differ"
    else:
        origin = numbers(mine["cell"], 4, 3)[3]
        assert np.allclose(positions - origin, theirs, rtol=1e-13, atol=1e-12), f"{path}: positions"
    if species:
        assert mine["species"] == atoms.get_chemical_symbols(), f"{path}: species differ"
    if atoms.cell.rank == 3:
        cell = numbers(mine["cell"], 4, 3)[:3]
        assert np.allclose(cell, atoms.cell[:], rtol=1e-14, atol=1e-14), f"{path}: cells differ"
        assert [bool(p) for p in mine["periodic"]] == list(atoms.pbc), f"{path}: pbc differ"


def random_frames(count, n, species):
    rng = np.random.default_rng(7)
    frames = []
    for i in range(count):
        atoms = Atoms([species[k] for k in rng.integers(0, len(species), n + i)],
                      positions=rng.normal(size=(n + i, 3)) * 10.0 ** rng.integers(-8, 8, (n + i, 1)),
                      cell=[[5, 1, 0.5], [0.25, 6, 1], [1, 2, 7]], pbc=[True, False, True])
        atoms.set_velocities(rng.normal(size=(n + i, 3)))
        frames.append(atoms)
    return frames


def test_xyz(folder):
    frames = random_frames(5, 50, ["H", "C", "Fe", "U"])
    for name, options in [("run.xyz", {"format": "xyz"}), ("run.extxyz", {"format": "extxyz"})]:
        path = folder / name
        ase.io.write(path, frames, **options)
        packed = folder / (name + ".gz")
        packed.write_bytes(gzip.compress(path.read_bytes()))
        expected = ase.io.read(path, index=":", format=options["format"])
        for file in [path, packed]:
            mine = read(file)
            assert len(mine) == len(expected) == 5
            for m, e in zip(mine, expected):
                compare(file, m, e)
    momenta = np.array([numbers(mine[0]["numbers"][f"momenta_{k}"], -1) for k in "xyz"]).T
    assert np.array_equal(momenta, expected[0].get_momenta())


def dump_text(tilted, columns, rows):
    """A dump of two frames whose rows are not sorted."""
    text = ""
    for step in range(2):
        text += f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS "
        text += "xy xz yz pp pp ff\n-1 12 2\n-2 7 -1\n0 5 0.5\n" if tilted else "pp pp ff\n-1 9\n-2 7\n0 5\n"
        text += f"ITEM: ATOMS id type {columns}\n"
        for i, row in reversed(list(enumerate(rows))):
            text += f"{i + 1} {i % 3 + 1} " + " ".join(repr(x + step) for x in row) + "\n"
    return text


def test_dump(folder):
    rng = np.random.default_rng(8)
    rows = rng.normal(size=(40, 3)).tolist()
    for tilted in [False, True]:
        for columns in ["x y z", "xu yu zu", "xs ys zs"]:
            path = folder / "run.lammpstrj"
            path.write_text(dump_text(tilted, columns, rows))
            expected = ase.io.read(path, index=":", format="lammps-dump-text")
            mine = read(path)
            assert len(mine) == len(expected) == 2
            for m, e in zip(mine, expected):
                scaled = columns.startswith("xs")
                compare(f"{columns} tilted={tilted}", m, e, exact=not scaled, species=False)
                assert [int(s) for s in m["species"]] == e.numbers.tolist()


def dump_bytes(tilted, columns, rows, old):
    """The same as a binary dump, by two processes, in LAMMPS' format before or after 2020."""
    data = b""
    for step in range(2):
        if not old:
            data += struct.pack("=q10sii", -10, b"DUMPCUSTOM", 1, 2)
        data += struct.pack("=qqi6i", step, len(rows), tilted, 0, 0, 0, 0, 1, 1)
        data += struct.pack("=9d", -1, 12, -2, 7, 0, 5, 2, -1, 0.5) if tilted else struct.pack("=6d", -1, 9, -2, 7, 0, 5)
        data += struct.pack("=i", 5)
        if not old:
            names = f"id type {columns} ".encode()
            data += struct.pack("=i4sbdi", 4, b"real", 1, 0.5 * step, len(names)) + names
        data += struct.pack("=i", 2)
        values = [[i + 1, i % 3 + 1, *(x + step for x in row)] for i, row in enumerate(rows)][::-1]
        for part in values[:7], values[7:]:
            data += struct.pack(f"=i{5 * len(part)}d", 5 * len(part), *(x for row in part for x in row))
    return data


def test_binary_dump(folder):
    rows = np.random.default_rng(9).normal(size=(40, 3)).tolist()
    path = folder / "run.bin"
    for tilted in [False, True]:
        for columns in ["x y z", "xu yu zu"]:
            for old in [False, True]:
                path.write_bytes(dump_bytes(tilted, columns, rows, old))
                names = ["id", "type", *columns.split()]
                expected = ase.io.read(path, index=":", format="lammps-dump-binary", colnames=names)
                mine = read(path, "dump", ",".join(names)) if old else read(path)
                assert len(mine) == len(expected) == 2
                for m, e in zip(mine, expected):
                    compare(f"binary {columns} tilted={tilted}", m, e, species=False)
                    assert [int(s) for s in m["species"]] == e.numbers.tolist()


def style_of(path):
    """The style of a data file, by its comment or by the columns that its first row has."""
    lines = Path(path).read_text(errors="replace").splitlines()
    for i, line in enumerate(lines):
        words = line.split("#")[0].split()
        if words != ["Atoms"]:
            continue
        told = line.split("#")[1].split() if "#" in line else []
        return told[0] if told else {5: "atomic", 7: "full"}.get(len(lines[i + 2].split()))
    return None


def test_data():
    compared = 0
    for path in sorted(glob.glob(f"{EXAMPLES}/**/data.*", recursive=True)):
        style = style_of(path)
        if style not in ["atomic", "charge", "full", "molecular", "sphere"] or path.endswith(".gz"):
            continue
        try:
            with open(path, errors="replace") as file:
                expected = read_lammps_data(file, style=style, sort_by_id=True, units="metal")
        except Exception as error:  # ASE's own limits are no matter of this test
            print(f"ASE does not read {path}: {error!r}")
            continue
        mine = read(path, "data")[0]
        # ASE subtracts nothing from positions.
        compare(path, mine, expected, species=False)
        compared += 1
    print(f"{compared} data files are read as ASE reads them")
    return compared


def compare_gro(path):
    """ASE takes elements from the first letters alone, and returns angstrom."""
    expected = ase.io.read(path, format="gromacs")
    mine = read(path)
    assert len(mine) == 1
    positions = numbers(mine[0]["positions"], -1, 3)
    assert np.array_equal(positions * 10.0, expected.get_positions()), f"{path}: positions differ"
    assert np.array_equal(numbers(mine[0]["numbers"]["resid"], -1), expected.get_array("residuenumbers"))
    assert mine[0]["texts"]["resname"] == expected.get_array("residuenames").tolist()
    assert mine[0]["texts"]["name"] == expected.get_array("atomtypes").tolist()
    cell = numbers(mine[0]["cell"], 4, 3)[:3]
    assert np.allclose(cell * 10.0, expected.cell[:], rtol=1e-14, atol=1e-14), f"{path}: cells differ"


def test_gro(folder):
    frame = random_frames(1, 50, ["H", "C", "O"])[0]
    frame.positions = np.clip(frame.positions, -9000, 9000)
    ase.io.write(folder / "run.gro", frame, format="gromacs")
    compare_gro(folder / "run.gro")
    paths = sorted(glob.glob(f"{GROMACS}/**/*.gro", recursive=True))
    for path in paths:
        compare_gro(path)
    print(f"{len(paths)} GRO files are read as ASE reads them")


with tempfile.TemporaryDirectory() as name:
    test_gro(Path(name))
    test_xyz(Path(name))
    test_dump(Path(name))
    test_binary_dump(Path(name))
assert test_data() > 5 or not Path(EXAMPLES).exists()
