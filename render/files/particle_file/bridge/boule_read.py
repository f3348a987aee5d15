"""boule-read FILE COUNT [only NAME...]: reads a file of a simulation by the Python library that knows it.

Boule has this text in its program and runs it for files that it does not read itself. The library
is that of FORMATS by the file's name, else ASE. COUNT: how many particles there are, for files that
do not tell; 0 if nobody knows. NAME: the columns of numbers that are asked for; without "only", all.

The stream
----------
Requests are lines on standard input, "frame N" with N from 0. The end of the input ends this
process. Answers are lines of UTF-8 on standard output up to an empty one, then blocks of bytes,
little-endian, which the lines announced, in their order.

The first answer comes unasked:
    boule-read 1            the version of this stream
    library NAME VERSION
    frames N
That to a request:
    particles N             how many there are
    positions               a block of 3 N doubles; without this line the file has none
    species K BYTES NAME    the column of kinds: a block of BYTES bytes, K texts with a newline each,
                            and one of N indices into them, 4 bytes each, from 0
    text K BYTES NAME       a column of texts, likewise
    number NAME             a column of numbers, a block of N doubles
    unread NAME             one that was not asked for
    bonds B                 all that there are: a block of 2 B indices of particles, 4 bytes each
    cell A B C O            twelve numbers, three edges and the corner; digits suffice for the double
    periodic A B C          0 or 1 along each edge
    angstrom X              how many one unit of length has; 1 without this line
    time T
    note TEXT               for the user
Either may be "error TEXT" alone: after the first answer this process ends, after others it goes on.
"""
import importlib
import os
import sys

sys.path[:] = [folder for folder in sys.path if folder]  # nothing of the working directory runs

# Endings of names (POSCAR*: a beginning), kind, libraries in the order of preference, and the
# library's own name of the format. Boule reads the first column, too.
FORMATS = """
xtc               | an XTC trajectory          | MDAnalysis | XTC
trr               | a TRR trajectory           | MDAnalysis | TRR
dcd               | a DCD trajectory           | MDAnalysis | DCD
nc ncdf           | an Amber NetCDF trajectory | MDAnalysis | NCDF
mdcrd crdbox trj  | an Amber text trajectory   | MDAnalysis | TRJ
inpcrd rst7       | Amber coordinates          | MDAnalysis | INPCRD
coor namdbin      | NAMD coordinates           | MDAnalysis | NAMDBIN
trz               | a TRZ trajectory           | MDAnalysis | TRZ
crd               | CHARMM coordinates         | MDAnalysis | CRD
mol2              | a MOL2 file                | MDAnalysis | MOL2
txyz arc          | a Tinker file              | MDAnalysis | TXYZ
dms               | a DESRES structure         | MDAnalysis | DMS
pdbqt             | a PDBQT file               | MDAnalysis | PDBQT
psf               | a PSF topology             | MDAnalysis | PSF
prmtop parm7 top  | an Amber topology          | MDAnalysis | PRMTOP
tpr               | a TPR topology             | MDAnalysis | TPR
gsd               | a GSD trajectory           | gsd        | -
vtk               | a VTK file                 | vtk meshio | vtk
vtu               | a VTK file                 | vtk meshio | vtu
vtp               | a VTK file                 | vtk        | -
traj              | an ASE trajectory          | ase        | traj
vasp poscar contcar poscar* contcar* | a VASP structure | ase | vasp
xdatcar xdatcar*  | a VASP trajectory          | ase        | vasp-xdatcar
outcar outcar*    | output of VASP             | ase        | vasp-out
cube              | a Gaussian cube            | ase        | cube
xsf               | an XSF file                | ase        | xsf
mol               | a MOL file                 | ase        | mol
sdf               | an SDF file                | ase        | sdf
cfg               | an AtomEye file            | ase        | cfg
gen               | a DFTB+ structure          | ase        | gen
res               | a SHELX file               | ase        | res
struct            | a WIEN2k structure         | ase        | struct
car               | a Materials Studio file    | ase        | dmol-car
xsd               | a Materials Studio file    | ase        | xsd
cml               | a CML file                 | ase        | cml
g96               | a GROMOS file              | ase        | gromos
rmc6f             | an RMC6f file              | ase        | rmc6f
"""

