#include "render/files/particles/elements.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "render/files/particles/ionic_radii.h"

namespace boule {
namespace {

TEST(Elements, AreFoundInAnyCase) {
  for (const char* symbol : {"Fe", "FE", "fe", "fE"}) {
    ASSERT_NE(find_element(symbol), nullptr);
    EXPECT_EQ(find_element(symbol)->symbol, "Fe");
  }
  EXPECT_EQ(find_element("CA")->symbol, "Ca");
  EXPECT_EQ(find_element("D")->symbol, "H");
  EXPECT_EQ(find_element("T")->symbol, "H");
  for (const char* charged : {"O2-", "o-2", "O--", "O-"}) {
    ASSERT_NE(find_element(charged), nullptr) << charged;
    EXPECT_EQ(find_element(charged)->symbol, "O");
  }
  for (const char* other : {"", "1", "26", "Fe1", "C ", "CA1", "X", "Xx", "bead", "carbon", "+",
                            "2+", "Fe+22", "Fe+-", "Fe1+2", "C-H"}) {
    EXPECT_EQ(find_element(other), nullptr) << other;
  }
}

TEST(Elements, AreInTheOrderOfTheirNumbers) {
  const auto elements = all_elements();
  ASSERT_EQ(elements.size(), 109U);
  EXPECT_EQ(elements[0].symbol, "H");
  EXPECT_EQ(elements[25].symbol, "Fe");
  EXPECT_EQ(elements[78].symbol, "Au");
  EXPECT_EQ(elements[108].symbol, "Mt");
  std::set<std::string_view> symbols;
  for (const Element& element : elements) symbols.insert(element.symbol);
  EXPECT_EQ(symbols.size(), elements.size());
}

// Shannon's table 1.
TEST(Elements, IonsHaveTheirRadii) {
  for (const IonicRadius& known :
       {IonicRadius{"O", -2, 1.40}, IonicRadius{"Cl", -1, 1.81}, IonicRadius{"Na", 1, 1.02},
        IonicRadius{"Sr", 2, 1.18}, IonicRadius{"Ti", 4, 0.605}, IonicRadius{"La", 3, 1.032}}) {
    EXPECT_EQ(ionic_radius(known.symbol), known.radius) << known.symbol;
  }
  for (const char* none : {"H", "He", "Ra", "Es", "X"}) EXPECT_EQ(ionic_radius(none), 0) << none;
  const Element* last = nullptr;
  for (const IonicRadius& ion : all_ionic_radii()) {
    const Element* const element = find_element(ion.symbol);
    ASSERT_NE(element, nullptr) << ion.symbol;
    EXPECT_TRUE(last == nullptr || last < element) << ion.symbol;
    EXPECT_NE(ion.charge, 0) << ion.symbol;
    if (ion.charge < 0) EXPECT_GT(ion.radius, element->covalent) << ion.symbol;
    last = element;
  }
}

// Alvarez' figure 10 and Cordero's table 2, and Jmol's list.
TEST(Elements, HaveTheFiguresOfTheirSources) {
  struct Known {
    const char* symbol;
    SrgbColor color;
    double vdw, covalent;
  };
  for (const Known& known :
       {Known{"H", {0xff, 0xff, 0xff}, 1.20, 0.31}, Known{"C", {0x90, 0x90, 0x90}, 1.77, 0.76},
        Known{"N", {0x30, 0x50, 0xf8}, 1.66, 0.71}, Known{"O", {0xff, 0x0d, 0x0d}, 1.50, 0.66},
        Known{"Fe", {0xe0, 0x66, 0x33}, 2.44, 1.32}, Known{"Au", {0xff, 0xd1, 0x23}, 2.32, 1.36},
        Known{"Po", {0xab, 0x5c, 0x00}, 0, 1.40}, Known{"U", {0x00, 0x8f, 0xff}, 2.71, 1.96},
        Known{"Mt", {0xeb, 0x00, 0x26}, 0, 0}}) {
    const Element* const element = find_element(known.symbol);
    ASSERT_NE(element, nullptr);
    EXPECT_EQ(element->color, known.color) << known.symbol;
    EXPECT_EQ(element->vdw, known.vdw) << known.symbol;
    EXPECT_EQ(element->covalent, known.covalent) << known.symbol;
  }
}

}  // namespace
}  // namespace boule
