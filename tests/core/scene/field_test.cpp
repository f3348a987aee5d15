// The lists of fields: none forgets a member, and the checker follows them.
#include "core/scene/field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/scene/problem_finder.h"
#include "core/scene/scene.h"

namespace boule {

// What the static checks are for: each of these lists or names is wrong in one way.
namespace wrong {

struct Forgets {
  float kept = 0, forgotten = 0;
};
struct Repeats {
  float kept = 0, forgotten = 0;
};
struct Whole {
  int width = 0, height = 0;
  float x = 0;
};
enum class Short { one, two };
enum class Long { one, two };
enum class Nameless { one };

}  // namespace wrong

template <>
inline constexpr auto fields<wrong::Forgets> =
    field_list("forgets", field("kept", &wrong::Forgets::kept, rule::finite));
template <>
inline constexpr auto fields<wrong::Repeats> =
    field_list("repeats", field("kept", &wrong::Repeats::kept, rule::finite),
               field("forgotten", &wrong::Repeats::kept, rule::finite));
template <>
inline constexpr auto fields<wrong::Whole> =
    field_list("whole", field("size", &wrong::Whole::width, &wrong::Whole::height, WholeRule{1, 9}),
               field("x", &wrong::Whole::x, rule::finite));
template <>
inline constexpr std::array<std::string_view, 1> names<wrong::Short>{"one"};
template <>
inline constexpr std::array<std::string_view, 3> names<wrong::Long>{"one", "two", "three"};

namespace {

static_assert(!lists_every_member<wrong::Forgets>);
static_assert(!lists_every_member<wrong::Repeats>);
static_assert(lists_every_member<wrong::Whole>);
static_assert(!names_every_enumerator<wrong::Short>);
static_assert(!names_every_enumerator<wrong::Long>);
static_assert(!names_every_enumerator<wrong::Nameless>);
static_assert(names_every_enumerator<FovAxis> && names_every_enumerator<Method> &&
              names_every_enumerator<PixelFilter> && names_every_enumerator<Falloff>);
static_assert(HasFields<Glass> && HasFields<const Glass> && !HasFields<float>);

template <class Variant>
struct VariantKinds;
template <class... Kinds>
struct VariantKinds<std::variant<Kinds...>> {
  using Types = testing::Types<Kinds...>;
  template <class Function>
  static void each(const Function& function) {
    (function(Kinds{}), ...);
  }
};

/// Calls function(T{}) for every struct that the scene is made of.
template <class Function>
void each_struct(const Function& function) {
  VariantKinds<Camera>::each(function);
  VariantKinds<Light>::each(function);
  VariantKinds<Material>::each(function);
  VariantKinds<Background>::each(function);
  VariantKinds<std::variant<CameraPose, CameraFit, LensSurface, DistortionMap, Sphere, Plane,
                            Instance, ImageSettings, RenderSettings>>::each(function);
}

TEST(Fields, KeysAreUniqueWithinAStruct) {
  each_struct([](const auto& value) {
    using Struct = std::remove_cvref_t<decltype(value)>;
    std::set<std::string> keys;
    each_field<Struct>([&](const auto& field) {
      EXPECT_TRUE(keys.insert(std::string(field.key)).second) << field.key;
    });
    EXPECT_FALSE(keys.empty());
  });
}

TEST(Fields, AreVisitedInOrderAndWritable) {
  Glass glass;
  std::string keys;
  each_field(glass, [&](const auto& field, auto& member) {
    keys += std::string(field.key) + " ";
    if constexpr (std::is_same_v<decltype(member), float&>) member = 2;
  });
  EXPECT_EQ(keys, "color ior ");
  EXPECT_EQ(glass.ior, 2);
  const ImageSettings image{.width = 3, .height = 4};
  each_field(image, [&](const auto& field, const auto& member) {
    if constexpr (requires { member.second; }) {
      EXPECT_EQ(field.key, "size");
      EXPECT_EQ(member.first, 3);
      EXPECT_EQ(member.second, 4);
    }
  });
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Spoils a member so that no rule of numbers allows it; false if it has none of its own.
bool spoil(float& x) { return std::isnan(x = nan); }
bool spoil(Vec3f& v) { return spoil(v.y); }
bool spoil(Color& c) { return spoil(c.g); }
bool spoil(std::optional<float>& x) { return spoil(x.emplace()); }
bool spoil(std::optional<Vec3f>& v) { return spoil(v.emplace()); }
bool spoil(Both<int>& both) { return (both.second = -1) < 0; }
bool spoil(int& number) { return (number = -1) < 0; }
template <class T>
bool spoil(T&) {
  return false;
}

/// False for what stands in another file: that is checked as a whole.
bool has_numbers(const FileRule&) { return false; }
template <class Rule>
bool has_numbers(const Rule&) {
  return true;
}

/// Whatever field is added to a struct: find_problem() looks at it.
TEST(Fields, EveryNumberIsChecked) {
  int spoilt = 0;
  each_struct([&](const auto& value) {
    using Struct = std::remove_cvref_t<decltype(value)>;
    std::size_t count = 0;
    each_field<Struct>([&](const auto&) { ++count; });
    for (std::size_t i = 0; i < count; ++i) {
      Struct bad = value;
      std::size_t at = 0;
      std::string key;
      each_field(bad, [&](const auto& field, auto&& member) {
        if (at++ == i && has_numbers(field.rule) && spoil(member)) key = field.key;
      });
      if (key.empty()) continue;
      ++spoilt;
      const auto problem = first_problem(bad);
      ASSERT_TRUE(problem) << key;
      EXPECT_EQ(problem->field, key) << problem->message;
    }
  });
  EXPECT_GE(spoilt, 64);  // it may grow
}

TEST(Names, AreThoseOfSceneFiles) {
  EXPECT_EQ(name_of(FovAxis::max), "max");
  EXPECT_EQ(name_of(Falloff::inverse_square), "inverse_square");
  EXPECT_EQ(name_of(static_cast<Method>(9)), "whitted");
  EXPECT_EQ(names<Camera>[Camera(ThinLensCamera{}).index()], "thin_lens");
  EXPECT_EQ(names<Light>.size(), std::variant_size_v<Light>);
}

struct RuleCase {
  NumberRule rule;
  std::string words;
  std::vector<double> allowed, refused;
};

TEST(Rules, SayWhatTheyAllow) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const RuleCase cases[] = {
      {rule::finite, "finite", {0, -1e30, 1e30}, {inf, -inf, double{nan}}},
      {rule::positive, "finite and above 0", {1e-40, 1e30}, {0, -1, inf, double{nan}}},
      {rule::not_negative, "finite and 0 or above", {0, 1}, {-1e-40, inf}},
      {rule::acute_view, "above 0 and below 180 degrees", {1e-6, 179}, {0, 180, double{nan}}},
      {rule::any_view, "above 0 and at most 360 degrees", {1, 360}, {0, 361}},
      {rule::from_to(0.25, 8), "from 0.25 to 8", {0.25, 1, 8}, {0.2, 8.5}}};
  for (const RuleCase& c : cases) {
    EXPECT_EQ(describe(c.rule), c.words);
    for (const double x : c.allowed) EXPECT_TRUE(c.rule.allows(x)) << c.words << ": " << x;
    for (const double x : c.refused) EXPECT_FALSE(c.rule.allows(x)) << c.words << ": " << x;
  }
  EXPECT_EQ(describe(WholeRule{1, 9}), "1 to 9");
  EXPECT_EQ(describe(WholeRule{0, max_count}), "0 or above");
}

}  // namespace
}  // namespace boule
