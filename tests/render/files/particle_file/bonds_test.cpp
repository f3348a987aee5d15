#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "tests/render/files/particle_file/read_text.h"

// The bonds that files list.

namespace boule {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const ParticleFileOptions with_bonds{.most_bonded = 1000};

std::vector<std::array<std::uint32_t, 2>> bonds_of(const std::string& name,
                                                   const std::string& bytes,
                                                   ParticleFileOptions options = with_bonds,
                                                   long frame = -1) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  const auto read = read_particles(name, bytes, options, frame);
  EXPECT_TRUE(read.ok()) << format_diagnostic(read.error());
  if (!read) return pairs;
  for (const auto& [a, b] : read.value().bonds) pairs.push_back({a, b});
  return pairs;
}

using Pair = std::array<std::uint32_t, 2>;

std::string atom(const std::string& serial, const std::string& names, const std::string& x = "1") {
  return "HETATM" + serial + " " + names + "      " + x + ".000   0.000   0.000  1.00  0.00\n";
}

const std::string four_atoms = atom("   11", " C1  LIG A   1 ") + atom("   12", " C2  LIG A   1 ") +
                               atom("   20", " O   HOH A   2 ") + atom("   21", " N1  LIG A   3 ");

TEST(Bonds, PdbHasConect) {
  if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  const std::string records =
      "CONECT   11   12   21\r\nCONECT   12   11\nCONECT   20   11\nCONECT   99   11\nconect   "
      "12\n";
  EXPECT_THAT(bonds_of("a.pdb", four_atoms + records), ElementsAre(Pair{0, 1}, Pair{0, 2}));
  ParticleFileOptions water = with_bonds;
  water.water = true;
  EXPECT_THAT(bonds_of("a.pdb", four_atoms + records, water),
              ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{0, 3}));
  EXPECT_THAT(bonds_of("a.pdb", four_atoms + records, {}), IsEmpty());
  EXPECT_THAT(bonds_of("a.pdb", four_atoms + records, {.most_bonded = 3}), IsEmpty());
  const auto read = read_particles("a.pdb", four_atoms + records, with_bonds);
  EXPECT_FALSE(read.value().lists_all_bonds);
}

TEST(Bonds, PdbSerialsAreUnique) {
  if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  const std::string twice = four_atoms + atom("   12", " N2  LIG A   4 ");
  EXPECT_THAT(bonds_of("a.pdb", twice + "CONECT   11   12   21\n"), ElementsAre(Pair{0, 2}));
  const std::string large = atom("A0000", " C1  LIG A   1 ") + atom("A0001", " C2  LIG A   1 ");
  EXPECT_THAT(bonds_of("a.pdb", large + "CONECTA0000A0001\n"), ElementsAre(Pair{0, 1}));
}

