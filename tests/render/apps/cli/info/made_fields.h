#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/scene/scene.h"

namespace boule::cli {

/// A key, a value for it, and another one; no value: it is left out.
struct Field {
  std::string key, value, other;
};

/// Two values of a field, as scene files have them: any that its rule allows. `number` tells fields
/// of points and vectors apart.
class FieldMaker {
 public:
  template <HasFields T>
  void add_all() {
    each_field<T>([this](const auto& field) { this->add_field(field); });
  }
  std::vector<Field> fields;

 private:
  template <class Owner, class Member, class Rule>
  void add_field(const boule::Field<Owner, Member, Rule>& field) {
    ++number_;
    if constexpr (HasFields<Member>) {
      add_all<Member>();
    } else {
      add(std::string(field.key), field.rule, std::type_identity<Member>());
    }
  }
  template <class Owner, class Member, class Rule>
  void add_field(const PairField<Owner, Member, Rule>&) {}  // by hand

  void add(std::string key, const NumberRule& rule, std::type_identity<float>) {
    const double low = std::isfinite(rule.low) ? rule.low : 0;
    const double size = std::isfinite(rule.high) ? rule.high - low : 1;
    fields.push_back(
        {std::move(key), std::to_string(low + size / 4), std::to_string(low + size / 2)});
  }
  void add(std::string key, const NumberRule& rule, std::type_identity<std::optional<float>>) {
    add(std::move(key), rule, std::type_identity<float>());
  }
  template <class Rule>
  void add(std::string key, const Rule&, std::type_identity<Vec3f>) {
    const std::string start = "[" + std::to_string(number_) + ", 2, ";
    fields.push_back({std::move(key), start + "3]", start + "4]"});
  }
  template <class Rule>
  void add(std::string key, const Rule&, std::type_identity<Color>) {
    fields.push_back({std::move(key), "[0.1, 0.2, 0.3]", "[0.1, 0.2, 0.4]"});
  }
  void add(std::string key, const WholeRule& rule, std::type_identity<int>) {
    fields.push_back({std::move(key), std::to_string(rule.low), std::to_string(rule.low + 1)});
  }
  void add(std::string key, const TypeRule&, std::type_identity<bool>) {
    fields.push_back({std::move(key), "false", "true"});
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(std::string key, const TypeRule&, std::type_identity<Enum>) {
    const auto name = [](std::size_t i) { return '"' + std::string(names<Enum>[i]) + '"'; };
    fields.push_back({std::move(key), name(0), name(1)});
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(std::string key, const TypeRule&, std::type_identity<std::vector<Enum>>) {
    fields.push_back({std::move(key), "[]", "[\"" + std::string(names<Enum>[0]) + "\"]"});
  }
  template <class Member>
  void add(const std::string&, const FileRule&, std::type_identity<Member>) {}

  int number_ = 0;
};

}  // namespace boule::cli