# Where to get a library: the package of Debian and that of pip.
PACKAGES = {
    "MDAnalysis": ("python3-mdanalysis", "MDAnalysis"),
    "ase": ("python3-ase", "ase"),
    "gsd": ("python3-gsd", "gsd"),
    "meshio": ("python3-meshio", "meshio"),
    "vtk": ("python3-vtk9", "vtk"),
}
COUNTLESS = ("TRJ", "TRZ")  # do not tell how many particles they have
STRUCTURES = ("CRD", "MOL2", "TXYZ", "DMS", "PDBQT")  # positions with names
TOPOLOGIES = ("PSF", "PRMTOP", "TPR")  # names without positions
WANTED = None  # the columns of numbers that are asked for; None: all
UNSAFE = ("py", "bundletrajectory", "db", "json", "mysql", "postgresql")  # of ASE: run or unpickle


class Failure(Exception):
    """What is wrong, for the user."""


def refuse(event, arguments):
    """An audit hook. Reading neither unpickles, nor starts programs, nor writes files."""
    if event == "pickle.find_class":
        raise PermissionError("it holds pickled Python, which is not loaded")
    if event in ("os.system", "os.exec", "os.posix_spawn", "subprocess.Popen"):
        raise PermissionError("reading it would start a program")
    if event == "open" and (arguments[2] or 0) & (os.O_WRONLY | os.O_RDWR | os.O_CREAT):
        raise PermissionError(13, "reading writes no files", arguments[0])


class Frame:
    """One frame, as the stream describes it."""

    def __init__(self, positions):
        self.positions = positions  # N x 3, or None
        self.count = 0 if positions is None else len(positions)
        self.species = None  # a column of kinds, as those of columns
        self.columns = []  # (name, N numbers or N texts or what coded() returns)
        self.unread = []  # names
        self.bonds = None  # B x 2
        self.cell = None  # 3 x 3
        self.origin = (0, 0, 0)
        self.periodic = (True, True, True)
        self.angstrom = 1.0
        self.time = None
        self.notes = []

    def is_asked(self, name, shape):
        """Whether numbers of this shape are asked for; else their names are all that is told."""
        names = names_of(name, shape)
        if WANTED is None or not WANTED.isdisjoint(names):
            return True
        self.unread += names
        return False

    def add(self, name, values):
        """Adds a column, or one for each of its parts; skips what is not one value a particle."""
        if isinstance(values, tuple):
            self.columns.append((name, values))
            return
        values = numpy.asarray(values)
        if len(values.shape) not in (1, 2) or len(values) != self.count or values.dtype.kind == "c":
            return
        columns = values.T if values.ndim == 2 else [values]
        for named, column in zip(names_of(name, values.shape), columns):
            if values.dtype.kind not in "biuf" or self.is_asked(named, column.shape):
                self.columns.append((named, column))

    def set_cell(self, edges, periodic=(True, True, True)):
        edges = numpy.asarray(edges, dtype=float).reshape(3, 3)
        if numpy.linalg.det(edges) != 0:
            self.cell, self.periodic = edges, periodic


def names_of(name, shape):
    """The names of the columns that an array of one value or one row a particle has."""
    width = shape[1] if len(shape) == 2 else len(shape) == 1
    if width == 1:
        return [name]
    if width != 3:
        return [f"{name}_{i + 1}" for i in range(width)]
    is_velocity = name.lower() in ("v", "vel", "velo", "velocity", "velocities")
    return [("v" if is_velocity else name + "_") + axis for axis in "xyz"]