TEST(Bonds, PdbModelsShareConect) {
  if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  const std::string model = "MODEL\n" + four_atoms + "ENDMDL\n";
  const std::string shared = model + model + "CONECT   11   12\nEND\n";
  for (const long frame : {0, 1}) {
    EXPECT_THAT(bonds_of("a.pdb", shared, with_bonds, frame), ElementsAre(Pair{0, 1}));
  }
  const std::string own =
      four_atoms + "CONECT   11   12\nEND\n" + four_atoms + "CONECT   11   21\nEND\n";
  EXPECT_THAT(bonds_of("a.pdb", own, with_bonds, 0), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(bonds_of("a.pdb", own, with_bonds, 1), ElementsAre(Pair{0, 2}));
}

const std::string cif_atoms =
    "data_a\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
    "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n"
    "_atom_site.label_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
    "_atom_site.auth_seq_id\n_atom_site.auth_asym_id\n"
    "1 S SG . CYS A 3 0 0 0 3 X\n2 S SG . CYS A 40 2 0 0 40 X\n3 ZN ZN . ZN B . 4 0 0 1 X\n"
    "4 C C1 A LIG C . 6 0 0 2 X\n5 C C1 B LIG C . 7 0 0 2 X\n6 N N1 A LIG C . 8 0 0 2 X\n";
const std::string cif_head =
    "loop_\n_struct_conn.id\n_struct_conn.conn_type_id\n_struct_conn.ptnr1_label_asym_id\n"
    "_struct_conn.ptnr1_label_comp_id\n_struct_conn.ptnr1_label_seq_id\n"
    "_struct_conn.ptnr1_label_atom_id\n_struct_conn.pdbx_ptnr1_label_alt_id\n"
    "_struct_conn.ptnr1_symmetry\n_struct_conn.ptnr2_label_asym_id\n"
    "_struct_conn.ptnr2_label_comp_id\n_struct_conn.ptnr2_label_seq_id\n"
    "_struct_conn.ptnr2_label_atom_id\n_struct_conn.pdbx_ptnr2_label_alt_id\n"
    "_struct_conn.ptnr2_symmetry\n_struct_conn.ptnr1_auth_asym_id\n"
    "_struct_conn.ptnr1_auth_seq_id\n_struct_conn.ptnr2_auth_asym_id\n"
    "_struct_conn.ptnr2_auth_seq_id\n";

TEST(Bonds, MmcifHasStructConn) {
  if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  const std::string rows =
      "d1 disulf A CYS 3 SG ? 1_555 A CYS 40 SG ? 1_555 X 3 X 40\n"
      "m1 metalc A CYS 3 SG ? 1_555 B ZN . ZN ? 1_555 X 3 X 1\n"
      "m2 metalc A CYS 40 SG ? 1_555 B ZN . ZN ? 3_655 X 40 X 1\n"
      "h1 hydrog A CYS 40 SG ? 1_555 B ZN . ZN ? 1_555 X 40 X 1\n"
      "c1 covale C LIG . C1 A ? C LIG . N1 A ? X 2 X 2\n"
      "c2 covale C LIG . C1 B ? C LIG . N1 A ? X 2 X 2\n";
  EXPECT_THAT(bonds_of("a.cif", cif_atoms + cif_head + rows),
              ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{3, 4}));
  EXPECT_THAT(bonds_of("a.cif", cif_atoms + cif_head + rows, {}), IsEmpty());
  const auto read = read_particles("a.cif", cif_atoms + cif_head + rows, with_bonds);
  EXPECT_THAT(read.value().notes, testing::Contains(HasSubstr("1 of its bonds left out")));
}

std::string data_file(const std::string& bonds, const std::string& count = "2 bonds\n") {
  return "title\n3 atoms\n" + count + "1 atom types\n0 9 xlo xhi\n\nAtoms # atomic\n\n7 1 0 0 0\n" +
         "3 1 1 0 0\n5 1 2 0 0\n\n" + bonds;
}

TEST(Bonds, LammpsDataHasBonds) {
  const std::string rows = "Bonds\n\n1 1 7 5 # comment\n2 cc 5 3\n";
  EXPECT_THAT(bonds_of("a.data", data_file(rows)), ElementsAre(Pair{0, 1}, Pair{1, 2}));
  EXPECT_THAT(bonds_of("a.data", data_file(rows + "\nAngles\n\n1 1 7 5 3\n")),
              ElementsAre(Pair{0, 1}, Pair{1, 2}));
  EXPECT_THAT(bonds_of("a.data", data_file(rows), {}), IsEmpty());
  EXPECT_TRUE(read_particles("a.data", data_file(rows), with_bonds).value().lists_all_bonds);
}

TEST(Bonds, WrongOnesOfLammpsHaveTheirLine) {
  EXPECT_THAT(particle_error("a.data", data_file("Bonds\n\n1 1 7 5\n2 1 5 4\n"), with_bonds),
              HasSubstr("16:1: a bond is of atom 4, which the section Atoms lacks (Bonds)"));
  EXPECT_THAT(particle_error("a.data", data_file("Bonds\n\n1 1 7 5\n"), with_bonds),
              HasSubstr("the header promises 2 rows"));
  EXPECT_THAT(particle_error("a.data", data_file("Bonds\n\n1 1 7 5\n2 1 5\n"), with_bonds),
              HasSubstr("16:"));
  EXPECT_EQ(particle_error("a.data", data_file("Bonds\n\n1 1 7 5\n2 1 5 4\n")), "no error");
}

}  // namespace
}  // namespace boule
