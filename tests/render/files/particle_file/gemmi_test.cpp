#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "tests/render/files/particle_file/read_text.h"

// PDB and CIF files, which gemmi reads.

namespace boule::gemmi {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

std::vector<std::string> texts_of(const TextColumn& column) {
  std::vector<std::string> found;
  for (const std::uint32_t index : column.indices) found.push_back(column.texts[index]);
  return found;
}

std::vector<std::string> texts(const ParticleFrame& frame, const std::string& name) {
  const TextColumn* const column = find_text_column(frame, name);
  return column == nullptr ? std::vector<std::string>() : texts_of(*column);
}

/// A record of an atom: the line's columns 13 to 27 name it.
std::string record(const std::string& names, const std::string& x = "   1.250",
                   const std::string& kind = "ATOM  ", const std::string& id = "    7",
                   const std::string& end = "  0.35 12.34           C  \n") {
  return kind + id + " " + names + "   " + x + "  -2.500   3.125" + end;
}

const std::string alpha = " CA  ALA A  12 ";
const std::string water = " O   HOH A 101 ";
const std::string crystal =
    "CRYST1   10.000   20.000   30.000  90.00  90.00  90.00 P 1           1\n";

class WithGemmi : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  }
};
class Pdb : public WithGemmi {};
class Mmcif : public WithGemmi {};

TEST(Gemmi, BuildsWithoutItRefuseItsFormats) {
  if (has_gemmi()) GTEST_SKIP() << "built with gemmi";
  EXPECT_THAT(particle_error("a.cif", "data_a\n"), HasSubstr("lacks gemmi"));
  EXPECT_THAT(particle_error("a.pdb", record(alpha)), HasSubstr("lacks gemmi"));
}