def coded(values):
    """The different texts in the order of their first use, and each particle's index."""
    values = numpy.asarray(values)
    if values.dtype.kind in "OS":
        values = numpy.char.decode(values) if values.dtype.kind == "S" else values.astype(str)
    texts, first, index = numpy.unique(values, return_index=True, return_inverse=True)
    order = numpy.argsort(first)
    rank = numpy.empty(len(order), dtype="<u4")
    rank[order] = numpy.arange(len(order))
    return [str(text) for text in texts[order]], rank[index]


class ByMDAnalysis:
    """Positions are what MDAnalysis gives, in angstrom."""

    NAMES = {"names": "name", "resnames": "resname", "chainIDs": "chain", "segids": "segment",
             "types": "type"}  # fmt: skip
    NUMBERS = {"ids": "id", "resids": "resid", "charges": "charge", "masses": "mass",
               "radii": "radius", "occupancies": "occupancy", "tempfactors": "bfactor"}  # fmt: skip

    def __init__(self, mda, path, form, count):
        self.species, self.columns, self.trajectory, self.bonds = None, [], None, None
        if form in STRUCTURES or form in TOPOLOGIES:
            universe = mda.Universe(path, topology_format=form)
            self.take_names(universe.atoms)
            if form in STRUCTURES:
                self.trajectory = universe.trajectory
        elif form in COUNTLESS and count == 0:
            raise Failure("it does not tell how many particles it has: --topology names a file that does")
        else:
            options = {"n_atoms": count} if form in COUNTLESS else {}
            self.trajectory = mda.coordinates.core.get_reader_for(path, form)(path, **options)
        self.frames = 1 if self.trajectory is None else len(self.trajectory)
        self.count = len(universe.atoms) if self.trajectory is None else self.trajectory.n_atoms

    def take_names(self, atoms):
        elements = getattr(atoms, "elements", None)
        if elements is not None and all(elements):
            self.species = ("element", coded(elements))
        for attribute, name in self.NAMES.items():
            if hasattr(atoms, attribute):
                self.columns.append((name, coded(getattr(atoms, attribute))))
        for attribute, name in self.NUMBERS.items():
            if hasattr(atoms, attribute):
                self.columns.append((name, numpy.array(getattr(atoms, attribute))))
        if hasattr(atoms.universe, "bonds"):
            self.bonds = atoms.universe.bonds.indices

    def read(self, number):
        frame = Frame(None)
        if self.trajectory is not None:
            step = self.trajectory[number]
            frame = Frame(step.positions)
            frame.time = step.time
            if step.dimensions is not None:
                frame.set_cell(step.triclinic_dimensions)
            native = self.trajectory.units.get("length")
            if native not in (None, "Angstrom"):
                frame.notes.append(f"MDAnalysis converted lengths from {native} to angstrom")
            if step.has_velocities:
                frame.add("velocity", step.velocities)
        frame.count, frame.species, frame.bonds = self.count, self.species, self.bonds
        for name, values in self.columns:
            frame.add(name, values)
        return frame


class ByASE:
    """Trajectories of ASE itself are read by frame, all others as a whole."""

    def __init__(self, ase, path, form, _count):
        from ase.io import formats, read, trajectory

        form = form or formats.filetype(path)
        if form in UNSAFE:
            raise Failure(f"the format {form} of ASE may run what a file holds, it is not read")
        if form == "traj":
            self.images = trajectory.Trajectory(path)
        else:
            self.images = read(path, index=":", format=form)
        self.frames = len(self.images)

    def read(self, number):
        atoms = self.images[number]
        frame = Frame(atoms.get_positions())
        numbers, index = coded(atoms.get_atomic_numbers())
        from ase.data import chemical_symbols

        frame.species = ("element", ([chemical_symbols[int(one)] for one in numbers], index))
        frame.set_cell(atoms.cell[:], atoms.pbc)
        results = atoms.calc.results if atoms.calc is not None else {}
        for name, values in [*atoms.arrays.items(), *results.items()]:
            if name not in ("positions", "numbers") and hasattr(values, "shape"):
                frame.add(name, values)
        return frame


