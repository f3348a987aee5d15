#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <tuple>
#include <type_traits>

#include "core/scene/scene.h"
#include "render/apps/job/options/choice.h"
#include "render/apps/python/values/arguments.h"
#include "render/apps/python/values/errors.h"
#include "render/renderer/aov_channels.h"

namespace boule::python {

/// An argument as the command line has it: its text, or that of a list of parts with `between`
/// between them, "640x480", "#000000,#ffffff", or that of a dictionary, "O=crimson,N=navy".
/// Precondition: it is given.
std::string text_of(const Arguments& given, const char* name, char between);

/// The argument of one row of a list of choices (render/apps/job/options/choice.h), if it is given.
/// Returns whether it was; a flag counts only where it is True. An Error if its value is not
/// understood.
template <class Owner, class Member, class Rule, class To>
bool read_row(const Arguments& given, const Choice<Owner, Member, Rule, To>& row, Owner& owner) {
  const std::string key(row.name);
  const char* const name = key.c_str();
  if (!given.find(name)) return false;
  Member& target = owner.*row.member;
  using Value = chosen_value<Member>;
  if constexpr (std::is_same_v<Rule, WholeRule>) {
    target = static_cast<Value>(*given.whole(name, row.rule));
  } else if constexpr (std::is_same_v<Rule, NumberRule>) {
    target = static_cast<Value>(*given.number(name, row.rule));
  } else if constexpr (std::is_same_v<Rule, NameRule>) {
    target = *given.choice<Value>(name);
  } else if constexpr (std::is_same_v<Rule, FlagRule>) {
    target = given.flag(name);
    return target;
  } else {
    const std::string text = text_of(given, name, row.rule.between);
    if constexpr (std::is_same_v<Value, AovSelection> || std::is_same_v<Value, OverlayParts>) {
      if (text.empty()) {  // a list of none
        target = Value{};
        return true;
      }
    }
    const auto parsed = row.rule.parse(text);
    if (!parsed)
      throw_error(name, quote(text) + " is not understood, expected " + row.rule.expected +
                            row.rule.hint(text));
    target = *parsed;
  }
  return true;
}

/// The arguments of all rows. Returns the first that is given, as an option of the command line;
/// empty: none.
template <class List, class Owner>
std::string read_rows(const Arguments& given, const List& list, Owner& owner) {
  std::string first;
  const auto read = [&](const auto& row) {
    if (read_row(given, row, owner) && first.empty()) first = row.option();
  };
  std::apply([&](const auto&... row) { (read(row), ...); }, list);
  return first;
}

}  // namespace boule::python
