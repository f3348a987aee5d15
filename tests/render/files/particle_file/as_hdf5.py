#!/usr/bin/env python3
"""as_hdf5.py PROGRAM DATA: what Boule reads of HDF5 is what h5py reads, to the last bit.

PROGRAM is boule_print_particles. The files are written here, as the programs of each family write
them, and so that they must be refused. Exit code 77: there is no h5py, or Boule has no module for
HDF5.
"""
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError:
    print("h5py is missing")
    sys.exit(77)

from printed_particles import numbers, read, run, same

RNG = np.random.default_rng(23)
STORED = [  # how numbers are stored: chunks, packing, types
    ("plain", "<f8", {}),
    ("big-endian", ">f8", {}),
    ("single", "<f4", {"chunks": (2, 5, 3), "compression": "gzip", "shuffle": True, "fletcher32": True}),
    ("single big-endian", ">f4", {"chunks": (1, 3, 2)}),
    ("half", "<f2", {"chunks": (4, 7, 3), "compression": "gzip"}),
    ("whole", "<i4", {"chunks": (1, 7, 3), "scaleoffset": 0}),
    ("unsigned", ">u2", {}),
]


def values(texts):
    return numbers(texts, -1)


def same_column(one, name, expected):
    found = values(one["numbers"][name])
    assert np.array_equal(found, np.float64(expected), equal_nan=True), f"{name}: {found}, {expected}"


def h5md(folder):
    for name, kind, options in STORED:
        places = (RNG.normal(size=(4, 7, 3)) * 50 + 500).astype(kind)
        species = np.arange(7) % 3
        with h5py.File(folder / "run.h5md", "w") as file:
            group = file.create_group("particles/all")
            group.create_dataset("position/value", data=places, **options)
            group["position/value"].attrs["unit"] = "nm"
            group["position/time"] = np.arange(4) * 0.5
            group["species"] = species
            group.create_dataset("velocity/value", data=places, **options)
            group["charge"] = np.arange(7.0)
            group["flags"] = np.arange(7) % 2 == 0
            group["tensor/value"] = RNG.normal(size=(4, 7, 6))
            group["others/value"] = RNG.normal(size=(2, 7))
            group["too_many"] = np.arange(9)
            group["image/value"] = RNG.integers(-5, 5, size=(4, 7, 3)).astype(">i8")
            group.create_group("box").attrs["boundary"] = ["periodic", "none", "periodic"]
            group["box/edges/value"] = np.array([np.diag([5, 6, 7 + i]) for i in range(4)])
            file["parameters"] = 1
            expected = {one: group[one + "/value"][()] for one in ("tensor", "image")}
        mine = read(folder / "run.h5md")
        assert len(mine) == 4, name
        for i, one in enumerate(mine):
            same(name, one, places[i], np.diag([5, 6, 7 + i]), [str(code) for code in species])
            same_column(one, "vz", places[i, :, 2])
            same_column(one, "charge", range(7))
            same_column(one, "flags", [1, 0, 1, 0, 1, 0, 1])
            same_column(one, "tensor_6", expected["tensor"][i, :, 5])
            same_column(one, "image_y", expected["image"][i, :, 1])
            assert one["periodic"] == [1, 0, 1], name
            assert "others" not in one["numbers"] and "too_many" not in one["numbers"], name
    fixed(folder)


def fixed(folder):
    """One frame, texts of each kind, a box of three numbers, an order of making."""
    places = RNG.normal(size=(6, 3))
    names = ["H", "C", "H", "O", "C", "H"]
    kinds = h5py.enum_dtype({"C": 12, "H": -1, "O": 16}, basetype="i2")
    codes = np.array([{"C": 12, "H": -1, "O": 16}[one] for one in names])
    for track in (False, True):
        with h5py.File(folder / "one.h5", "w", track_order=track) as file:
            atoms = file.create_group("particles", track_order=track).create_group("solute", track_order=track)
            atoms["position"] = places
            atoms["species"] = codes.astype(kinds)
            atoms["fixed_text"] = np.array(names, dtype="S5")
            atoms["text"] = np.array(names, dtype=h5py.string_dtype())
            atoms["level"] = codes.astype(kinds)
            atoms["box/edges"] = [3.0, 4.0, 5.0]
            other = file["particles"].create_group("atoms")
            other["position"] = np.zeros((1, 3))
            other["species"] = [7]
        one, = read(folder / "one.h5")
        if not track:  # by names: atoms come first
            same("one.h5", one, [[0, 0, 0]], species=["7"])
            continue
        same("one.h5", one, places, np.diag([3, 4, 5]), names)
        for name in ("fixed_text", "text", "level"):
            assert one["texts"][name] == names, name
    with h5py.File(folder / "named.h5", "w") as file:
        file["particles/all/position"] = np.zeros((2, 3))
        file["particles/all/name"] = np.array(["CA", "OW"], dtype="S4")
    assert read(folder / "named.h5")[0]["species"] == ["C", "O"], "elements are guessed"
    with h5py.File(folder / "none.h5", "w") as file:
        file["particles/all/position"] = np.zeros((0, 3))
    assert read(folder / "none.h5")[0]["positions"] == []


