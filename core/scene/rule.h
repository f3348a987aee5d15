#pragma once

#include <limits>
#include <string>

namespace boule {

/// The rule of a field gives its allowed values. describe() words a rule for error messages, as the
/// rest of a sentence that begins with "must be"; it throws std::bad_alloc.

/// Finite numbers between two bounds. The rule holds for every component of a vector or a colour.
struct NumberRule {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool takes_low = true, takes_high = true;  ///< whether the bound itself is allowed
  const char* unit = "";

  [[nodiscard]] bool allows(double x) const;
};

/// Whole numbers from low to high. Where `high` is the largest int, messages name no upper bound.
struct WholeRule {
  int low, high;

  [[nodiscard]] constexpr bool allows(int x) const { return x >= low && x <= high; }
};

/// Finite points of the scene. Scene files may measure them from another point than 0: their
/// `origin` is subtracted from each.
struct PointRule : NumberRule {};

/// Finite vectors of any length but 0.
struct DirectionRule {};

/// The number of a material or a group of the scene; scene files give its name.
struct MaterialRule {};
struct GroupRule {};

/// Values that scene files take from another file that they name. check_whole() of the struct
/// checks them.
struct FileRule {};

/// Every value of the type; a struct with fields of its own has their rules.
struct TypeRule {};

std::string describe(const NumberRule& rule);
std::string describe(const WholeRule& rule);

namespace rule {

inline constexpr NumberRule finite{};
inline constexpr NumberRule positive{.low = 0, .takes_low = false};
inline constexpr NumberRule not_negative{.low = 0};
/// Both bounds are allowed.
constexpr NumberRule from_to(double low, double high) { return {.low = low, .high = high}; }
/// The angles of view of a flat film, and those of a film that may see all around.
inline constexpr NumberRule acute_view{
    .low = 0, .high = 180, .takes_low = false, .takes_high = false, .unit = " degrees"};
inline constexpr NumberRule any_view{.low = 0, .high = 360, .takes_low = false, .unit = " degrees"};
inline constexpr PointRule point{};
inline constexpr DirectionRule direction{};
inline constexpr MaterialRule material{};
inline constexpr GroupRule group{};
inline constexpr FileRule from_file{};

}  // namespace rule
}  // namespace boule