class ByGSD:
    """Columns are those that the file has; HOOMD's own values for others are left out."""

    def __init__(self, _gsd, path, _form, _count):
        import gsd.fl
        import gsd.hoomd

        self.trajectory = gsd.hoomd.HOOMDTrajectory(gsd.fl.open(path, "rb"))
        self.frames = len(self.trajectory)

    def read(self, number):
        step = self.trajectory[number]
        frame = Frame(step.particles.position)
        if step.particles.types:
            frame.species = ("type", numpy.array(step.particles.types)[step.particles.typeid])
        lx, ly, lz, xy, xz, yz = (float(x) for x in step.configuration.box)
        frame.set_cell([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])
        if frame.cell is not None:
            frame.origin = -frame.cell.sum(axis=0) / 2
        frame.periodic = (True, True, step.configuration.dimensions != 2)
        frame.time = float(step.configuration.step)
        for name in ("diameter", "charge", "mass", "velocity", "body"):
            has = self.trajectory.file.chunk_exists
            if any(has(frame=i, name="particles/" + name) for i in (0, number)):
                frame.add(name, getattr(step.particles, name))
        frame.bonds = step.bonds.group
        return frame


class ByPoints:
    """Points with data, by VTK or meshio: read(path, form) returns both."""

    frames = 1

    def __init__(self, points, data):
        self.points, self.data = points, data

    def read(self, _number):
        frame = Frame(self.points)
        for name, values in self.data:
            named = name.lower() if name.lower() in ("radius", "diameter", "id", "type") else name
            values = numpy.asarray(values)
            if named == "type" and values.dtype.kind in "iu" and values.shape == (frame.count,):
                frame.species = ("type", values.astype(str))
            else:
                frame.add(named, values)
        return frame


def by_meshio(meshio, path, form, _count):
    mesh = meshio.read(path, form)
    points = numpy.zeros((len(mesh.points), 3))
    points[:, : mesh.points.shape[1]] = mesh.points  # of two dimensions
    return ByPoints(points, mesh.point_data.items())


def by_vtk(vtk, path, form, _count):
    from vtk.util.numpy_support import vtk_to_numpy

    if form == "vtk":
        reader = vtk.vtkGenericDataObjectReader()
        for what in ("Scalars", "Vectors", "Normals", "Tensors", "Fields"):
            getattr(reader, f"ReadAll{what}On")()
    else:
        reader = vtk.vtkXMLGenericDataObjectReader()
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    points = data.GetPoints() if hasattr(data, "GetPoints") else None
    if points is None:
        raise Failure("VTK finds no points in it")
    arrays = data.GetPointData()
    arrays = [arrays.GetArray(i) for i in range(arrays.GetNumberOfArrays())]
    named = [(one.GetName() or "", vtk_to_numpy(one)) for one in arrays if one is not None]
    return ByPoints(vtk_to_numpy(points.GetData()), named)


READERS = {"MDAnalysis": ByMDAnalysis, "ase": ByASE, "gsd": ByGSD,
           "meshio": by_meshio, "vtk": by_vtk}  # fmt: skip


def choose(path):
    """Kind, libraries and format of a file, by its name."""
    name = os.path.basename(path).lower()
    name = name[:-3] if name.endswith(".gz") else name
    for row in FORMATS.strip().splitlines():
        endings, kind, libraries, form = (part.strip() for part in row.split("|"))
        for ending in endings.split():
            if ending.endswith("*") and name.startswith(ending[:-1]) or name.endswith("." + ending):
                return kind, libraries.split(), form
    return "a file of other programs", ["ase"], ""


def load_library(libraries):
    """The first of them that is installed: its name and its module."""
    for name in libraries:
        try:
            return name, importlib.import_module(name)
        except ModuleNotFoundError as error:
            if error.name != name:
                raise Failure(f"{name} cannot be loaded: {error}") from None
    apt, pip = PACKAGES[libraries[0]]
    raise Failure(f"needs {libraries[0]}: apt install {apt}, or pip install {pip}")


