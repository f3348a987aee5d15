#!/usr/bin/env python3
"""as_gemmi.py PROGRAM DATA: what Boule reads from PDB and CIF files is what gemmi's Python and ASE read.

PROGRAM is boule_print_particles, DATA the folder tests/data. Positions are compared bit for bit, and so
are cells with gemmi. Exit code 77: gemmi or ASE is not there, or Boule is built without gemmi.
"""
import gzip
import json
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

try:
    import ase.io
    import gemmi
    import numpy as np
except ImportError:
    print("python3-gemmi or python3-ase is missing")
    sys.exit(77)

warnings.simplefilter("ignore")
PROGRAM, DATA = sys.argv[1], Path(sys.argv[2])
# Files of Debian packages: pymol-data, freesasa, garlic, mustang-testdata, gdis-data.
FOLDERS = ["pymol", "freesasa", "doc/garlic", "doc/mustang-testdata", "gdis"] + sys.argv[3:]


def read(path):
    """All frames as Boule reads them; nothing where it refuses the file."""
    done = subprocess.run([PROGRAM, str(path)], capture_output=True, text=True, errors="replace")
    if "lacks gemmi" in done.stdout:
        print(done.stdout)
        sys.exit(77)
    if done.returncode != 0:
        print(done.stdout.strip())
        return None
    return [json.loads(line) for line in done.stdout.splitlines()]


def floats(texts):
    return [float.fromhex(t) for t in texts]


def atoms_of(frame):
    """The atoms of a frame of Boule, with all that is said of them."""
    positions = np.array(floats(frame["positions"])).reshape(-1, 3).tolist()
    numbers = {name: floats(values) for name, values in frame["numbers"].items()}
    texts = frame["texts"]
    return [(*positions[i], frame["species"][i], texts["name"][i], texts["resname"][i], texts["chain"][i],
             numbers["resid"][i], numbers["id"][i], numbers["occupancy"][i], numbers["bfactor"][i])
            for i in range(len(positions))]


def decimal(number):
    """gemmi keeps these numbers as floats; Boule has the decimal number that stands in the file."""
    return float(str(np.float32(number)))


def chosen(chain):
    """Residues and atoms without other alternative locations than the first."""
    place, first, seen = None, None, set()
    for residue in chain:
        if str(residue.seqid) != place:
            place, first, seen = str(residue.seqid), residue.name, set()
        for atom in residue:
            if atom.altloc != "\0" and (residue.name != first or atom.name in seen):
                continue
            seen.add(atom.name)
            yield residue, atom


def gemmi_atoms(model):
    """Without water, where there is something else."""
    atoms = [(*atom.pos.tolist(), atom.element.name, atom.name, residue.name, chain.name,
              float(residue.seqid.num or 0), float(atom.serial), decimal(atom.occ), decimal(atom.b_iso))
             for chain in model for residue, atom in chosen(chain)]
    dry = [atom for atom in atoms if atom[5] not in ("HOH", "WAT", "DOD", "H2O")]
    return dry or atoms


def without_b_factors(atoms):
    """gemmi has a B factor of 20 where a line ends before it, Boule 0."""
    return [atom[:-1] for atom in atoms]


def read_with_gemmi(path):
    """Files older than 1996 end in columns that gemmi takes for charges."""
    try:
        return gemmi.read_structure(str(path), format=gemmi.CoorFormat.Detect)
    except RuntimeError as error:
        if "charge" not in str(error):
            raise
    data = Path(path).read_bytes()
    text = (gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data).decode("latin-1")
    return gemmi.read_pdb_string("\n".join(line[:72 if line[79:80].isdigit() else 78] for line in text.splitlines()))


def compare_cell(path, mine, cell):
    if not cell.is_crystal() or cell.volume == 0:
        assert "cell" not in mine, f"{path}: a cell that is none"
        return
    m = cell.orthogonalization_matrix.tolist()
    theirs = [m[row][column] for column in range(3) for row in range(3)]
    assert floats(mine["cell"])[:9] == theirs, f"{path}: cells differ"


