#!/usr/bin/env python3
"""as_libraries.py PROGRAM DATA: what Boule shows of foreign files is what their libraries read.

PROGRAM is boule_print_particles. Frames, counts, positions, cells and elements are compared, bit
for bit. The libraries write the files; a few are written here, and some are of LAMMPS and GSD,
where those are. A library that is not there is left out, with a word. Exit code 77: none is there.
"""
import importlib
import os
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

from printed_particles import PROGRAM, module, numbers, read, run, same

warnings.simplefilter("ignore")
EXAMPLES = Path("/usr/share/lammps/examples")
RNG = np.random.default_rng(11)
SYMBOLS = ["C", "H", "O", "Fe", "Cl"]
CELL = [[18, 0, 0], [1, 19, 0], [0.5, 0.25, 17]]


def with_ase(folder):
    ase_io = importlib.import_module("ase.io")
    frames = []
    for _ in range(3):
        atoms = module("ase").Atoms(SYMBOLS, positions=RNG.normal(size=(5, 3)) * 3, cell=CELL, pbc=True)
        atoms.set_velocities(RNG.normal(size=(5, 3)))
        frames.append(atoms)
    kinds = {"run.traj": "traj", "XDATCAR": "vasp-xdatcar", "POSCAR": "vasp", "CONTCAR.1": "vasp",
             "a.vasp": "vasp", "a.cube": "cube", "a.xsf": "xsf", "a.cfg": "cfg", "a.gen": "gen",
             "a.res": "res", "a.struct": "struct", "a.car": "dmol-car", "a.xsd": "xsd",
             "a.g96": "gromos", "a.rmc6f": "rmc6f"}
    written = []
    for name, form in kinds.items():
        many = form in ("traj", "vasp-xdatcar")
        ase_io.write(folder / name, frames if many else frames[0], format=form)
        written.append((folder / name, form))
    molecule = "\n".join([" made", "", "", "  2  1  0  0  0  0            999 V2000",
                          "    0.1000    0.2000    0.3000 C   0  0", "    1.1000    0.2000    0.3000 Cl  0  0",
                          "  1  2  1  0", "M  END", "$$$$", ""])
    for name in ("a.mol", "a.sdf"):
        (folder / name).write_text(molecule)
        written.append((folder / name, name[2:]))
    samples = [(EXAMPLES / "COUPLE/lammps_vasp/POSCAR_W", "vasp")]
    written += [(path, form) for path, form in samples if path.exists()]
    for path, form in written:
        expected = ase_io.read(path, index=":", format=form)
        mine = read(path)
        assert len(mine) == len(expected), path
        for a, b in zip(mine, expected):
            same(path, a, b.get_positions(), b.cell[:] if b.cell.rank == 3 else None, b.get_chemical_symbols())
    momenta = [numbers(read(folder / "run.traj")[2]["numbers"][f"momenta_{k}"], -1) for k in "xyz"]
    assert np.array_equal(np.array(momenta).T, frames[2].get_momenta())
    print(f"ASE: {len(written)} files")


def without(folder, *names):
    """A folder of modules that hides these."""
    hidden = folder / "hidden"
    hidden.mkdir(exist_ok=True)
    for name in names:
        (hidden / f"{name}.py").write_text(f"raise ModuleNotFoundError('hidden', name='{name}')\n")
    return hidden


def universe_of(mda, n):
    universe = mda.Universe.empty(n, trajectory=True)
    names = ["CA", "OW", "NA", "HW1", "FE"]
    universe.add_TopologyAttr("names", [names[i % 5] for i in range(n)])
    for name, value in {"resnames": "ALA", "resids": 1}.items():
        universe.add_TopologyAttr(name, [value])
    universe.load_new(RNG.normal(size=(4, n, 3)).astype("f4") * 5)
    return universe


