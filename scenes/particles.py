#!/usr/bin/env python3
"""particles.py: writes the particle files of docs/particles.md into the working directory.

gold.xyz    a nanoparticle: a truncated octahedron, with each atom's number of neighbours
slab.xyz    a surface of copper in its cell, with carbon monoxide on it
salt.xyz    a cube of sodium chloride
heap.xyz    grains of many sizes that were poured on a floor, with their speeds
disc.csv    a galaxy: stars on circles, with their speeds
wave.xyz    a chain of 40 atoms that swings: a trajectory of 10 frames
bilayer.data  a membrane of 128 lipids, four kinds of beads and their bonds, in the format of LAMMPS
dna.data    two strands of B-DNA, three beads for each nucleotide, and their bonds, likewise
perovskite.xyz  a cell of strontium titanate
shear.xyz   a crystal that is sheared along x, with the speeds of its atoms
stars.csv   a globular cluster with temperatures, and three stars that are far away
"""
import math
import random


def write(name, header, rows):
    with open(name, "w", encoding="ascii") as file:
        file.write(f"{len(rows)}\n{header}\n")
        file.writelines(row + "\n" for row in rows)


def lattice(n, step, basis):
    for i in range(-n, n + 1):
        for j in range(-n, n + 1):
            for k in range(-n, n + 1):
                for x, y, z in basis:
                    yield (step * (i + x), step * (j + y), step * (k + z))


FACE_CENTRED = ((0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0))


def gold():
    a = 4.078
    atoms = [p for p in lattice(4, a, FACE_CENTRED)
             if sum(map(abs, p)) <= 4.01 * a and max(map(abs, p)) <= 2.51 * a]
    near = (a * math.sqrt(0.5) * 1.1) ** 2
    rows = []
    for p in atoms:
        neighbours = sum(1 for q in atoms if 0 < sum((s - t) ** 2 for s, t in zip(p, q)) < near)
        rows.append("Au %.3f %.3f %.3f %d" % (*p, neighbours))
    write("gold.xyz", "Properties=species:S:1:pos:R:3:neighbours:I:1", rows)


def slab():
    d, layers, n = 2.556, 3, 8  # distance of neighbours
    rise = d * math.sqrt(2 / 3)
    rows = []
    for layer in range(layers):
        for i in range(n):
            for j in range(n):
                x = d * (i + 0.5 * (j % 2) + (0.5 if layer % 3 == 1 else 0))
                y = d * (math.sqrt(3) / 2 * j + math.sqrt(3) / 6 * (layer % 3))
                rows.append("Cu %.3f %.3f %.3f" % (x % (n * d), y, rise * layer))
    for i, j in ((1, 1), (4, 2), (6, 5), (2, 5), (5, 7)):
        x = d * (i + 0.5 * (j % 2)) % (n * d)
        y = d * (math.sqrt(3) / 2 * j + math.sqrt(3) / 3)
        top = rise * (layers - 1)
        rows.append("C %.3f %.3f %.3f" % (x, y, top + 1.85))
        rows.append("O %.3f %.3f %.3f" % (x, y, top + 3.0))
    cell = "%.3f 0 0 0 %.3f 0 0 0 20" % (n * d, n * d * math.sqrt(3) / 2)
    write("slab.xyz", f'Lattice="{cell}" Properties=species:S:1:pos:R:3', rows)


def salt():
    n, step = 8, 2.82
    rows = []
    for i in range(n):
        for j in range(n):
            for k in range(n):
                x, y, z = (step * (c - (n - 1) / 2) for c in (i, j, k))
                rows.append("%s %.2f %.2f %.2f" % ("Cl" if (i + j + k) % 2 else "Na", x, y, z))
    edge = n * step
    write("salt.xyz", f'Lattice="{edge} 0 0 0 {edge} 0 0 0 {edge}" '
          f'Origin="{-edge / 2} {-edge / 2} {-edge / 2}" Properties=species:S:1:pos:R:3', rows)


def rest(x, y, r, grains):
    """The height at which a grain that falls at x, y first touches another one or the floor."""
    height = r
    for gx, gy, gz, gr in grains:
        across = (gx - x) ** 2 + (gy - y) ** 2
        if across < (gr + r) ** 2:
            height = max(height, gz + math.sqrt((gr + r) ** 2 - across))
    return height