def compare_with_gemmi(path):
    """True if both read it. gemmi stops at the first END and takes models as a whole."""
    mine = read(path)
    if mine is None:
        return False
    structure = read_with_gemmi(path)
    theirs = [model for model in structure if model.count_atom_sites() > 0]
    assert len(mine) == len(theirs), f"{path}: {len(mine)} frames, gemmi has {len(theirs)}"
    for frame, model in zip(mine, theirs):
        # gemmi puts the atoms of a residue together.
        ours, others = sorted(atoms_of(frame)), sorted(gemmi_atoms(model))
        if all(atom[-1] == 20 for atom in others):
            ours, others = without_b_factors(ours), without_b_factors(others)
        assert ours == others, f"{path}: atoms differ"
        compare_cell(path, frame, structure.cell)
    return True


def files(*endings):
    """Of tests/data and of the packages. Where an occupancy is blank, Boule has 1, gemmi 0; the names of
    helix_amber.pdb are not aligned, and gemmi takes HE2 for helium."""
    unlike = {"borneol.pdb", "odd01.pdb", "helix_amber.pdb"}
    paths = [DATA]
    paths += [Path("/usr/share") / name if not name.startswith("/") else Path(name) for name in FOLDERS]
    found = [p for folder in paths for ending in endings for p in sorted(folder.glob(f"**/*{ending}"))]
    return [path for path in found if path.name not in unlike]


def test_pdb(folder):
    """Real files, and the mmCIF files that gemmi makes of them."""
    compared = 0
    for path in files(".pdb", ".ent", ".pdb.gz"):
        if not compare_with_gemmi(path):
            continue
        compared += 1
        structure = read_with_gemmi(path)
        for model in structure:
            for chain in model:
                chain.name = chain.name or "A"  # gemmi and Boule name a chain without name otherwise
        structure.setup_entities()
        written = folder / "written.cif"
        structure.make_mmcif_document().write_file(str(written))
        compare_with_gemmi(written)
    print(f"{compared} PDB files, and mmCIF of them, are read as gemmi reads them")
    assert compared >= 1


def test_models(folder):
    """Several models, in either format, packed and not."""
    structure = gemmi.read_structure(str(DATA / "1crn.cif"))
    for k in range(3):
        model = structure[0].clone()
        model.name = str(k + 2)
        for chain in model:
            for residue in chain:
                for atom in residue:
                    atom.pos += gemmi.Position(k + 1, 0.125 * k, -k)
        structure.add_model(model)
    structure.write_pdb(str(folder / "models.pdb"))
    structure.make_mmcif_document().write_file(str(folder / "models.cif"))
    for name in ["models.pdb", "models.cif"]:
        packed = folder / (name + ".gz")
        packed.write_bytes(gzip.compress((folder / name).read_bytes()))
        for path in [folder / name, packed]:
            assert len(read(path)) == 4
            assert compare_with_gemmi(path)


def test_ase(folder):
    """ASE has all atoms in the order of the file. It needs elements, which the old file lacks."""
    path = folder / "new.pdb"
    read_with_gemmi(DATA / "1crn.pdb").write_pdb(str(path))
    theirs = ase.io.read(path)
    for file in [path, DATA / "1crn.pdb", DATA / "1crn.cif"]:
        mine = read(file)[0]
        assert np.array_equal(np.array(floats(mine["positions"])).reshape(-1, 3), theirs.get_positions())
        assert mine["species"] == theirs.get_chemical_symbols(), f"{file}: species differ"
        assert floats(mine["numbers"]["bfactor"]) == theirs.get_array("bfactor").tolist()
        assert mine["texts"]["resname"] == [name.strip() for name in theirs.get_array("residuenames")]