def snapshot(folder):
    """As GADGET and its family write it."""
    for kind, options in [("f4", {}), (">f8", {"chunks": True, "compression": "gzip", "shuffle": True})]:
        places = {i: RNG.normal(size=(3 + i, 3)).astype(kind) for i in (0, 1, 2, 4, 5)}
        with h5py.File(folder / "snap_012.hdf5", "w") as file:
            header = file.create_group("Header").attrs
            header["BoxSize"], header["Time"], header["NumFilesPerSnapshot"] = 25.0, 0.5, 2
            first = 0
            for i, rows in places.items():
                group = file.create_group(f"PartType{i}")
                group.create_dataset("Coordinates", data=rows, **options)
                group.create_dataset("Velocities", data=rows * 2, **options)
                group["ParticleIDs"] = np.arange(first, first + len(rows), dtype="u8")
                first += len(rows)
            file["PartType0/SmoothingLength"] = np.arange(3.0)
            file["PartType4/Masses"] = np.arange(7.0)
            file.create_group("PartType3")
        one, = read(folder / "snap_012.hdf5")
        both = np.vstack(list(places.values()))
        names = {0: "gas", 1: "halo", 2: "disk", 4: "stars", 5: "black holes"}
        kinds = [names[i] for i, rows in places.items() for _ in rows]
        same("snap_012.hdf5", one, both, np.diag([25, 25, 25]), kinds)
        same_column(one, "vy", np.float64(both * 2)[:, 1])
        same_column(one, "id", range(len(both)))
        same_column(one, "SmoothingLength", [0, 1, 2] + [np.nan] * (len(both) - 3))
        same_column(one, "mass", [np.nan] * 12 + list(range(7)) + [np.nan] * 8)


def openpmd(folder):
    """Two steps of two species, of which one has fixed components and offsets."""
    places = RNG.normal(size=(2, 4, 3))
    cells = RNG.integers(0, 99, size=4)
    with h5py.File(folder / "beam.h5", "w") as file:
        file.attrs["openPMD"], file.attrs["particlesPath"] = "1.1.0", "particles/"
        for step in range(2):
            group = file.create_group(f"data/{step * 100}/particles")
            group.parent.attrs["time"], group.parent.attrs["timeUnitSI"] = step * 1.5, 1.0
            for k, axis in enumerate("xyz"):
                group[f"e/position/{axis}"] = places[step, :, k]
                group[f"e/position/{axis}"].attrs["unitSI"] = 3e-6
                group[f"e/momentum/{axis}"] = places[step, :, k] * 3
                fixed_one = group.create_group(f"e/positionOffset/{axis}").attrs
                fixed_one["value"], fixed_one["shape"], fixed_one["unitSI"] = 2.0 * k, [4], 0.5e-6
                fixed_one = group.create_group(f"H/position/{axis}").attrs
                fixed_one["value"], fixed_one["shape"] = 7.0, [1]
            del group["e/positionOffset/y"]
            group["e/positionOffset/y"] = cells
            group["e/positionOffset/y"].attrs["unitSI"] = 0.25e-6
            group["e/weighting"] = np.arange(4.0)
            charge = group.create_group("e/charge").attrs
            charge["value"], charge["shape"] = -1.0, [4]
    mine = read(folder / "beam.h5")
    assert len(mine) == 2
    for i, one in enumerate(mine):
        moved = places[i].copy()
        moved[:, 0] += 0.0 * (0.5e-6 / 3e-6)
        moved[:, 1] += cells * (0.25e-6 / 3e-6)
        moved[:, 2] += 4.0 * (0.5e-6 / 3e-6)
        same("beam.h5", one, np.vstack([[[7, 7, 7]], moved]), species=["H"] + ["e"] * 4)
        same_column(one, "momentum_z", [np.nan, *(places[i, :, 2] * 3)])
        same_column(one, "weighting", [np.nan, 0, 1, 2, 3])
        same_column(one, "charge", [np.nan, -1, -1, -1, -1])


def refused(folder, make, told):
    path = folder / "wrong.h5"
    with h5py.File(path, "w") as file:
        make(file)
    code, text = run(path)
    assert code != 0 and told in text and len(text.splitlines()) == 1, f"{told!r}: {text}"