def heap():
    """Each grain rolls down in small steps as far as it gets."""
    rng = random.Random(4)
    grains = []
    for _ in range(700):
        r = 0.03 * 10 ** rng.random()
        angle, away = rng.uniform(0, 2 * math.pi), 0.5 * math.sqrt(rng.random())
        x, y = away * math.cos(angle), away * math.sin(angle)
        z = rest(x, y, r, grains)
        for _ in range(60):
            way = rng.uniform(0, 2 * math.pi)
            nx, ny = x + 0.5 * r * math.cos(way), y + 0.5 * r * math.sin(way)
            nz = rest(nx, ny, r, grains)
            if nz < z:
                x, y, z = nx, ny, nz
        grains.append((x, y, z, r))
    rows = []
    for x, y, z, r in grains:
        speed = 0.6 * z + 0.25 * math.hypot(x, y) * rng.random()
        vx, vy, vz = (speed * rng.gauss(0, 0.6) for _ in range(3))
        rows.append("%.3f %.3f %.3f %.3f %.3f %.3f %.3f" % (x, y, z, r, vx, vy, vz))
    write("heap.xyz", 'Lattice="4 0 0 0 4 0 0 0 2" Origin="-2 -2 0" '
          "Properties=pos:R:3:radius:R:1:velo:R:3", rows)


def disc():
    rng = random.Random(5)
    with open("disc.csv", "w", encoding="ascii") as file:
        file.write("x,y,z,radius,speed\n")
        for i in range(1500):
            away = 0.1 + 2 * rng.random()
            arm = math.pi * (i % 2) + 2.2 * math.log(away) + rng.gauss(0, 0.3)
            x, y, z = away * math.cos(arm), away * math.sin(arm), rng.gauss(0, 0.04)
            file.write("%.3f,%.3f,%.3f,%.3f,%.2f\n" % (x, y, z, 0.02 + 0.04 * rng.random() ** 3,
                                                       1 / math.sqrt(0.2 + away)))


def wave():
    with open("wave.xyz", "w", encoding="ascii") as file:
        for frame in range(10):
            file.write("40\nProperties=pos:R:3:vz:R:1\n")
            for i in range(40):
                phase = 2 * math.pi * (i / 20 - frame / 10)
                file.write("%.2f 0 %.3f %.3f\n" % (0.5 * i, 2 * math.sin(phase), -math.cos(phase)))


def lipid(rng, x, y, side):
    """Choline, phosphate, two of glycerol and two tails of four beads: kind and place of each; and their bonds."""
    beads, bonds = [], []

    def add(kind, at, to=None):
        beads.append((kind, at))
        if to is not None:
            bonds.append((to, len(beads) - 1))
        return len(beads) - 1

    def beside(at, down, apart):
        way = rng.uniform(0, 2 * math.pi)
        return (at[0] + apart * math.cos(way), at[1] + apart * math.sin(way), at[2] - side * down)

    phosphate = (x, y, side * (20 + rng.gauss(0, 0.8)))
    root = add(2, phosphate)
    add(1, beside(phosphate, -2.5, 3.5), root)
    lean = rng.uniform(0, 2 * math.pi)
    for sign in (-1, 1):
        at = (x + sign * 2.2 * math.cos(lean), y + sign * 2.2 * math.sin(lean),
              phosphate[2] - side * (3.5 + 0.8 * sign))
        root = last = add(3, at, root)
        for _ in range(4):
            at = beside(at, 3.9, 1.6)
            last = add(4, at, last)
    return beads, bonds


def bilayer():
    rng, n, step = random.Random(6), 8, 8.0
    beads, bonds = [], []
    for side in (1, -1):
        for i in range(n):
            for j in range(n):
                new, joined = lipid(rng, step * (i + 0.5 + rng.gauss(0, 0.08)), step * (j + 0.5 + rng.gauss(0, 0.08)),
                                    side)
                bonds += [(a + len(beads), b + len(beads)) for a, b in joined]
                beads += new
    with open("bilayer.data", "w", encoding="ascii") as file:
        file.write(f"A membrane, in angstrom\n\n{len(beads)} atoms\n{len(bonds)} bonds\n4 atom types\n1 bond types\n\n"
                   f"0 {n * step:g} xlo xhi\n0 {n * step:g} ylo yhi\n-32 32 zlo zhi\n\nAtoms # bond\n\n")
        for i, (kind, (x, y, z)) in enumerate(beads):
            file.write(f"{i + 1} {i // 12 + 1} {kind} {x:.2f} {y:.2f} {z:.2f}\n")
        file.write("\nBonds\n\n")
        file.writelines(f"{i + 1} 1 {a + 1} {b + 1}\n" for i, (a, b) in enumerate(bonds))