P1 = gemmi.find_spacegroup_by_name("P 1")
CRYSTALS = [
    ("F m -3 m", "5.64 5.64 5.64 90 90 90", ["Na 0 0 0", "Cl 0.5 0.5 0.5"]),
    ("P 31 2 1", "4.913 4.913 5.405 90 90 120", ["Si 0.4697 0 0", "O 0.4135 0.2669 0.1191"]),
    ("P 1 21/c 1", "6.1 7.2 8.3 90 101 90", ["C 0.1 0.2 0.3", "O 0.5 0.5 0.5", "N 0.9 0.01 0.49"]),
    ("R -3 m", "4.546 4.546 11.862 90 90 120", ["Bi 0 0 0.234"]),
    ("F d -3 m:2", "8.4 8.4 8.4 90 90 90", ["Mg 0.125 0.125 0.125", "Al 0.5 0.5 0.5", "O 0.2624 0.2624 0.2624"]),
]


def places(cell, atoms):
    """Elements and where they are in the cell, in parts of it that no site lies between."""
    parts = 10000
    fractions = [(name, cell.fractionalize(gemmi.Position(*position))) for name, position in atoms]
    return sorted((name, *(round(x * parts) % parts for x in f.tolist())) for name, f in fractions)


def test_crystals(folder):
    """All atoms of the cell, which the symmetry makes of those in the file."""
    for group, numbers, sites in CRYSTALS:
        path = folder / "crystal.cif"
        names = ["length_a", "length_b", "length_c", "angle_alpha", "angle_beta", "angle_gamma"]
        path.write_text("data_x\n" + "".join(f"_cell_{n} {v}\n" for n, v in zip(names, numbers.split()))
                        + f"_symmetry_space_group_name_H-M '{group}'\nloop_\n_atom_site_label\n"
                        + "".join(f"_atom_site_fract_{x}\n" for x in "xyz") + "\n".join(sites) + "\n")
        small = gemmi.read_small_structure(str(path))
        small.setup_cell_images()
        theirs = [(s.element.name, s.orth(small.cell).tolist()) for s in small.get_all_unit_cell_sites()]
        mine = read(path)[0]
        ours = zip(mine["species"], np.array(floats(mine["positions"])).reshape(-1, 3).tolist())
        assert places(small.cell, ours) == places(small.cell, theirs), f"{group}: cells differ"
    print(f"{len(CRYSTALS)} crystals have the atoms that gemmi has")


def test_small(folder):
    """CIF of small molecules."""
    made = folder / "quartz.cif"
    made.write_text("data_quartz\n_cell_length_a 4.913(1)\n_cell_length_b 4.913(1)\n_cell_length_c 5.405(1)\n"
                    "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 120\nloop_\n"
                    "_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
                    "Si1 0.4697(2) 0 0\nO1 .4135 0.2669(3) +0.1191\n")
    compared = 0
    for path in [made, *files(".cif")]:
        blocks = [b for b in gemmi.cif.read(str(path)) if b.find_loop("_atom_site_fract_x")]
        if not blocks or gemmi.make_small_structure_from_block(blocks[0]).find_spacegroup() not in (None, P1):
            continue
        small = gemmi.make_small_structure_from_block(blocks[0])
        mine = read(path)
        assert mine is not None and len(mine) == 1
        ours = np.array(floats(mine[0]["positions"])).reshape(-1, 3).tolist()
        sites = [site for site in small.sites if site.disorder_group <= 1]
        assert ours == [site.orth(small.cell).tolist() for site in sites], f"{path}: positions differ"
        assert mine[0]["species"] == [site.element.name for site in sites], f"{path}: species differ"
        assert mine[0]["texts"]["name"] == [site.label for site in sites], f"{path}: names differ"
        compare_cell(path, mine[0], small.cell)
        compared += 1
    print(f"{compared} CIF files of small molecules are read as gemmi reads them")


with tempfile.TemporaryDirectory() as name:
    test_ase(Path(name))
    test_models(Path(name))
    test_small(Path(name))
    test_crystals(Path(name))
    test_pdb(Path(name))
