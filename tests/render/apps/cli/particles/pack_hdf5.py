#!/usr/bin/env python3
"""pack_hdf5.py PROGRAM [PARTICLES]: boule packs particles of HDF5 that do not fit into memory.

Files are written by h5py. The packed bytes are those of the same particles in a .npy file, which is
read as a whole. PARTICLES of a frame that is larger than the limit on memory are packed too. Exit
code 77: there is no h5py, or Boule has no module for HDF5.
"""
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import numpy as np
except ImportError:
    print("h5py is missing")
    sys.exit(77)

PROGRAM = sys.argv[1]
RNG = np.random.default_rng(7)
KINDS = {0: "gas", 1: "halo", 4: "stars"}


def run(*words, data=None):
    """What it says. `data`: how many bytes of memory of its own it may have."""
    limit = None if data is None else lambda: resource.setrlimit(resource.RLIMIT_DATA, (data, data))
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, preexec_fn=limit)
    return done.returncode, done.stdout + done.stderr


def pack(source, *options, data=None):
    """The bytes of a packed file, and what was said."""
    packed = source.with_suffix(".boule")
    code, text = run("pack", source, "-o", packed, "-t", 1, *options, data=data)
    assert code == 0, f"{source.name} {options}: {text}"
    return packed.read_bytes(), text


def snapshot(path, counts, storage):
    """Types of particles with radii and speeds; and the same as fields."""
    fields = [("x", "f8"), ("y", "f8"), ("z", "f8"), ("type", "U5"), ("size", "f8"), ("speed", "f8")]
    rows = np.empty(sum(counts.values()), fields)
    begin = 0
    with h5py.File(path, "w") as file:
        for kind, count in counts.items():
            places = (RNG.random((count, 3)) * 90 + 1000).astype("f4")
            size, speed = RNG.random(count).astype("f4") + 0.01, RNG.normal(size=count)
            speed[::1000] = np.nan
            group = file.create_group(f"PartType{kind}")
            for name, values in [("Coordinates", places), ("size", size), ("speed", speed)]:
                group.create_dataset(name, data=values, **storage)
            part = rows[begin : begin + count]
            part["x"], part["y"], part["z"] = places.T
            part["type"], part["size"], part["speed"] = KINDS[kind], size, speed
            begin += count
    np.save(path.with_suffix(".npy"), rows)


def same_bytes(folder):
    """For each choice that looks at one particle at a time; others are read as a whole, and the same."""
    packed = {"chunks": True, "compression": "gzip", "shuffle": True}
    for storage, most in [({}, 8), (packed, 2)]:
        snapshot(folder / "snap.hdf5", {0: 300_000, 1: 5, 4: 270_000}, storage)
        for options in [
            ("--radius", "size"), ("--radius", "0.5"), ("--radius", "size", "--scale", "0.5", "--color", "red"),
            ("--radius", "0.5", "--radii", "gas=0.25", "--colors", "stars=gold"),
            ("--radius", "size", "--color", "speed", "--map", "viridis", "--range", "-1,1"),
            ("--radius", "size", "--select", "type == 'stars' && size > 0.5"),
            ("--radius", "size", "--color", "speed", "--map", "viridis"), (),
        ][:most]:  # fmt: skip
            streamed, text = pack(folder / "snap.hdf5", *options)
            whole, other = pack(folder / "snap.npy", *options)
            assert streamed == whole, f"{storage} {options}: other bytes: {text}"
            notes = [line.replace("snap.npy", "snap.hdf5") for line in other.splitlines()]
            mine = [line for line in text.splitlines() if "read by HDF5" not in line]
            assert mine == notes, f"{options}: {mine}, {notes}"


def wrong_numbers(folder):
    """Errors name the particle by its place in the frame."""
    for name, value, options, exit_code, told in [
        ("size", -1, ("--radius", "size"), 2, "radius of particle 300001 of 300003"),
        ("size", np.inf, ("--radius", "size"), 3, "column 'size' of particle 300001"),
        ("Coordinates", np.nan, ("--radius", "1"), 3, "particle 300001 is at no finite position"),
    ]:
        with h5py.File(folder / "wrong.hdf5", "w") as file:
            group = file.create_group("PartType1")
            group["Coordinates"], group["size"] = np.zeros((300_003, 3)), np.ones(300_003)
            group[name][300_000] = value
        code, text = run("pack", folder / "wrong.hdf5", "-o", folder / "wrong.boule", *options)
        assert code == exit_code and told in text, f"{told}: {text}"
        assert not list(folder.glob("wrong.boule*")), "something is left"


def beyond_memory(folder, particles):
    """A frame that takes 28 bytes a particle, packed in less; as a whole it is refused."""
    path, data = folder / "large.hdf5", particles * 14 + (60 << 20)
    with h5py.File(path, "w") as file:
        places = file.create_dataset("PartType1/Coordinates", (particles, 3), "f4")
        for begin in range(0, particles, 1 << 20):
            count = min(1 << 20, particles - begin)
            places[begin : begin + count] = RNG.random((count, 3))
    memory = ("--memory", f"{max(16, data >> 22)}M")
    code, text = run("pack", path, "-o", folder / "no.boule", "-t", 1, *memory, data=data)
    assert code != 0 and "memory" in text, text  # the radius is found from all particles
    code, text = run("pack", path, "-o", folder / "large.boule", "-t", 1, *memory, "--radius", "1e-3", data=data)
    assert code == 0 and f"{particles} spheres" in text.replace(",", ""), text
    print(f"{particles} particles with {data >> 20} MiB")


with tempfile.TemporaryDirectory() as made:
    if len(sys.argv) == 2:
        same_bytes(Path(made))
        wrong_numbers(Path(made))
    beyond_memory(Path(made), int(sys.argv[2]) if len(sys.argv) > 2 else 6_000_000)