TEST_F(Pdb, ReadsAtoms) {
  const auto read = read_particles("a.pdb", "HEADER\n" + crystal + record(alpha) +
                                                record("ZN    ZN B1000A", "-100.001", "HETATM",
                                                       "A0000", "  1.00  0.10          ZN2+\r\n") +
                                                record(water) + "CONECT    1    2\nEND\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  ASSERT_EQ(frame.size(), 2U);
  EXPECT_EQ(frame.positions[0].x, 1.25);
  EXPECT_EQ(frame.positions[1].x, -100.001);
  EXPECT_THAT(texts_of(*frame.species), ElementsAre("C", "Zn"));
  EXPECT_THAT(texts(frame, "name"), ElementsAre("CA", "ZN"));
  EXPECT_THAT(texts(frame, "resname"), ElementsAre("ALA", "ZN"));
  EXPECT_THAT(texts(frame, "chain"), ElementsAre("A", "B"));
  EXPECT_THAT(numbers(frame, "id"), ElementsAre(7, 100000));
  EXPECT_THAT(numbers(frame, "resid"), ElementsAre(12, 1000));
  EXPECT_THAT(numbers(frame, "occupancy"), ElementsAre(0.35, 1));
  EXPECT_THAT(numbers(frame, "bfactor"), ElementsAre(12.34, 0.1));
  EXPECT_THAT(frame.notes, ElementsAre("1 atom of water left out"));
  ASSERT_TRUE(frame.cell.has_value());
  EXPECT_EQ(frame.cell->b.y, 20);
  EXPECT_THAT(frame.cell->periodic, ElementsAre(true, true, true));
  EXPECT_FALSE(frame.axes_matter);
  EXPECT_EQ(frame.length_in_angstrom, 1);
}

TEST_F(Pdb, KeepsWaterOnRequest) {
  ParticleFileOptions options;
  options.water = true;
  const auto read = read_particles("a.ent", record(alpha) + record(water), options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().size(), 2U);
  EXPECT_TRUE(read.value().notes.empty());
  const auto only = read_particles("a.ent", record(water) + record(water));
  ASSERT_TRUE(only.ok()) << format_diagnostic(only.error());
  EXPECT_EQ(only.value().size(), 2U);  // there is nothing else
}

TEST_F(Pdb, TakesTheFirstAlternativeLocation) {
  const auto read = read_particles(
      "a.pdb", record(" N   SER A   1 ") + record(" CA BSER A   1 ", "   2.000") +
                   record(" CA ASER A   1 ", "   3.000") + record(" CG AVAL A   1 ", "   4.000") +
                   record(" CA BSER A   2 ", "   5.000") + record(" CA  SER A   2 ", "   6.000"));
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  std::vector<double> xs;
  for (const Vec3d& p : read.value().positions) xs.push_back(p.x);
  EXPECT_THAT(xs, ElementsAre(1.25, 2, 5, 6));
  EXPECT_THAT(read.value().notes, ElementsAre("2 atoms left out: other alternative locations"));
}

TEST_F(Pdb, ModelsAndEndsPartFrames) {
  const std::string file = crystal + "MODEL        1\n" + record(alpha) + "TER\nENDMDL\n" +
                           "MODEL        2\nENDMDL\nMODEL        3\n" + record(alpha, "   2.000") +
                           "ENDMDL\nCRYST1   11.000   20.000   30.000  90.00  90.00  90.00\n" +
                           record(alpha, "   3.000") + record(alpha) + "END\n";
  std::vector<std::pair<std::size_t, double>> found;
  for (const long frame : {0, 1, 2}) {
    const auto read = read_particles("a.pdb", file, {}, frame);
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    found.emplace_back(read.value().size(), read.value().cell->a.x);
  }
  EXPECT_THAT(found, ElementsAre(std::pair(1, 10), std::pair(1, 10), std::pair(2, 11)));
  EXPECT_THAT(particle_error("a.pdb", file, {}, 3), HasSubstr("it has 3 frames"));
}

TEST_F(Pdb, ReadsSloppyLines) {
  // No occupancy, no element; old files' numbers of lines; letters that are none.
  const auto read = read_particles(
      "a.pdb", record("1HB  ALA A  12 ", "   1.250", "ATOM  ", "*****", "\n") +
                   record(alpha, "   1.250", "HETATM", "    2", "  1.00 13.79      1CRNF  70\n") +
                   record("\x01\xff   \xc3\xa4\x80 A  12 ", "   1.250", "atom  "));
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(texts_of(*read.value().species), ElementsAre("H", "C", "C"));
  EXPECT_THAT(numbers(read.value(), "occupancy"), ElementsAre(1, 1, 0.35));
  EXPECT_THAT(numbers(read.value(), "bfactor"), ElementsAre(0, 13.79, 12.34));
  EXPECT_FALSE(read.value().cell.has_value());
}

TEST_F(Pdb, GuessesElementsWhereNamesAreNotAligned) {
  const auto species = [](const char* first) {
    std::string file = record(first, "   1.000", "ATOM  ", "    1", "  1.00  0.00\n");
    for (const char* atom : {"CA   TYR     1 ", "HE1  TYR     1 ", "OH   TYR     1 "}) {
      file += record(atom, "   1.000", "ATOM  ", "    1", "  1.00  0.00\n");
    }
    return texts_of(*read_particles("a.pdb", file).value().species);
  };
  EXPECT_THAT(species("N    TYR     1 "), ElementsAre("N", "C", "H", "O"));
  EXPECT_THAT(species(" N   TYR     1 "), ElementsAre("N", "C", "H", "O"));  // by the residue
}

TEST_F(Pdb, NumbersAreTheNearestDoubles) {
  const auto read = read_particles(
      "a.pdb", record(alpha, " 1.1e-05", "ATOM  ", "    1", "  1e99 1e-30           C\n"));
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_EQ(read.value().positions[0].x, 1.1e-05);
  EXPECT_THAT(numbers(read.value(), "occupancy"), ElementsAre(1e99));  // more than a float holds
  EXPECT_THAT(numbers(read.value(), "bfactor"), ElementsAre(1e-30));
}

TEST_F(Pdb, KeepsWantedColumnsOnly) {
  ParticleFileOptions options;
  options.wanted = std::vector<std::string>{"chain"};
  const auto read = read_particles(
      "a.pdb", record(alpha, "   1.250", "ATOM  ", "    1", "  nan ******\n"), options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_TRUE(read.value().numbers.empty());
  ASSERT_EQ(read.value().texts.size(), 1U);
  EXPECT_EQ(read.value().texts[0].name, "chain");
}

TEST_F(Pdb, ReadsCrambin) {
  for (const char* name : {"1crn.pdb", "1crn.cif"}) {
    auto file = ParticleFile::open(std::string(BOULE_TEST_DATA "/") + name);
    ASSERT_TRUE(file.ok()) << format_diagnostic(file.error());
    const auto read = file.value().read();
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    const ParticleFrame& frame = read.value();
    EXPECT_EQ(frame.size(), 327U);
    EXPECT_EQ(frame.positions[0].x, 17.047);
    EXPECT_EQ(frame.positions[326].z, 10.746);
    EXPECT_THAT(frame.species->texts, ElementsAre("N", "C", "O", "S"));
    EXPECT_EQ(numbers(frame, "resid").back(), 46);
    EXPECT_EQ(numbers(frame, "bfactor").front(), 13.79);
    // SCALE, whose axes are unlike those of CRYST1, has five digits.
    EXPECT_NEAR(frame.cell->b.y, 18.65, 2e-4);
    EXPECT_GT(frame.cell->c.x, 0);
  }
}

/// A table of atoms; the rows have so many values.
const std::string head =
    "data_x\nloop_\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
    "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n"
    "_atom_site.auth_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
    "_atom_site.occupancy\n_atom_site.B_iso_or_equiv\n_atom_site.pdbx_PDB_model_num\n";
const std::string cif_cell =
    "_cell.length_a 10\n_cell.length_b 20\n_cell.length_c 30\n_cell.angle_alpha 90\n"
    "_cell.angle_beta 90\n_cell.angle_gamma 90\n";

TEST_F(Mmcif, ReadsModels) {
  const std::string file = head +
                           "1 C CA A ALA B 12 1.25 -2.5 +3.125 0.35 12.34 1\n"
                           "2 C CA B ALA B 12 9 9 9 0.65 12.34 1\n"
                           "3 ZN ZN . ZN C . 4 5 6 ? . 1\n4 O O . HOH C 1 4 5 6 1 1 1\n"
                           "x . \"O5'\" . 'D G' D 7 7 8 1e1 1 2 2\n" +
                           cif_cell;
  for (const char* name : {"a.cif", "a.mmcif", "a"}) {
    const auto read = read_particles(name, file, {}, 0);
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    const ParticleFrame& frame = read.value();
    ASSERT_EQ(frame.size(), 2U);
    EXPECT_EQ(frame.positions[0].z, 3.125);
    EXPECT_THAT(texts_of(*frame.species), ElementsAre("C", "Zn"));
    EXPECT_THAT(texts(frame, "chain"), ElementsAre("B", "C"));
    EXPECT_THAT(numbers(frame, "resid"), ElementsAre(12, 0));
    EXPECT_THAT(numbers(frame, "occupancy"), ElementsAre(0.35, 1));
    EXPECT_THAT(numbers(frame, "bfactor"), ElementsAre(12.34, 0));
    EXPECT_EQ(frame.notes.size(), 2U);
    EXPECT_EQ(frame.cell->c.z, 30);
    EXPECT_FALSE(frame.axes_matter);
  }
  const auto last = read_particles("a.cif", file);
  ASSERT_TRUE(last.ok()) << format_diagnostic(last.error());
  EXPECT_EQ(last.value().positions[0].z, 10);
  EXPECT_THAT(texts(last.value(), "name"), ElementsAre("O5'"));
  EXPECT_THAT(texts(last.value(), "resname"), ElementsAre("D G"));
  EXPECT_THAT(texts_of(*last.value().species), ElementsAre("O"));
  EXPECT_THAT(numbers(last.value(), "id"), ElementsAre(5));
}

const std::string site_head =
    "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
    "_atom_site_disorder_group\n";
const std::string site_cell =
    "data_x\n_cell_length_a 10\n_cell_length_b 20(3)\n_cell_length_c 30\n_cell_angle_alpha 90\n"
    "_cell_angle_beta 90\n_cell_angle_gamma 90\n_symmetry_space_group_name_H-M 'P 1'\n";

TEST_F(Mmcif, ReadsSmallMolecules) {
  const auto read =
      read_particles("a.cif", "data_global\n" + site_cell + site_head +
                                  "Fe1 0.25(3) 0.5 -1 .\nC2A 0 0 0.5 1\nC2B 0 0 0.5 2\nQ1 0 0 0 .");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  ASSERT_EQ(frame.size(), 3U);
  EXPECT_EQ(frame.positions[0].x, 2.5);
  EXPECT_EQ(frame.positions[0].y, 10);
  EXPECT_EQ(frame.positions[0].z, -30);
  EXPECT_THAT(texts_of(*frame.species), ElementsAre("Fe", "C", "X"));
  EXPECT_THAT(texts(frame, "name"), ElementsAre("Fe1", "C2A", "Q1"));
  EXPECT_EQ(find_text_column(frame, "chain"), nullptr);
  EXPECT_THAT(frame.notes, ElementsAre("1 atom left out: other alternative locations"));
  EXPECT_EQ(frame.cell->b.y, 20);
  EXPECT_TRUE(frame.axes_matter);
}

struct Broken {
  std::string name, text, error;
};

/// In place of its bytes, which hold addresses.
void PrintTo(const Broken& file, std::ostream* out) { *out << file.name << ": " << file.error; }

class GemmiBroken : public WithGemmi, public testing::WithParamInterface<Broken> {};

TEST_P(GemmiBroken, IsRefused) {
  EXPECT_EQ(particle_error(GetParam().name, GetParam().text), GetParam().error);
}

std::string pdb_line(std::string text, std::size_t column, const std::string& put) {
  text.replace(column - 1, put.size(), put);
  return text;
}
Broken pdb(const std::string& text, const std::string& error) { return {"a.pdb", text, error}; }
/// The second line has `put` at a column.
Broken pdb(std::size_t column, const std::string& put, const std::string& error) {
  return {"a.pdb", record(alpha) + pdb_line(record(alpha), column, put), error};
}
Broken crystal_with(std::size_t column, const std::string& put, const std::string& error) {
  return {"a.pdb", record(alpha) + pdb_line(crystal, column, put), error};
}
Broken cif(const std::string& text, const std::string& error) { return {"a.cif", text, error}; }
/// A second row of atoms.
Broken row(const std::string& second, const std::string& error) {
  return {"a.cif", head + "1 C CA A ALA B 12 1 2 3 1 1 1\n" + second + "\n", error};
}

const std::string no_atoms = "0:0: it holds no atoms: no record begins with ATOM or HETATM ()";
const std::string no_positions =
    "0:0: it holds no positions of atoms: _atom_site.Cartn_x, _atom_site_fract_x ()";

INSTANTIATE_TEST_SUITE_P(
    Pdb, GemmiBroken,
    testing::Values(
        pdb("", no_atoms), pdb("\n\n", no_atoms), pdb("HEADER\nEND\n", no_atoms),
        pdb("data_x\n", no_atoms), pdb("MODEL        1\nENDMDL\n", no_atoms),
        pdb("ATOM\n", "1:5: expected a number in columns 31 to 38, found none (x)"),
        pdb("ATOM  ", "1:7: expected a number in columns 31 to 38, found none (x)"),
        pdb("HETATM    1  CA  ALA A  12       1.250\n",
            "1:39: expected a number in columns 39 to 46, found none (y)"),
        pdb(record(alpha).substr(0, 46) + "\n",
            "1:47: expected a number in columns 47 to 54, found none (z)"),
        pdb("x\r\n" + record(alpha).substr(0, 40) + "\r\n",
            "2:39: expected a number in columns 39 to 46, found none (y)"),
        pdb(31, "        ", "2:31: expected a number in columns 31 to 38, found none (x)"),
        pdb(31, "     nan", "2:36: expected a finite number, found 'nan' (x)"),
        pdb(39, "     inf", "2:44: expected a finite number, found 'inf' (y)"),
        pdb(39, "    -inf", "2:43: expected a finite number, found '-inf' (y)"),
        pdb(47, "   1e999", "2:50: expected a finite number, found '1e999' (z)"),
        pdb(47, "   1.d-3", "2:50: expected a number, found '1.d-3' (z)"),
        pdb(31, " 1.2 3.4", "2:32: expected a number, found '1.2 3.4' (x)"),
        pdb(31, "********", "2:31: expected a number, found '********' (x)"),
        pdb(31, "  0x1.8p", "2:33: expected a number, found '0x1.8p' (x)"),
        pdb(31, "    1,25", "2:35: expected a number, found '1,25' (x)"),
        pdb(30, "1.25", "2:31: expected a number, found '.251.250' (x)"),
        pdb(39, "\t\t\t\t\t\t\t\t", "2:39: expected a number in columns 39 to 46, found none (y)"),
        pdb(55, " abcd ", "2:56: expected a number, found 'abcd' (occupancy)"),
        pdb(55, "   inf", "2:58: expected a finite number, found 'inf' (occupancy)"),
        pdb(61, "******", "2:61: expected a number, found '******' (bfactor)"),
        pdb(61, " 1e999", "2:62: expected a finite number, found '1e999' (bfactor)"),
        crystal_with(7, "      abc", "2:13: expected a number, found 'abc' (CRYST1.a)"),
        crystal_with(7, "         ",
                     "2:7: expected a number in columns 7 to 15, found none (CRYST1.a)"),
        crystal_with(16, "      nan", "2:22: expected a finite number, found 'nan' (CRYST1.b)"),
        crystal_with(34, "  0.00", "2:1: Impossible angle - N*180deg. (CRYST1)"),
        crystal_with(34, "  10.00 170.00  10.00",
                     "2:1: there is no cell with these edges and angles (CRYST1)"),
        crystal_with(48, "1e9999",
                     "2:48: expected a finite number, found '1e99990' (CRYST1.gamma)"),
        crystal_with(7, "    0.000",
                     "2:1: there is no cell with these edges and angles (CRYST1)")));

INSTANTIATE_TEST_SUITE_P(
    Mmcif, GemmiBroken,
    testing::Values(
        cif("", no_positions), cif("x\n", "1:1: gemmi says: expected block header (data_) ()"),
        cif("data_x\n", no_positions), cif("data_x\nloop_\n", "3:1: gemmi says: parse error ()"),
        cif("data_x\nloop_\n_a\n_b\n1\n", "2:1: gemmi says: Wrong number of values in the loop ()"),
        cif("data_x\n_a\n_b 1\n", "2:0: gemmi says: in data_x: _a has no value ()"),
        cif("data_x\n_a 'open\n", "2:9: gemmi says: unterminated 'string' ()"),
        cif("data_x\n_a \"open\n", "2:9: gemmi says: unterminated \"string\" ()"),
        cif("data_x\n_a\n;open\n", "4:1: gemmi says: unterminated text field ()"),
        cif("data_x\n_a 1\n_a 2\n", "3:0: gemmi says: in data_x: duplicate tag _a ()"),
        cif("data_x\n_a 1\ndata_x\n_b 1\n", "0:0: gemmi says: duplicate block name: x ()"),
        cif("data_x\n_a 1 2\n", "2:6: gemmi says: parse error ()"),
        cif("data_x\n\x01 1\n", "2:1: gemmi says: parse error ()"),
        cif("data_x\nglobal_\n", no_positions), cif(head, no_positions),
        cif(head + "1 C CA\n", "2:1: gemmi says: Wrong number of values in the loop ()"),
        cif("data_x\nloop_\n_atom_site.Cartn_x\n1\n2\n", no_positions),
        row("2 C CA A ALA B 12 nan 2 3 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found 'nan' (x)"),
        row("2 C CA A ALA B 12 1 ? 3 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found '?' (y)"),
        row("2 C CA A ALA B 12 1 2 . 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found '.' (z)"),
        row("2 C CA A ALA B 12 1 inf 3 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found 'inf' (y)"),
        row("2 C CA A ALA B 12 1 1e999 3 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found '1e999' (y)"),
        row("2 C CA A ALA B 12 1 2x 3 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found '2x' (y)"),
        row("2 C CA A ALA B 12 1 '2' 3 1 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found ''2'' (y)"),
        row("2 C CA A ALA B 12 1 2 3 much 1 1",
            "2:0: expected a finite number in row 2 of the atoms, found 'much' (occupancy)"),
        row("2 C CA A ALA B 12 1 2 3 1 1e999 1",
            "2:0: expected a finite number in row 2 of the atoms, found '1e999' (bfactor)"),
        row("2 C CA A ALA B 12 1 2 3 1 1",
            "2:1: gemmi says: Wrong number of values in the loop ()"),
        row("_cell.length_a x\n_cell.length_b 1\n_cell.length_c 2\n_cell.angle_alpha "
            "90\n_cell.angle_beta 90\n_cell.angle_gamma 90",
            "0:0: expected a finite number, found 'x' (cell)"),
        row("_cell.length_a 5\n_cell.length_b 1\n_cell.length_c 2\n_cell.angle_alpha "
            "180\n_cell.angle_beta 90\n_cell.angle_gamma 90",
            "0:0: there is no cell with these edges and angles (cell)"),
        row("_cell.length_a 5\n_cell.length_b 1\n_cell.length_c 2\n_cell.angle_alpha "
            "10\n_cell.angle_beta 170\n_cell.angle_gamma 10",
            "0:0: there is no cell with these edges and angles (cell)"),
        row("_cell.length_a 0\n_cell.length_b 1\n_cell.length_c 2\n_cell.angle_alpha "
            "90\n_cell.angle_beta 90\n_cell.angle_gamma 90",
            "0:0: there is no cell with these edges and angles (cell)"),
        cif("data_x\n" + site_head + "C1 0 0 0 1\n",
            "2:0: its positions are fractions of a cell, which it does not have ()"),
        cif(site_cell + site_head + "C1 0 0 x 1\n",
            "9:0: expected a finite number in row 1 of the atoms, found 'x' (z)"),
        cif(site_cell + site_head + "C1 0 ? 0 1\n",
            "9:0: expected a finite number in row 1 of the atoms, found '?' (y)"),
        cif(site_cell + site_head + "C1 0 0(x) 0 1\n",
            "9:0: expected a finite number in row 1 of the atoms, found '0(x)' (y)")));

}  // namespace
}  // namespace boule::gemmi
