#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "tests/render/files/particle_file/read_text.h"

// The cell of a crystal, from its asymmetric unit.

namespace boule::symmetry {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::string cell(const std::string& a, const std::string& c, const std::string& gamma) {
  return "data_x\n_cell_length_a " + a + "\n_cell_length_b " + a + "\n_cell_length_c " + c +
         "\n_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma " + gamma + "\n";
}

const std::string cubic = cell("5.6402(2)", "5.6402(2)", "90");
const std::string head =
    "loop_\n_atom_site_label\n_atom_site_type_symbol\n_atom_site_fract_x\n_atom_site_fract_y\n"
    "_atom_site_fract_z\n";
const std::string salt = head + "Na1 Na1+ 0 0 0\nCl1 Cl1- 0.5 0.5 0.5\n";

class Symmetry : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  }

  static ParticleFrame read(const std::string& text) {
    auto frame = read_particles("a.cif", text);
    EXPECT_TRUE(frame.ok()) << text << format_diagnostic(frame.error());
    return frame ? std::move(frame).value() : ParticleFrame{};
  }

  /// How many atoms of each element there are.
  static std::map<std::string, int> counts(const ParticleFrame& frame) {
    std::map<std::string, int> found;
    for (const std::uint32_t i : frame.species->indices) ++found[frame.species->texts[i]];
    return found;
  }
};

using Counts = std::map<std::string, int>;

TEST_F(Symmetry, GroupsMatchByNameNumberOrHall) {
  for (const std::string group :
       {"_symmetry_space_group_name_H-M 'F m -3 m'\n", "_space_group_name_H-M_alt Fm-3m\n",
        "_space_group_name_H-M_alt 'F m 3 m'\n", "_symmetry_space_group_name_H-M F_m_-3_m\n",
        "_symmetry_Int_Tables_number 225\n", "_space_group_IT_number 225\n",
        "_space_group_name_Hall '-F 4 2 3'\n",
        "_symmetry_space_group_name_H-M ?\n_symmetry_Int_Tables_number 225\n",
        "_symmetry_space_group_name_H-M 'no such'\n_symmetry_Int_Tables_number 225\n"}) {
    const ParticleFrame frame = read(cubic + group + salt);
    EXPECT_EQ(counts(frame), (Counts{{"Na", 4}, {"Cl", 4}})) << group;
    ASSERT_EQ(frame.notes.size(), 1U);
    EXPECT_THAT(frame.notes[0], HasSubstr("the 8 atoms of the cell are made of 2 by the symmetry"));
    for (const Vec3d& p : frame.positions) {
      for (const double x : {p.x, p.y, p.z}) {
        EXPECT_GE(x, 0);
        EXPECT_LT(x, 5.64);
      }
    }
  }
}

TEST_F(Symmetry, OperationsOfTheFileComeFirst) {
  const std::string loop =
      "loop_\n_symmetry_equiv_pos_as_xyz\n'-x, y+1/2, -z'\n'x, y, z'\nx+0.5,y,z\n";
  const std::string group = "_symmetry_space_group_name_H-M 'F m -3 m'\n";
  const ParticleFrame frame = read(cubic + group + loop + head + "C1 C 0.1 0.2 0.3\n");
  ASSERT_EQ(frame.size(), 3U);
  EXPECT_NEAR(frame.positions[0].x, 0.1 * 5.6402, 1e-12);  // the atom of the file
  EXPECT_NEAR(frame.positions[1].x, 0.9 * 5.6402, 1e-12);
  EXPECT_NEAR(frame.positions[1].y, 0.7 * 5.6402, 1e-12);
  EXPECT_NEAR(frame.positions[2].x, 0.6 * 5.6402, 1e-12);
  EXPECT_THAT(find_number_column(frame, "id")->values, ElementsAre(1, 1, 1));
  // The same with an index, and the newer tag.
  const std::string numbered =
      "loop_\n_space_group_symop_id\n_space_group_symop_operation_xyz\n1 x,y,z\n2 -x,-y,-z\n";
  EXPECT_EQ(read(cubic + numbered + salt).size(), 2U);  // both are on special places
  EXPECT_EQ(read(cubic + numbered + head + "C1 C 0.1 0.2 0.3\n").size(), 2U);
  EXPECT_EQ(particle_error("a.cif", cubic + "_symmetry_equiv_pos_as_xyz 'x,y'\n" + salt),
            "0:0: the operation 'x,y' cannot be read (symmetry)");
  EXPECT_EQ(
      particle_error("a.cif", cubic + "_symmetry_equiv_pos_as_xyz x+999999999/2,y,z\n" + salt),
      "0:0: the operation 'x+999999999/2,y,z' cannot be read (symmetry)");
  std::string many = "loop_\n_symmetry_equiv_pos_as_xyz\n";
  for (int i = 0; i < 2000; ++i) many += "-x,-y,-z\n";
  EXPECT_EQ(particle_error("a.cif", cubic + many + salt),
            "0:0: it has more than 1024 operations (symmetry)");
}