def with_mdanalysis(folder):
    mda = importlib.import_module("MDAnalysis")
    universe = universe_of(mda, 11)
    tried = 0
    for ending in ("xtc", "trr", "dcd", "nc", "ncdf", "coor", "crd", "trz"):
        path = folder / f"run.{ending}"
        with mda.Writer(str(path), 11) as writer:
            for step in universe.trajectory:
                step.dimensions = [20, 21, 22, 90, 80, 70]
                writer.write(universe.atoms)
                if ending in ("coor", "crd"):
                    break
        topology = ["", "", folder / "run.crd"] if ending == "trz" else []
        mine = read(path, *topology)
        assert not list(folder.glob(".*")), f"{path}: MDAnalysis left files behind"
        options = {"n_atoms": 11} if ending == "trz" else {}
        form = {"nc": "NCDF", "coor": "NAMDBIN"}.get(ending, ending.upper())
        with mda.coordinates.core.get_reader_for(str(path), form)(str(path), **options) as steps:
            expected = [(step.positions.copy(), step.triclinic_dimensions) for step in steps]
        assert len(mine) == len(expected), path
        for a, (positions, cell) in zip(mine, expected):
            same(path, a, positions, cell)
        for own in folder.glob(".*"):
            own.unlink()
        tried += 1
    # The residue is ALA: CA and NA are no ions.
    assert read(folder / "run.crd")[0]["species"] == (["C", "O", "N", "H", "Fe"] * 3)[:11]
    mol2 = ("@<TRIPOS>MOLECULE\nmade\n2 1 0 0 0\nSMALL\nUSER_CHARGES\n\n@<TRIPOS>ATOM\n"
            "1 C1 0.5 0.25 0.125 C.3 1 LIG 0.1\n2 O1 1.5 0.0 0.0 O.2 1 LIG -0.1\n@<TRIPOS>BOND\n1 1 2 2\n")
    txyz = "2 made\n1 C 0.5 0.25 0.125 1 2\n2 O 1.5 0.0 0.0 2 1\n"
    inpcrd = "made\n2\n   0.5000000   0.2500000   0.1250000   1.5000000   0.0000000   0.0000000\n"
    for name, text in {"a.mol2": mol2 * 2, "a.txyz": txyz * 2, "a.inpcrd": inpcrd}.items():
        (folder / name).write_text(text)
        mine = read(folder / name)
        assert len(mine) == (1 if name == "a.inpcrd" else 2), name
        for one in mine:
            assert one["bonds"] == ([] if name == "a.inpcrd" else [[0, 1]]), name
            same(name, one, [[0.5, 0.25, 0.125], [1.5, 0, 0]], species=None if name == "a.inpcrd" else "CO")
        tried += 1
    psf = EXAMPLES / "PACKAGES/colvars/peptide.psf"
    if psf.exists():
        atoms = mda.Universe(str(psf)).atoms
        universe_of(mda, len(atoms)).atoms.write(str(folder / "peptide.dcd"))
        mine = read(folder / "peptide.dcd", "", "", psf)[0]
        assert mine["texts"]["name"] == list(atoms.names), "names of the topology"
        assert mine["texts"]["resname"] == list(atoms.resnames)
        assert mine["bonds"] == sorted(sorted(pair) for pair in atoms.bonds.indices.tolist())
        letters = {one for one in mine["species"] if one.isalpha()}  # some atoms are named 10
        assert letters <= {"C", "H", "N", "O", "S"}, letters
        code, text = run(psf)
        assert code != 0 and "it has no positions" in text, text
        code, text = run(folder / "run.dcd", "", "", psf)
        assert code != 0 and f"it has {len(atoms)} particles, the file has 11" in text, text
        tried += 1
    print(f"MDAnalysis: {tried} files")


def with_gsd(folder):
    hoomd = importlib.import_module("gsd.hoomd")
    frame = getattr(hoomd, "Frame", None) or hoomd.Snapshot
    steps = []
    with hoomd.open(str(folder / "run.gsd"), "wb") as file:
        for step in range(3):
            one = frame()
            one.particles.N = 6 + step
            one.particles.position = RNG.normal(size=(6 + step, 3))
            one.particles.types = ["A", "big"]
            one.particles.typeid = np.arange(6 + step) % 2
            one.particles.diameter = RNG.random(6 + step) + 1
            one.bonds.N = 2
            one.bonds.group = [[0, 1], [3, 2]]
            one.configuration.box = [8, 9, 10, 0.25, 0.5, 0.125]
            file.append(one)
            steps.append(one.particles)
    cell = np.array([[8, 0, 0], [0.25 * 9, 9, 0], [0.5 * 10, 0.125 * 10, 10]])
    mine = read(folder / "run.gsd")
    assert len(mine) == 3
    for a, b in zip(mine, steps):
        kinds = [b.types[i] for i in b.typeid]
        same("run.gsd", a, np.float32(b.position), cell, kinds, -cell.sum(axis=0) / 2)
        assert np.array_equal(numbers(a["numbers"]["diameter"], -1), np.float32(b.diameter))
        assert "charge" not in a["numbers"]
        assert a["bonds"] == [[0, 1], [2, 3]]
    sample = Path(importlib.import_module("gsd").__file__).parent / "test/test_gsd_v1.gsd"
    if sample.exists():
        code, text = run(sample)  # a file of the first version, without particles of HOOMD
        assert code == 0 or "a GSD trajectory" in text, text
    print("gsd: 1 file")


def with_meshio(folder):
    meshio = importlib.import_module("meshio")
    points = RNG.normal(size=(9, 3))
    data = {"Radius": RNG.random(9) + 1, "velocity": RNG.normal(size=(9, 3))}
    for ending in ("vtk", "vtu"):
        path = folder / f"points.{ending}"
        meshio.write_points_cells(str(path), points, [("vertex", np.arange(9).reshape(9, 1))], point_data=data)
        one, = read(path, modules=without(folder, "vtk"))
        same(path, one, points)
        assert np.array_equal(numbers(one["numbers"]["radius"], -1), data["Radius"])
        assert np.array_equal(numbers(one["numbers"]["vx"], -1), data["velocity"][:, 0])
    print("meshio: 2 files")


