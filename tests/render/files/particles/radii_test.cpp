#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "render/files/particles/elements.h"
#include "tests/render/files/particles/particle_frames.h"

namespace boule {
namespace {

using test::error_of;
using test::notes_of;
using test::row_of;
using test::row_of_particles;
using test::spheres_of;
using test::text_column;
using testing::HasSubstr;

std::vector<float> radii_of(const ParticleFrame& frame, const ParticleStyle& style = {}) {
  std::vector<float> radii;
  for (const Sphere& sphere : spheres_of(frame, style)) radii.push_back(sphere.radius);
  return radii;
}

std::string source_of(const ParticleFrame& frame, const ParticleStyle& style = {}) {
  const auto made = ParticleSpheres::make(frame, style);
  return made ? made.value().radius_source() : made.error().message;
}

using Radii = std::vector<float>;

TEST(Radii, AreTheSameForAll) {
  EXPECT_EQ(radii_of(row_of_particles(2), {.radius = 0.3}), (Radii{0.3F, 0.3F}));
  EXPECT_EQ(radii_of(row_of_particles(2), {.radius = 0.3, .scale = 2}), (Radii{0.6F, 0.6F}));
  EXPECT_EQ(source_of(row_of_particles(2), {.radius = 0.3}), "the same for all");
}

TEST(Radii, AreThoseOfTheColumnByDefault) {
  ParticleFrame frame = row_of({"C", "O"});
  frame.numbers = {{"diameter", {3, 5}}, {"radius", {1, 2}}, {"r", {7, 8}}};
  EXPECT_EQ(radii_of(frame), (Radii{1, 2}));
  EXPECT_EQ(source_of(frame), "the column radius");
  EXPECT_EQ(radii_of(frame, {.radius = RadiusColumn{"r"}, .scale = 0.5}), (Radii{3.5F, 4}));
  EXPECT_EQ(radii_of(frame, {.radius = RadiusColumn{"diameter"}}), (Radii{3, 5}));
  EXPECT_THAT(notes_of(frame, {.radius = RadiusColumn{"diameter"}}), HasSubstr("taken as radii"));
  frame.numbers.pop_back();
  frame.numbers.pop_back();
  EXPECT_EQ(radii_of(frame), (Radii{1.5F, 2.5F}));
  EXPECT_EQ(source_of(frame), "half of the column diameter");
}

TEST(Radii, AreVanDerWaalsOfElements) {
  ParticleFrame frame = row_of({"C", "h", "FE"});
  EXPECT_EQ(radii_of(frame), (Radii{1.77F, 1.2F, 2.44F}));
  EXPECT_EQ(source_of(frame), "van der Waals radii, in angstrom");
  EXPECT_THAT(notes_of(frame), HasSubstr("the radii are van der Waals radii"));
  EXPECT_EQ(radii_of(frame, {.radius = RadiusTable::covalent}), (Radii{0.76F, 0.31F, 1.32F}));
  frame.length_in_angstrom = 10;
  EXPECT_EQ(radii_of(frame), (Radii{0.177F, 0.12F, 0.244F}));
  EXPECT_EQ(source_of(frame), "van der Waals radii, in nm");
}

ParticleFrame periodic(const std::vector<std::string>& species) {
  ParticleFrame frame = row_of(species);
  frame.cell = ParticleCell{{9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {}, {true, true, true}};
  return frame;
}

TEST(Radii, AreIonicOfSaltsAndOxides) {
  const ParticleFrame salt = periodic({"Na", "Cl"});
  EXPECT_EQ(radii_of(salt), (Radii{1.02F, 1.81F}));
  EXPECT_EQ(source_of(salt), "ionic radii, in angstrom");
  EXPECT_THAT(notes_of(salt),
              HasSubstr("as of salts and oxides (\"vdw\" for van der Waals radii)"));
  EXPECT_EQ(radii_of(salt, {.radius = RadiusTable::vdw}), (Radii{2.5F, 1.82F}));
  EXPECT_EQ(source_of(periodic({"Sr", "Ti", "O", "O", "O"})), "ionic radii, in angstrom");
  EXPECT_EQ(source_of(periodic({"Cu", "Cu", "O"})), "ionic radii, in angstrom");
  ParticleStyle sticks;
  sticks.shape = ParticleShape::balls_and_sticks;
  EXPECT_EQ(source_of(salt, sticks), "0.23 of van der Waals radii, in angstrom");
}

TEST(Radii, AreIonicOfNothingElse) {
  const std::string usual = "van der Waals radii, in angstrom";
  const std::vector<std::vector<std::string>> others{{"Cu", "Cu"},
                                                     {"Cu", "Cu", "Cu", "O"},
                                                     {"C", "O", "O"},
                                                     {"Na", "Cl", "H"},
                                                     {"Ar", "O"},
                                                     {"Na", "Cl", "Cl", "X"},
                                                     {"Si", "O", "O"},
                                                     {"Mo", "S", "S"},
                                                     {"Na", "N", "O", "O", "O"}};
  for (const std::vector<std::string>& species : others)
    EXPECT_EQ(source_of(periodic(species)), usual) << species[0] << species[1];
  ParticleFrame slab = periodic({"Na", "Cl"});
  slab.cell->periodic[2] = false;
  EXPECT_EQ(source_of(slab), usual);
  EXPECT_EQ(source_of(row_of({"Na", "Cl"})), usual);
}

TEST(Radii, AreIonicOfWholeSeriesOnly) {
  const auto own_of = [](const ParticleFrame& frame) {
    return ParticleSpheres::make(frame, {}).value().own_choices();
  };
  const ParticleFrame salt = periodic({"Na", "Cl"}), metal = periodic({"Na", "Na"});
  ParticleChoices salts, both;
  for (const ParticleFrame& frame : {salt, salt}) salts.add(own_of(frame));
  for (const ParticleFrame& frame : {salt, metal}) both.add(own_of(frame));
  EXPECT_FALSE(salts.radii_differ);
  EXPECT_TRUE(both.radii_differ);
  EXPECT_EQ(source_of(salt, {.chosen = &salts}), "ionic radii, in angstrom");
  EXPECT_EQ(source_of(salt, {.chosen = &both}), "van der Waals radii, in angstrom");
}

TEST(Radii, AreThoseGivenForSpecies) {
  const ParticleFrame frame = row_of({"Na", "bead", "Cl"});
  const std::vector<KindRadius> given{{"na", 1.02}, {"bead", 3}};
  EXPECT_EQ(radii_of(frame, {.radius = RadiusTable::covalent, .scale = 2, .radii = given}),
            (Radii{2.04F, 6, 2.04F}));
  EXPECT_EQ(radii_of(frame, {.radius = 0.5, .radii = given}), (Radii{1.02F, 3, 0.5F}));
  EXPECT_EQ(notes_of(frame, {.radius = RadiusTable::covalent, .radii = given}), "");
  EXPECT_EQ(source_of(frame, {.radius = 0.5, .radii = given}),
            "the same for all, but for species that have their own");
  EXPECT_EQ(error_of(frame, {.radii = {{"baed", 1}}}),
            "radii: no particle is of the kind 'baed', expected 'Na', 'bead' or 'Cl'; did you "
            "mean 'bead'?");
  EXPECT_EQ(error_of(row_of_particles(1), {.radii = given}), "radii: the file tells no species");
  ParticleFrame own = frame;
  own.numbers = {{"radius", {1, 2, 3}}};
  EXPECT_THAT(error_of(own, {.radii = given}),
              HasSubstr("radii: the radii are those of the column"));
}

TEST(Radii, AreHalfTheTypicalDistanceElse) {
  for (const ParticleFrame& frame : {row_of_particles(5), row_of({"1", "2", "1"}),
                                     row_of({"C", "bead"}), row_of({"C", "A", "A"})}) {
    EXPECT_EQ(radii_of(frame), Radii(frame.size(), 0.5F));
    EXPECT_EQ(source_of(frame), "half the typical distance to the nearest neighbour");
    EXPECT_THAT(notes_of(frame), HasSubstr("the radius is half the typical distance to the "
                                           "nearest neighbour, 0.5\n"));
  }
  EXPECT_EQ(radii_of(row_of_particles(1)), (Radii{1}));
}

TEST(Radii, UnknownSpeciesHaveTypicalRadii) {
  const ParticleFrame frame = row_of({"C", "bead", "Po", "Mt"});
  EXPECT_EQ(radii_of(frame, {.radius = RadiusTable::vdw}), (Radii{1.77F, 0.5F, 0.5F, 0.5F}));
  EXPECT_THAT(notes_of(frame, {.radius = RadiusTable::vdw}),
              HasSubstr("the table of van der Waals radii lacks the species 'bead', 'Po' or 'Mt'"));
  EXPECT_EQ(radii_of(frame, {.radius = RadiusTable::covalent})[2], 1.4F);
  EXPECT_EQ(radii_of(row_of({"O", "H", "H", "MW"})), (Radii{1.5F, 1.2F, 1.2F, 0.5F}));
}

// What is selected must not change the size of what is seen.
TEST(Radii, TypicalDistanceIsThatOfAllParticles) {
  ParticleFrame frame = row_of_particles(9);
  EXPECT_EQ(radii_of(frame, {.select = "x < 1 || x > 7"}), (Radii{0.5F, 0.5F}));
}

TEST(Radii, RefuseWhatIsNoRadius) {
  const ParticleFrame row = row_of_particles(3);
  EXPECT_EQ(error_of(row, {.radius = 0.0}),
            "radius: the radius is 0, expected a finite number above 0");
  EXPECT_THAT(error_of(row, {.radius = -1.0}), HasSubstr("radius: the radius is -1"));
  EXPECT_THAT(error_of(row, {.radius = std::numeric_limits<double>::infinity()}),
              HasSubstr("radius: the radius is inf"));
  EXPECT_EQ(error_of(row, {.radius = 1e-60}),
            "radius: the radius is 1e-60, which is too small for a sphere");
  EXPECT_EQ(error_of(row, {.radius = 1e60}),
            "radius: the radius is 1e+60, which is too large for a sphere");
  EXPECT_EQ(error_of(row, {.radius = 1.0, .scale = 1e60}),
            "scale: the radius is 1e+60, which is too large for a sphere");
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(error_of(row, {.scale = scale}), "scale: expected a finite number above 0");
  }
}

TEST(Radii, ErrorsTellTheParticle) {
  ParticleFrame frame = row_of_particles(200000);
  frame.numbers = {{"radius", std::vector<double>(200000, 1)}};
  frame.numbers[0].values[170000] = 0;
  frame.numbers[0].values[150000] = -2;
  EXPECT_EQ(error_of(frame, {}),
            "radius: the radius of particle 150001 of 200000 is -2, expected a finite number "
            "above 0");
  // Of those that are not shown nothing is asked; the number is that of the file.
  EXPECT_EQ(error_of(frame, {.select = "radius > -1 && x > 10"}),
            "radius: the radius of particle 170001 of 200000 is 0, expected a finite number "
            "above 0");
  EXPECT_EQ(error_of(frame, {.select = "radius > 0"}), "");
}

TEST(Radii, RefuseUnknownColumnsAndTexts) {
  ParticleFrame frame = row_of_particles(2);
  frame.numbers = {{"size", {1, 2}}};
  frame.texts = {text_column("name", {"a", "b"})};
  EXPECT_EQ(error_of(frame, {.radius = RadiusColumn{"sise"}}),
            "radius: there is no column 'sise'; did you mean 'size'?");
  EXPECT_THAT(error_of(frame, {.radius = RadiusColumn{"Covalnt"}}),
              HasSubstr("; did you mean 'covalent'?"));
  EXPECT_EQ(error_of(frame, {.radius = RadiusColumn{"quantity"}}),
            "radius: there is no column 'quantity', expected 'x', 'y', 'z', 'size' or 'name'");
  EXPECT_EQ(error_of(frame, {.radius = RadiusColumn{"name"}}),
            "radius: the column 'name' is of texts, expected numbers");
  EXPECT_EQ(error_of(frame, {.radius = RadiusTable::vdw}),
            "radius: van der Waals radii need elements, the file tells none");
}

// What was not wanted was not read, but its name is known.
TEST(Radii, MeantColumnsMayBeUnread) {
  ParticleFrame frame = row_of_particles(2);
  frame.unread = {"size", "type"};
  EXPECT_EQ(error_of(frame, {.radius = RadiusColumn{"sise"}}),
            "radius: there is no column 'sise'; did you mean 'size'?");
}

TEST(Radii, SmallestIsThatOfTheSpheres) {
  ParticleFrame frame = row_of_particles(3);
  frame.numbers = {{"radius", {3, 0.1, 2}}};
  const auto made = ParticleSpheres::make(frame, {.scale = 0.5});
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(made.value().smallest_radius(), 0.05);
  EXPECT_EQ(ParticleSpheres::make(frame, {.select = "x > 1"}).value().smallest_radius(), 2);
  EXPECT_EQ(ParticleSpheres::make(frame, {.select = "x > 5"}).value().smallest_radius(), 0);
}

}  // namespace
}  // namespace boule