def told(error, library):
    """An exception in one line."""
    if isinstance(error, MemoryError):
        return "it needs more memory than there is"
    text = " ".join(str(error).split())
    if isinstance(error, Failure):
        return text
    return f"{library}: {text or 'it fails'} ({type(error).__name__})"


def words(values):
    return " ".join(repr(float(value)) for value in values)


def answer_of(frame):
    """Lines and blocks of a frame."""
    lines, blocks = [f"particles {frame.count}"], []
    if frame.positions is not None:
        if frame.positions.shape != (frame.count, 3):
            raise Failure(f"positions of shape {frame.positions.shape}, expected three numbers each")
        lines.append("positions")
        blocks.append(numpy.ascontiguousarray(frame.positions, dtype="<f8"))
    if frame.cell is not None:
        lines.append(f"cell {words(frame.cell.ravel())} {words(frame.origin)}")
        lines.append("periodic " + " ".join(str(int(one)) for one in frame.periodic))
    if frame.time is not None:
        lines.append("time " + words([frame.time]))
    lines.append("angstrom " + words([frame.angstrom]))
    lines += ["unread " + name for name in frame.unread] + ["note " + note for note in frame.notes]
    species = [] if frame.species is None else [frame.species]
    for i, (name, values) in enumerate(species + frame.columns):
        if not isinstance(values, tuple) and values.dtype.kind in "biuf":
            lines.append(f"number {name}")
            blocks.append(numpy.ascontiguousarray(values, dtype="<f8"))
            continue
        texts, index = values if isinstance(values, tuple) else coded(values)
        block = "".join(" ".join(text.split()) + "\n" for text in texts).encode()
        what = "species" if i < len(species) else "text"
        lines.append(f"{what} {len(texts)} {len(block)} {name}")
        blocks += [block, numpy.ascontiguousarray(index, dtype="<u4")]
    if frame.bonds is not None and len(frame.bonds) > 0:
        lines.append(f"bonds {len(frame.bonds)}")
        blocks.append(numpy.ascontiguousarray(frame.bonds, dtype="<u4"))
    return lines, blocks


def main():
    # What a library prints goes to standard error; the stream is this function's own.
    answers, requests = os.fdopen(os.dup(1), "wb"), os.fdopen(os.dup(0), "rb")
    os.dup2(2, 1)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)

    def send(lines, blocks=()):
        text = "".join(" ".join(line.split("\n")) + "\n" for line in lines) + "\n"
        answers.write(text.encode("utf-8", "replace"))
        for block in blocks:
            answers.write(memoryview(block).cast("B") if len(block) else b"")
        answers.flush()

    library = ""
    try:
        global numpy, WANTED
        path, count = sys.argv[1], int(sys.argv[2])
        WANTED = set(sys.argv[4:]) if sys.argv[3:4] == ["only"] else None
        kind, libraries, form = choose(path)
        try:
            numpy = importlib.import_module("numpy")
        except ModuleNotFoundError:
            raise Failure("needs numpy: apt install python3-numpy, or pip install numpy") from None
        library, module = load_library(libraries)
        importlib.import_module("warnings").simplefilter("ignore")
        sys.dont_write_bytecode = True
        sys.addaudithook(refuse)
        reader = READERS[library](module, path, form, count)
        version = getattr(module, "__version__", None) or getattr(module, "VTK_VERSION", "")
        send(["boule-read 1", f"library {library} {version}", f"frames {reader.frames}"])
    except Exception as error:
        send([f"error {kind}: {told(error, library)}"])
        return
    for request in requests:
        try:
            lines, blocks = answer_of(reader.read(int(request.split()[1])))
        except Exception as error:
            lines, blocks = [f"error {told(error, library)}"], []
        send(lines, blocks)


if __name__ == "__main__":
    main()