TEST_F(Symmetry, SpecialPlacesAreTakenOnce) {
  // Rutile: titanium at the corner and the middle, oxygen on a diagonal.
  const ParticleFrame rutile =
      read(cell("4.594", "2.959", "90") + "_space_group_name_H-M_alt 'P 42/m n m'\n" + head +
           "Ti Ti 0 0 0\nO O 0.3053 0.3053 0\n");
  EXPECT_EQ(counts(rutile), (Counts{{"Ti", 2}, {"O", 4}}));
  // Thirds as decimals: graphite, whose places differ by rounding.
  const ParticleFrame graphite =
      read(cell("2.461", "6.708", "120") + "_space_group_IT_number 194\n" + head +
           "C1 C 0 0 0.25\nC2 C 0.3333 0.6667 0.25\n");
  EXPECT_EQ(counts(graphite), (Counts{{"C", 4}}));
  // Diamond, by the choice of the origin that ICSD writes as a letter.
  const std::string diamond = cell("3.567", "3.567", "90") + "_space_group_name_H-M_alt 'F d -3 m ";
  EXPECT_EQ(read(diamond + "S'\n" + head + "C1 C 0 0 0\n").size(), 8U);
  EXPECT_EQ(read(diamond + ":2'\n" + head + "C1 C 0.125 0.125 0.125\n").size(), 8U);
}

TEST_F(Symmetry, RhombohedralGroupsGoByTheirAngles) {
  const std::string group = "_symmetry_space_group_name_H-M 'R -3 m'\n";
  const std::string bismuth = head + "Bi Bi 0 0 0.234\n";
  EXPECT_EQ(read(cell("4.546", "11.862", "120") + group + bismuth).size(), 6U);
  const std::string rhombic =
      "data_x\n_cell_length_a 4.7\n_cell_length_b 4.7\n_cell_length_c 4.7\n_cell_angle_alpha 57\n"
      "_cell_angle_beta 57\n_cell_angle_gamma 57\n";
  EXPECT_EQ(read(rhombic + group + head + "Bi Bi 0.234 0.234 0.234\n").size(), 2U);
}

TEST_F(Symmetry, WithoutSymmetryPlacesStay) {
  const std::string atom = head + "C1 C -0.5 1.5 0\n";
  for (const std::string group :
       {"", "_symmetry_space_group_name_H-M 'P 1'\n", "_space_group_IT_number 1\n",
        "_symmetry_equiv_pos_as_xyz 'x,y,z'\n", "_symmetry_space_group_name_H-M ?\n"}) {
    const ParticleFrame frame = read(cubic + group + atom);
    ASSERT_EQ(frame.size(), 1U) << group;
    EXPECT_EQ(frame.positions[0].x, -0.5 * 5.6402) << group;
    EXPECT_TRUE(frame.notes.empty()) << group;
  }
  const ParticleFrame unknown = read(cubic + "_symmetry_space_group_name_H-M 'Z 7'\n" + atom);
  EXPECT_THAT(unknown.notes,
              ElementsAre("only the asymmetric unit is read: the space group 'Z 7' is unknown"));
}

}  // namespace
}  // namespace boule::symmetry