def with_vtk(folder):
    # As LIGGGHTS writes grains.
    (folder / "grains.vtk").write_text(
        "# vtk DataFile Version 2.0\ngrains\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0.5 0 0\n1.5 0 0.25\n"
        "VERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\nVECTORS v float\n1 2 3\n4 5 6\n"
        "SCALARS radius float 1\nLOOKUP_TABLE default\n0.5\n0.25\nSCALARS type int 1\nLOOKUP_TABLE default\n1\n2\n")
    one, = read(folder / "grains.vtk")
    same("grains.vtk", one, [[0.5, 0, 0], [1.5, 0, 0.25]], species=["1", "2"])
    assert numbers(one["numbers"]["radius"], -1).tolist() == [0.5, 0.25]
    assert numbers(one["numbers"]["vy"], -1).tolist() == [2, 5]
    vtk = importlib.import_module("vtk")
    reader = vtk.vtkPolyDataReader()
    reader.SetFileName(str(folder / "grains.vtk"))
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetFileName(str(folder / "grains.vtp"))
    writer.SetInputConnection(reader.GetOutputPort())
    writer.Write()
    one, = read(folder / "grains.vtp")
    same("grains.vtp", one, [[0.5, 0, 0], [1.5, 0, 0.25]])
    print("VTK: 2 files")


def broken_files(folder):
    """One error each, and no trace of Python's own."""
    for name in ("a.traj", "a.xtc", "a.gsd", "a.vtu", "POSCAR.x", "a.psf", "a.cube"):
        for content in (b"", b"hello\n", bytes(range(256)) * 40):
            (folder / name).write_bytes(content)
            code, text = run(folder / name)
            assert code != 0 and len(text.splitlines()) == 1 and "Traceback" not in text, f"{name}: {text}"


def missing_libraries(folder):
    """One error, with what to install."""
    for name, module_name, packages in [
        ("a.xtc", "MDAnalysis", "an XTC trajectory: needs MDAnalysis: apt install python3-mdanalysis, or pip install MDAnalysis"),
        ("POSCAR", "ase", "a VASP structure: needs ase: apt install python3-ase, or pip install ase"),
        ("a.vtp", "vtk", "a VTK file: needs vtk: apt install python3-vtk9, or pip install vtk"),
    ]:
        (folder / name).write_text("x")
        code, text = run(folder / name, modules=without(folder, module_name))
        assert code != 0 and text.rstrip().endswith(packages), text


def hostile_modules(folder):
    """Nothing of the working directory runs, and reading neither writes, unpickles nor starts."""
    (folder / "POSCAR").write_text("x")
    (folder / "numpy.py").write_text(f"open({str(folder / 'trace')!r}, 'w')\n")
    subprocess.run([PROGRAM, "POSCAR"], cwd=folder, capture_output=True, check=False,
                   env={**os.environ, "BOULE_PYTHON": sys.executable})
    assert not (folder / "trace").exists(), "numpy.py of the working directory ran"
    for act, told in {
        f"open({str(folder / 'trace')!r}, 'w')": "reading writes no files",
        "__import__('subprocess').run(['true'])": "reading it would start a program",
        "__import__('os').system('true')": "reading it would start a program",
        "__import__('pickle').loads(b'cos\\nsystem\\n.')": "it holds pickled Python",
        "print('babble', flush=True) or __import__('os').write(1, b'babble') + []": "TypeError",
        "[0] * 10**14": "it needs more memory than there is",
    }.items():
        fake = folder / "fake"
        fake.mkdir(exist_ok=True)
        (fake / "meshio.py").write_text(f"def read(*_):\n    {act}\n")
        (fake / "vtk.py").write_text("raise ModuleNotFoundError('hidden', name='vtk')\n")
        (folder / "a.vtk").write_text("x")
        code, text = run(folder / "a.vtk", modules=fake)
        assert code != 0 and told in text and len(text.splitlines()) == 1, f"{act}: {text}"
        assert not (folder / "trace").exists()


TESTS = {"ase": with_ase, "MDAnalysis": with_mdanalysis, "gsd": with_gsd,
         "meshio": with_meshio, "vtk": with_vtk}
there = {name: test for name, test in TESTS.items() if module(name)}
for name, test in there.items():
    with tempfile.TemporaryDirectory() as made:
        test(Path(made))
for test in (broken_files, missing_libraries, hostile_modules):
    with tempfile.TemporaryDirectory() as made:
        test(Path(made))
sys.exit(0 if there else 77)
