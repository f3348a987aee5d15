#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/files/particle_file/read_text.h"

// PQR: molecules with charges and radii.

namespace boule::pqr {
namespace {

using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string guessed = "the elements are guessed from the names of atoms and residues";

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

std::vector<std::string> texts_of(const TextColumn& column) {
  std::vector<std::string> found;
  for (const std::uint32_t index : column.indices) found.push_back(column.texts[index]);
  return found;
}

const std::string nitrogen =
    "ATOM      1  N   ALA A   1       0.000   0.000   0.000  0.1414 1.8240\n";

TEST(Pqr, ReadsColumnsThatRunTogether) {
  const auto read = read_particles(
      "a.pqr",
      "REMARK   1 PQR\n" + nitrogen +
          "ATOM      4  O   ALA A   1       1.300   2.400-100.000 -0.5722 1.6612\n"
          "ATOM  10005  HG11VAL A1002    -101.300-102.400-100.000-10.5722 1.6612\n"
          "HETATM10006 CL   CL  A1003    -101.300-102.400-100.000-10.5722 1.6612\r\nTER\nEND\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  ASSERT_EQ(frame.size(), 4U);
  EXPECT_EQ(frame.positions[1], (Vec3d{1.3, 2.4, -100}));
  EXPECT_EQ(frame.positions[2], (Vec3d{-101.3, -102.4, -100}));
  EXPECT_THAT(numbers(frame, "radius"), ElementsAre(1.824, 1.6612, 1.6612, 1.6612));
  EXPECT_THAT(numbers(frame, "charge"), ElementsAre(0.1414, -0.5722, -10.5722, -10.5722));
  EXPECT_THAT(numbers(frame, "id"), ElementsAre(1, 4, 10005, 10006));
  EXPECT_THAT(numbers(frame, "resid"), ElementsAre(1, 1, 1002, 1003));
  EXPECT_THAT(texts_of(*frame.species), ElementsAre("N", "O", "H", "Cl"));
  EXPECT_THAT(texts_of(*find_text_column(frame, "chain")), ElementsAre("A", "A", "A", "A"));
  EXPECT_THAT(frame.notes, ElementsAre(guessed));
}

TEST(Pqr, ReadsWordsBetweenBlanks) {
  const auto read = read_particles("a.pqr",
                                   "ATOM 1 N ALA 1 1.5 -2 3e1 0.1414 1.8240\n"
                                   "ATOM  2  CA  ALA  B  12  1.5   -2.25   3   -1   1.9080\n"
                                   "ATOM\t3 SOD SOD C1000 1.5 -2.25 3 1.0 1.41\n"
                                   "HETATM 4 O1 LIG 52A 1.12345678 -2.25 3 1.0 1.41\n");
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  ASSERT_EQ(frame.size(), 4U);
  EXPECT_EQ(frame.positions[0], (Vec3d{1.5, -2, 30}));
  EXPECT_EQ(frame.positions[3].x, 1.12345678);
  EXPECT_THAT(numbers(frame, "radius"), ElementsAre(1.824, 1.908, 1.41, 1.41));
  EXPECT_THAT(numbers(frame, "resid"), ElementsAre(1, 12, 1000, 52));
  EXPECT_THAT(texts_of(*find_text_column(frame, "chain")), ElementsAre("", "B", "C", ""));
  EXPECT_THAT(texts_of(*find_text_column(frame, "resname")),
              ElementsAre("ALA", "ALA", "SOD", "LIG"));
  EXPECT_THAT(texts_of(*frame.species), ElementsAre("N", "C", "Na", "O"));
}

TEST(Pqr, AtomsWithoutSizeAreOmittedWithRadii) {
  const std::string text = nitrogen + "ATOM 2 HO ALA 1 1 2 3 0.4 0.0000\n";
  const auto all = read_particles("a.pqr", text);
  ASSERT_TRUE(all.ok()) << format_diagnostic(all.error());
  EXPECT_EQ(all.value().size(), 1U);
  EXPECT_THAT(all.value().notes,
              ElementsAre(guessed, "1 atom of radius 0 left out: the file gives them no size"));
  ParticleFileOptions options;
  options.wanted = std::vector<std::string>{"charge"};
  EXPECT_EQ(read_particles("a.pqr", text, options).value().size(), 2U);
}

TEST(Pqr, HasModels) {
  const std::string model = "MODEL 1\n" + nitrogen + "ENDMDL\n";
  EXPECT_TRUE(read_particles("a.pqr.gz", model + model, {}, 1).ok());
}

TEST(Pqr, WrongRecordsAreRefusedWithTheirPlace) {
  EXPECT_EQ(particle_error("a.pqr", "REMARK\n"),
            "0:0: it holds no atoms: no record begins with ATOM or HETATM ()");
  EXPECT_EQ(particle_error("a.pqr", "ATOM 1 N ALA 1 1.5 -2 x 0.1414 1.8240\n"),
            "1:23: expected a number, found 'x' (z)");
  EXPECT_THAT(particle_error("a.pqr", nitrogen + "ATOM 1 N ALA 1 1.5 -2 nan 0.1414 1.8240\n"),
              HasSubstr("2:23: expected a finite number, found 'nan' (z)"));
  EXPECT_THAT(particle_error("a.pqr", "ATOM 1 N ALA 1 1.5 -2 3 0.1414 inf\n"),
              HasSubstr("expected a finite number, found 'inf' (radius)"));
  EXPECT_THAT(particle_error("a.pqr", nitrogen.substr(0, 62) + "\n"),
              HasSubstr("the record has no number for 'radius' (radius)"));
  EXPECT_THAT(particle_error("a.pqr", "ATOM\n"), HasSubstr("has no number for 'x' (x)"));
}

}  // namespace
}  // namespace boule::pqr
