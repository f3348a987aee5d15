#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "core/scene/names.h"

namespace boule::view {

using Json = nlohmann::ordered_json;

/// Reads the keys of one object of a message. The first thing that is wrong stays; reading goes on,
/// and what is not right is as if it were not there.
class MessageKeys {
 public:
  /// `path` stands before the keys in errors: "camera.". `json` must outlive it.
  explicit MessageKeys(const Json& json, std::string path = {})
      : json_(json), path_(std::move(path)) {
    if (!json.is_object()) report("", "expected an object");
  }

  /// The value of a key, or null. From then on the key is known.
  const Json* find(const char* key) {
    known_.insert(key);
    if (!json_.is_object()) return nullptr;
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }

  void report(const std::string& key, std::string message) {
    if (status_) status_ = Diagnostic::about(path_ + key, std::move(message));
  }

  /// A finite number within low .. high.
  std::optional<double> number(const char* key, double low, double high) {
    const Json* const value = find(key);
    return value == nullptr ? std::nullopt : number_of(*value, key, low, high);
  }
  std::optional<double> number(const char* key) { return number(key, -1e300, 1e300); }

  /// A whole number within low .. high.
  std::optional<std::int64_t> whole(const char* key, std::int64_t low, std::int64_t high) {
    const Json* const value = find(key);
    if (value == nullptr) return std::nullopt;
    const auto found = number_of(*value, key, static_cast<double>(low), static_cast<double>(high));
    if (!found) return std::nullopt;
    if (*found == std::floor(*found)) return static_cast<std::int64_t>(*found);
    report(key, "expected a whole number");
    return std::nullopt;
  }
  /// A number that counts something for the client.
  std::uint32_t counter(const char* key) {
    const auto found = whole(key, 0, 4294967295);
    if (!found) report(key, "expected a whole number");
    return static_cast<std::uint32_t>(found.value_or(0));
  }

  std::optional<bool> flag(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr) return std::nullopt;
    if (value->is_boolean()) return value->get<bool>();
    report(key, "expected true or false");
    return std::nullopt;
  }

  std::optional<std::string> text(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr) return std::nullopt;
    if (value->is_string() && value->get_ref<const std::string&>().size() <= longest_text)
      return value->get<std::string>();
    report(key, "expected a text of " + std::to_string(longest_text) + " bytes at most");
    return std::nullopt;
  }

  /// So many numbers.
  template <std::size_t n>
  std::optional<std::array<double, n>> numbers(const char* key, const Json& value, double low,
                                               double high) {
    std::array<double, n> all{};
    if (!value.is_array() || value.size() != n) {
      report(key, "expected " + std::to_string(n) + " numbers");
      return std::nullopt;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto one = number_of(value[i], key, low, high);
      if (!one) return std::nullopt;
      all[i] = *one;
    }
    return all;
  }

  std::optional<Vec3d> vector(const char* key) {
    const Json* const value = find(key);
    if (value == nullptr) return std::nullopt;
    const auto all = numbers<3>(key, *value, -1e300, 1e300);
    if (!all) return std::nullopt;
    return Vec3d{(*all)[0], (*all)[1], (*all)[2]};
  }

  template <class Enum>
  std::optional<Enum> choice(const char* key) {
    const auto name = text(key);
    if (!name) return std::nullopt;
    std::string expected;
    for (std::size_t i = 0; i < names<Enum>.size(); ++i) {
      if (*name == names<Enum>[i]) return static_cast<Enum>(i);
      expected += (i == 0 ? "" : ", ") + std::string(names<Enum>[i]);
    }
    report(key, "expected one of " + expected);
    return std::nullopt;
  }

  /// The first error, or one about a key that nobody asked for.
  [[nodiscard]] Status finish() {
    if (!status_ || !json_.is_object()) return status_;
    for (const auto& [key, value] : json_.items()) {
      if (known_.count(key) == 0) return Diagnostic::about(path_ + key, "unknown key");
    }
    return {};
  }

 private:
  static constexpr std::size_t longest_text = 1024;

  std::optional<double> number_of(const Json& value, const char* key, double low, double high) {
    if (value.is_number()) {
      const auto found = value.get<double>();
      if (found >= low && found <= high) return found;
    }
    report(key, "expected a number from " + number_words(low) + " to " + number_words(high));
    return std::nullopt;
  }
  static std::string number_words(double number) { return fmt::format("{}", number); }

  const Json& json_;
  const std::string path_;
  std::set<std::string, std::less<>> known_;
  Status status_;
};

}  // namespace boule::view
