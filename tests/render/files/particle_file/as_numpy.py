#!/usr/bin/env python3
"""as_numpy.py PROGRAM: what Boule reads from PLY files and tables is what NumPy reads.

PROGRAM is boule_print_particles. All numbers are compared bit for bit. Exit code 77: NumPy is not
there.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("python3-numpy is missing")
    sys.exit(77)

PROGRAM = sys.argv[1]
N = 1000
PLY_TYPES = {"i1": "char", "u1": "uint8", "i2": "short", "u2": "uint16", "i4": "int32", "u4": "uint",
             "f4": "float", "f8": "float64"}


def read(path, *arguments):
    """The one frame as Boule reads it: columns by name."""
    done = subprocess.run([PROGRAM, str(path), *arguments], capture_output=True, text=True)
    assert done.returncode == 0, f"{path}: {done.stdout}"
    frame = json.loads(done.stdout)
    columns = dict(zip("xyz", np.array([float.fromhex(t) for t in frame["positions"]]).reshape(-1, 3).T))
    for name, values in frame["numbers"].items():
        columns[name] = np.array([float.fromhex(t) for t in values])
    return columns


def compare(path, mine, expected):
    assert mine.keys() == expected.keys(), f"{path}: {mine.keys()} {expected.keys()}"
    for name, values in expected.items():
        assert np.array_equal(mine[name], np.asarray(values, dtype=np.float64)), f"{path}: {name}"


def random_table(rng):
    """A structured array with every type of PLY, numbers of all sizes."""
    fields = [("x", "f4"), ("y", "f8"), ("z", "f4"), ("radius", "f4"), ("a", "i1"), ("red", "u1"),
              ("green", "u1"), ("blue", "u1"), ("b", "i2"), ("c", "u2"), ("d", "i4"), ("e", "u4"), ("f", "f8")]
    table = np.zeros(N, dtype=fields)
    for name, kind in fields:
        if kind[0] == "f":
            exponents = rng.integers(-30, 30, N)
            table[name] = rng.normal(size=N) * 10.0 ** exponents
        else:
            limits = np.iinfo(kind)
            table[name] = rng.integers(limits.min, limits.max, N, endpoint=True)
    return table


def expected_columns(table):
    colors = ["red", "green", "blue"]
    return {name: table[name] / 255.0 if name in colors else table[name] for name in table.dtype.names}


def ply_bytes(table, encoding, line_end):
    """The table after an element of lists, before one of faces."""
    lines = ["ply", f"format {encoding} 1.0", "comment by numpy", "element strip 2",
             "property list uchar int rows", f"element vertex {N}"]
    lines += [f"property {PLY_TYPES[table.dtype[name].str[1:]]} {name}" for name in table.dtype.names]
    lines += ["element face 1", "property list uchar int vertex_indices", "end_header", ""]
    header = line_end.join(lines).encode()
    if encoding == "ascii":
        rows = [" ".join(repr(v.item()) for v in row) for row in table]
        return header + line_end.join(["2 7 8", "0", *rows, "3 0 1 2", ""]).encode()
    order = "<" if encoding == "binary_little_endian" else ">"
    strips = b"\2" + np.array([7, 8], order + "i4").tobytes() + b"\0"
    face = b"\3" + np.array([0, 1, 2], order + "i4").tobytes()
    return header + strips + table.astype(table.dtype.newbyteorder(order)).tobytes() + face


def test_ply(folder, table):
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"]:
        for line_end in ["\n", "\r\n"]:
            path = folder / "points.ply"
            path.write_bytes(ply_bytes(table, encoding, line_end))
            compare(f"{encoding} {line_end!r}", read(path), expected_columns(table))


def test_tables(folder):
    rng = np.random.default_rng(12)
    values = rng.normal(size=(N, 5)) * 10.0 ** rng.integers(-300, 300, (N, 5))
    path = folder / "table.txt"
    names = ["x", "y", "z", "mass", "radius"]
    for delimiter in [" ", ",", ";", "\t", ", "]:
        for form in ["%.18e", "%.17g", "%.6f", "%25.12g"]:
            for header, comments in [("", "# "), (delimiter.join(names), "# "), (delimiter.join(names), "")]:
                np.savetxt(path, values, fmt=form, delimiter=delimiter, header=header, comments=comments)
                skipped = 1 if header and not comments else 0
                theirs = np.loadtxt(path, delimiter=None if delimiter == " " else delimiter.strip(" "),
                                    skiprows=skipped)
                usual = names if header else ["x", "y", "z", "radius", "c5"]
                compare(f"{delimiter!r} {form} {header}", read(path), dict(zip(usual, theirs.T)))


def test_npy(folder, table):
    for order in "<>":
        path = folder / "table.npy"
        np.save(path, table.astype(table.dtype.newbyteorder(order)))
        compare(f"npy {order}", read(path, "npy"), {name: table[name] for name in table.dtype.names})


def test_halves(folder):
    """Every finite float of 16 bits."""
    halves = np.arange(1 << 16, dtype="u2").view("f2")
    halves = halves[np.isfinite(halves)]
    for order in "<>":
        table = np.zeros(len(halves), dtype=[("x", order + "f2"), ("y", "f4"), ("z", "f8")])
        table["x"] = halves
        path = folder / "halves.npy"
        np.save(path, table)
        compare(f"halves {order}", read(path, "npy"), {name: table[name] for name in table.dtype.names})


with tempfile.TemporaryDirectory() as name:
    random = random_table(np.random.default_rng(11))
    test_ply(Path(name), random)
    test_npy(Path(name), random)
    test_halves(Path(name))
    test_tables(Path(name))
