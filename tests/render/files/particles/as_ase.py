#!/usr/bin/env python3
"""as_ase.py PROGRAM: elements are as in ASE's tables, colour maps as in matplotlib.

PROGRAM is boule_print_tables. All values are compared: radii exactly, colours of elements to the
code, colour maps to the one or two codes that their headers promise. Exit code 77: ASE or
matplotlib is not there.
"""
import subprocess
import sys

try:
    import numpy as np
    from ase.data import chemical_symbols, covalent_radii
    from ase.data.colors import jmol_colors
    from ase.data.vdw_alvarez import vdw_radii
    import matplotlib
except ImportError:
    print("python3-ase or python3-matplotlib is missing")
    sys.exit(77)


def components(text):
    return np.array([int(text[k:k + 2], 16) for k in (1, 3, 5)])


def compare_element(number, symbol, color, vdw, covalent):
    """ASE writes 0.2 for covalent radii that nobody has measured, and colours to three digits."""
    assert symbol == chemical_symbols[number], symbol
    assert (components(color) == np.round(jmol_colors[number] * 255)).all(), symbol
    theirs = vdw_radii[number] if number < len(vdw_radii) else np.nan
    assert float(vdw) == (theirs if np.isfinite(theirs) else 0), symbol
    theirs = covalent_radii[number]
    assert float(covalent) == (theirs if theirs != 0.2 else 0), symbol


def compare_map(name, colors):
    """Returns by how many codes the map is off at most."""
    theirs = matplotlib.colormaps["gray" if name == "grey" else name]
    rows = np.array([theirs(i)[:3] for i in range(256)])
    mine = np.array([components(color) for color in colors])
    off = np.abs(mine - np.floor(rows * 255 + 0.5)).max()
    assert off <= (2 if name == "cividis" else 1), f"{name}: {off} codes off"
    return int(off)


elements = 0
maps = {}
for line in subprocess.run([sys.argv[1]], capture_output=True, text=True,
                           check=True).stdout.splitlines():
    kind, *words = line.split()
    if kind == "element":
        elements += 1
        compare_element(elements, *words)
    else:
        maps[words[0]] = compare_map(words[0], words[1:])
assert elements == 109 and len(maps) == 8
print(f"{elements} elements are as in ASE; codes off matplotlib's maps: {maps}")
