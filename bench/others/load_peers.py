#!/usr/bin/python3
"""load_peers.py [ATOMS]: how fast numpy.loadtxt and ASE read an XYZ file and a LAMMPS dump.

load_peers.py --make FOLDER: writes what bench_particles times: trajectory.xyz of 1 GB in 1000 frames,
and large.xyz of 10^7 atoms.

Needs python3-numpy and python3-ase; OVITO is in no package of Debian 12. The clock is CPU time, as
bench_load's.
"""
import sys
import tempfile
import time
from pathlib import Path

import numpy as np


def xyz_block(n, seed):
    """A frame with the columns of bench_load's file."""
    positions = np.random.default_rng(seed).uniform(-10, 10, (n, 3))
    rows = (f"{'OHH'[i % 3]:<2} {x:14.8f} {y:14.8f} {z:14.8f}\n" for i, (x, y, z) in enumerate(positions))
    return f"{n}\ncloud\n" + "".join(rows)


def dump_block(n, seed):
    rows = np.random.default_rng(seed).uniform(-10, 10, (n, 6))
    text = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{n}\nITEM: BOX BOUNDS pp pp pp\n" + "-10 10\n" * 3
    text += "ITEM: ATOMS id type x y z vx vy vz\n"
    return text + "".join(f"{i + 1} {i % 3 + 1} " + " ".join(f"{v:g}" for v in row) + "\n"
                          for i, row in enumerate(rows))


def time_reader(name, path, read):
    start = time.process_time()
    read()
    seconds = time.process_time() - start
    size = path.stat().st_size * 1e-6
    print(f"{name:<40} {size:7.1f} MB  {size / seconds:8.2f} MB/s")


def compare(n):
    import ase.io
    with tempfile.TemporaryDirectory() as name:
        xyz, dump = Path(name) / "cloud.xyz", Path(name) / "cloud.dump"
        xyz.write_text(xyz_block(n, 1))
        dump.write_text(dump_block(n, 2))
        time_reader("xyz: numpy.loadtxt, numbers only", xyz,
                    lambda: np.loadtxt(xyz, skiprows=2, usecols=(1, 2, 3)))
        time_reader("xyz: ase.io.read", xyz, lambda: ase.io.read(xyz, format="xyz"))
        time_reader("extxyz: ase.io.read", xyz, lambda: ase.io.read(xyz, format="extxyz"))
        time_reader("dump: numpy.loadtxt, numbers only", dump, lambda: np.loadtxt(dump, skiprows=9))
        time_reader("dump: ase.io.read", dump, lambda: ase.io.read(dump, format="lammps-dump-text"))


def make(folder):
    block = xyz_block(21000, 1)
    with open(folder / "trajectory.xyz", "w") as file:
        for _ in range(1000):
            file.write(block)
    with open(folder / "large.xyz", "w") as file:
        file.write("10000000\nlarge\n")
        rows = xyz_block(100000, 2).split("\n", 2)[2]
        for _ in range(100):
            file.write(rows)


if len(sys.argv) == 3 and sys.argv[1] == "--make":
    make(Path(sys.argv[2]))
else:
    compare(int(sys.argv[1]) if len(sys.argv) > 1 else 200000)
