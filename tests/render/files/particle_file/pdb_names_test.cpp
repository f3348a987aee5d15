#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "tests/render/files/particle_file/read_text.h"

// What the columns of names, elements and charges of PDB files mean, as programs write them.

namespace boule::pdb_names {
namespace {

using test::read_particles;
using testing::ElementsAre;

const std::string guessed = "the elements are guessed from the names of atoms and residues";

/// An atom's record: columns 13 to 26 name it, `end` stands from column 73 on.
std::string record(const std::string& names, const std::string& end = "") {
  return "ATOM      1 " + names + "       1.000   2.000   3.000  1.00  0.00      " + end + "\n";
}

std::vector<std::string> texts_of(const TextColumn& column) {
  std::vector<std::string> found;
  for (const std::uint32_t index : column.indices) found.push_back(column.texts[index]);
  return found;
}

class PdbNames : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  }

  static ParticleFrame read(const std::string& text) {
    auto frame = read_particles("a.pdb", text);
    EXPECT_TRUE(frame.ok()) << format_diagnostic(frame.error());
    return frame ? std::move(frame).value() : ParticleFrame{};
  }
};

TEST_F(PdbNames, ChargesChangeNoElement) {
  const std::string charges[] = {" 0", "0", "1+", "2-", "+1", "-2", " +", "+", "", "  "};
  for (const std::string& charge : charges) {
    const ParticleFrame frame = read(
        record(" N   LEU A   1", "SYST N" + charge) + record(" CA  LEU A   1", "1ABC C" + charge) +
        record("SOD  SOD A   2", "SYSTNA" + charge) + record("CL    CL A   3", "    Cl" + charge));
    EXPECT_THAT(texts_of(*frame.species), ElementsAre("N", "C", "Na", "Cl")) << charge;
    EXPECT_TRUE(frame.notes.empty()) << charge;
  }
  // A charge beside a symbol of one letter, and symbols that begin in column 77.
  const ParticleFrame shifted =
      read(record(" N   LEU A   1", "SYSTN1+") + record(" CA  LEU A   1", "SYSTC "));
  EXPECT_THAT(texts_of(*shifted.species), ElementsAre("N", "C"));
}

TEST_F(PdbNames, NumbersOfLinesAreNoElements) {
  const ParticleFrame frame =
      read(record(" CA  ALA     1", "1CRN  70") + record(" N   ALA     1", "1CRN1070") +
           record(" O   ALA     1", "1CRNF  7"));
  EXPECT_THAT(texts_of(*frame.species), ElementsAre("C", "N", "O"));
}

TEST_F(PdbNames, IonsAreKnownByTheirResidue) {
  const ParticleFrame charmm =
      read(record(" N   ALA P   1", "PROA") + record(" CA  ALA P   1", "PROA") +
           record("SOD  SOD I   1", "IONS") + record("CLA  CLA I   2", "IONS") +
           record("POT  POT I   3", "IONS") + record("CAL  CAL I   4", "IONS") +
           record("MG   MG  I   5", "IONS") + record("ZN   ZN2 I   6", "IONS") +
           record("CD   CD2 I   7", "IONS") + record("CES  CES I   8", "IONS"));
  EXPECT_THAT(texts_of(*charmm.species),
              ElementsAre("N", "C", "Na", "Cl", "K", "Ca", "Mg", "Zn", "Cd", "Cs"));
  EXPECT_THAT(charmm.notes, ElementsAre(guessed));
  const ParticleFrame others =
      read(record(" CA  GLY     1") + record("Na+  Na+     2") + record("Cl-  Cl-     3") +
           record(" K+   K+     4") + record("NA    NA     5") + record("CL    CL     6") +
           record(" NA  SOD     7") + record("CA    CA     8") + record(" C   CLA     9"));
  EXPECT_THAT(texts_of(*others.species),
              ElementsAre("C", "Na", "Cl", "K", "Na", "Cl", "Na", "Ca", "C"));
}

TEST_F(PdbNames, ResiduesTellElementsOfUnalignedNames) {
  const ParticleFrame frame =
      read(record("CA   ALA A   1") + record("HG   SER A   2") + record("CD   LYS A   3") +
           record("SE   MSE A   4") + record("OH2  HOH A   5") + record("HG    HG A   6") +
           record("Hg13 VAL A   7"));
  EXPECT_THAT(texts_of(*frame.species), ElementsAre("C", "H", "C", "Se", "Hg", "H"));
}

TEST_F(PdbNames, NamesOfResiduesHaveFourLetters) {
  const ParticleFrame frame =
      read(record(" P   POPCL   1", "MEMB P") + record(" OH2 TIP3W   1", "WAT  O") +
           record(" OW  SOL     2", "     O") + record(" C1  DPPC    3", "     C") +
           record(" OH2 TIP X   4", "     O") + record(" CA  ALAAA   5", "     C") +
           record("ZN    ZNAB   6", "    ZN") + record(" CA  NALAA   7", "     C"));
  EXPECT_THAT(texts_of(*find_text_column(frame, "resname")),
              ElementsAre("POPC", "TIP3", "SOL", "DPPC", "TIP", "ALA", "ZN", "NALA"));
  EXPECT_THAT(texts_of(*find_text_column(frame, "chain")),
              ElementsAre("L", "W", "", "", "X", "AA", "AB", "A"));
}

TEST_F(PdbNames, CellsWithoutEdgesAreNone) {
  for (const std::string edges : {"                           ", "    0.000    0.000    0.000",
                                  "    1.000    1.000    1.000"}) {
    for (const std::string angles :
         {"  90.00  90.00  90.00 P 1           1", "", "   0.00   0.00   0.00"}) {
      const ParticleFrame frame =
          read("CRYST1" + edges + angles + "\n" + record(" CA  ALA A   1", "     C"));
      EXPECT_EQ(frame.size(), 1U) << edges << angles;
      EXPECT_FALSE(frame.cell.has_value()) << edges << angles;
    }
  }
}

TEST_F(PdbNames, SerialNumbersMayBeHybrid36) {
  const std::string text =
      "ATOM  A0000  CA  ALA A   1       1.000   2.000   3.000\n"
      "HETATM*****  CA  ALA A   1       1.000   2.000   3.000\n"
      "ATOM  99999  CA  ALA A   1       1.000   2.000   3.000\n";
  const ParticleFrame frame = read(text);
  EXPECT_EQ(frame.size(), 3U);
  EXPECT_EQ(find_number_column(frame, "id")->values[0], 100000);
  EXPECT_EQ(find_number_column(frame, "id")->values[2], 99999);
}

}  // namespace
}  // namespace boule::pdb_names