def dna():
    """Phosphate, sugar and base of each nucleotide where the model 3SPN has them (Knotts et al., J. Chem. Phys. 126,
    084901, 2007). Kinds: the backbones of both strands, then A, T, G, C."""
    backbone = ((8.918, 94.038, 2.186), (6.981, 70.197, 1.280))
    bases = {"A": (0.773, 41.905, 0.051), "T": (2.349, 86.119, 0.191), "G": (0.828, 40.691, 0.053),
             "C": (2.296, 85.027, 0.187)}
    first, beads, bonds = "CGCGAATTCGCGTTAGCATCCGAT", [], []
    for strand, letters in ((1, first), (-1, first.translate(str.maketrans("ATGC", "TACG")))):
        for i, letter in enumerate(letters):
            at = len(beads)
            own = 1 if strand == 1 else 2
            for kind, (r, angle, z) in zip((own, own, 3 + list(bases).index(letter)), (*backbone, bases[letter])):
                turn = math.radians(strand * angle + 36 * i)
                beads.append((kind, r * math.cos(turn), r * math.sin(turn), strand * z + 3.38 * i))
            bonds += [(at, at + 1), (at + 1, at + 2)]
            if i > 0:  # sugar to the next phosphate from 5' to 3'
                bonds.append((at - 2, at) if strand == 1 else (at - 3, at + 1))
    n = len(first)
    bonds += [(3 * i + 2, 3 * (n + i) + 2) for i in range(n)]
    with open("dna.data", "w", encoding="ascii") as file:
        file.write(f"B-DNA, in angstrom\n\n{len(beads)} atoms\n{len(bonds)} bonds\n6 atom types\n1 bond types\n\n"
                   f"-12 12 xlo xhi\n-12 12 ylo yhi\n-4 {3.38 * n:.2f} zlo zhi\n\nAtoms # bond\n\n")
        for i, (kind, x, y, z) in enumerate(beads):
            file.write(f"{i + 1} {1 + i // (3 * n)} {kind} {x:.2f} {y:.2f} {z:.2f}\n")
        file.write("\nBonds\n\n")
        file.writelines(f"{i + 1} 1 {a + 1} {b + 1}\n" for i, (a, b) in enumerate(bonds))


def perovskite():
    a = 3.905
    places = (("Sr", 0, 0, 0), ("Ti", 1, 1, 1), ("O", 1, 1, 0), ("O", 1, 0, 1), ("O", 0, 1, 1))
    write("perovskite.xyz", f'Lattice="{a} 0 0 0 {a} 0 0 0 {a}" pbc="T T T" Properties=species:S:1:pos:R:3',
          ["%s %.4f %.4f %.4f" % (kind, *(a / 2 * c for c in place)) for kind, *place in places])


def shear():
    """The middle gives way."""
    rng, step, n = random.Random(8), 1.58, (10, 5, 8)
    rows = []
    for i in range(n[0]):
        for j in range(n[1]):
            for k in range(n[2]):
                for basis in FACE_CENTRED:
                    x, y, z = (step * (c + b) for c, b in zip((i, j, k), basis))
                    height = 2 * z / (step * n[2]) - 1
                    shake = 0.16 if abs(height) < 0.25 else 0.04
                    x, y, z = (c + rng.gauss(0, shake) for c in (x + 2.5 * height, y, z))
                    rows.append("%.2f %.2f %.2f %.2f" % (x, y, z, 0.8 * height + rng.gauss(0, 0.2)))
    write("shear.xyz", "Properties=pos:R:3:vx:R:1", rows)


def stars():
    rng = random.Random(9)
    with open("stars.csv", "w", encoding="ascii") as file:
        file.write("x,y,z,radius,temperature\n")
        for _ in range(1200):
            away = min(1 / math.sqrt(rng.uniform(0.002, 1) ** (-2 / 3) - 0.999), 2.5 + 0.5 * rng.random())
            z, turn = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
            across = away * math.sqrt(1 - z * z)
            hot = rng.random() ** 3
            file.write("%.3f,%.3f,%.3f,%.3f,%.0f\n" % (across * math.cos(turn), across * math.sin(turn), away * z,
                                                      0.025 + 0.05 * hot, 3000 + 9000 * hot))
        for x, y, z in ((900, 40, 30), (-700, 300, -100), (20, -800, 400)):
            file.write("%d,%d,%d,0.03,4000\n" % (x, y, z))


if __name__ == "__main__":
    for make in (gold, slab, salt, heap, disc, wave, bilayer, dna, perovskite, shear, stars):
        make()