def refusals(folder):
    """Nothing outside the file is read, and nothing is loaded."""
    with h5py.File(folder / "secret.h5", "w") as file:
        file["position"] = np.ones((2, 3))
        file["group/position"] = np.ones((2, 3))
    (folder / "raw").write_bytes(np.ones((2, 3)).tobytes())

    def linked(file):
        file.create_group("particles/all")["position"] = h5py.ExternalLink("secret.h5", "position")

    def through(file):
        file.create_group("particles")["all"] = h5py.ExternalLink("secret.h5", "group")

    def softly(file):
        file["away"] = h5py.ExternalLink("secret.h5", "group")
        file.create_group("particles/all")["position"] = h5py.SoftLink("/away/position")

    def raw(file):
        file.create_group("particles/all").create_dataset(
            "position", (2, 3), "f8", external=[(str(folder / "raw"), 0, 48)])

    def virtual(file):
        layout = h5py.VirtualLayout(shape=(2, 3), dtype="f8")
        layout[:] = h5py.VirtualSource(str(folder / "secret.h5"), "position", shape=(2, 3))
        file.create_group("particles/all").create_virtual_dataset("position", layout)

    def packed(file):
        file.create_dataset("particles/all/position", data=np.ones((20, 3)), compression="lzf")

    def vast(file):
        file.create_dataset("particles/all/position/value", (1, 10**12, 3), "f8", chunks=(1, 10**5, 3))

    def large_chunks(file):
        file.create_dataset("particles/all/position", (2**27, 3), "f4", chunks=(2**27, 3), compression="gzip")

    def flat(file):
        file["particles/all/position"] = np.ones((5, 2))

    def texts(file):
        file["particles/all/position"] = np.full((5, 3), b"x")

    def infinite(file):
        file["particles/all/position"] = np.array([[0, 0, 0], [0, np.inf, 0]])

    def other(file):
        file["numbers"] = [1, 2]
        file["bad"] = h5py.SoftLink("/nowhere")
        file["particles/all/position"] = h5py.SoftLink("/nowhere")

    for make, told in [
        (linked, "links there are not followed"), (through, "links there are not followed"),
        (softly, "its link is not followed"), (raw, "its bytes are in other files"),
        (virtual, "it is virtual"), (packed, "packed by filter 32000"), (vast, "1000000000000 particles need"),
        (large_chunks, "its chunks have more than 1 GiB"), (flat, "positions of shape (5, 2), expected three numbers each"), (texts, "expected three numbers each"),
        (infinite, "particle 2 is at no finite position"), (other, "it lacks the groups of H5MD"),
    ]:  # fmt: skip
        refused(folder, make, told)
    for content in (b"", b"hello\n", b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 40):
        (folder / "a.h5").write_bytes(content)
        code, text = run(folder / "a.h5")
        assert code == 1 and "HDF5: " in text and len(text.splitlines()) == 1, text


def broken(folder):
    """Bits are flipped and ends cut off: there is an answer or one error, and the program lives."""
    with h5py.File(folder / "small.h5", "w") as file:
        group = file.create_group("particles/all")
        group.create_dataset("position/value", data=RNG.normal(size=(2, 9, 3)), chunks=(1, 9, 3), compression="gzip")
        group["species"] = np.arange(9) % 2
        group["name"] = np.array(["a"] * 9, dtype=h5py.string_dtype())
        group["box/edges"] = [3.0, 4.0, 5.0]
    whole = (folder / "small.h5").read_bytes()
    used = [i for i, byte in enumerate(whole) if byte != 0]  # the rest is room for more
    crashed = []
    trials = [("flip", place, int(RNG.integers(8))) for place in RNG.choice(used, 150)]
    trials += [("cut", int(size), 0) for size in RNG.integers(0, len(whole), 30)]
    for what, place, bit in trials:
        content = bytearray(whole)
        if what == "flip":
            content[place] ^= 1 << bit
        else:
            del content[place:]
        (folder / "broken.h5").write_bytes(content)
        code, text = run(folder / "broken.h5")
        if code not in (0, 1) or (code == 1 and len(text.splitlines()) > 2):
            crashed.append((what, place, bit, code))
    assert not crashed, crashed
    print(f"{len(trials)} broken files")


with tempfile.TemporaryDirectory() as probe:
    with h5py.File(Path(probe) / "probe.h5", "w") as made:
        made["particles/all/position"] = np.zeros((1, 3))
    if "boule_hdf5.so is not in" in run(Path(probe) / "probe.h5")[1]:
        print("Boule has no module for HDF5")
        sys.exit(77)
for test in (h5md, snapshot, openpmd, refusals, broken):
    with tempfile.TemporaryDirectory() as made:
        test(Path(made))
