"""Atoms of ASE to a picture in two lines. Run it: python3 ase_two_lines.py PICTURE.png"""

import sys

import ase.build

import boule

atoms = ase.build.fcc111("Cu", size=(5, 5, 4), vacuum=8.0)
ase.build.add_adsorbate(atoms, ase.build.molecule("CH3OH"), height=2.0, position="ontop")

scene = boule.from_ase(atoms)
boule.render(scene, size=(480, 360)).save(sys.argv[1])
