#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/base/error.h"
#include "core/scene/names.h"
#include "render/apps/cli/options/options.h"
#include "render/apps/job/options/choice.h"
#include "render/apps/job/options/option_values.h"
#include "render/files/file/nearest_name.h"

namespace boule::cli {

/// "--threads" of "-t,--threads".
inline std::string long_name(const std::string& names) {
  return names.substr(names.rfind(',') + 1);
}

inline CLI::ValidationError refuse(const std::string& names, const std::string& text,
                                   const std::string& expected, const std::string& hint = {}) {
  return CLI::ValidationError(long_name(names),
                              quote(text) + " is not understood, expected " + expected + hint);
}

inline std::string no_hint(const std::string& /*text*/) { return {}; }

/// An option whose value is parsed by `parse`, which returns a std::optional: none is an error.
/// `hint` tells what is probably meant where the text is not understood.
template <class Target, class Parse, class Hint = std::string (*)(const std::string&)>
void add_parsed(CLI::App& app, const std::string& names, Target& target, const Parse& parse,
                const std::string& expected, const std::string& type, const std::string& help,
                const Hint& hint = no_hint) {
  const auto store = [&target, names, parse, expected, hint](const std::string& text) {
    const auto value = parse(text);
    if (!value) throw refuse(names, text, expected, hint(text));
    target = *value;
  };
  app.add_option_function<std::string>(names, store, help)->type_name(type);
}

/// An option that takes a whole number within low .. high.
template <class Number, class Target>
void add_whole(CLI::App& app, const std::string& names, Target& target, Number low, Number high,
               const std::string& help) {
  const auto parse = [low, high](const std::string& text) { return parse_number(text, low, high); };
  add_parsed(app, names, target, parse,
             "a whole number from " + std::to_string(low) + " to " + std::to_string(high), "N",
             help);
}

template <class T>
struct Named {
  std::string_view name;
  T value;
};
template <class T>
Named(const char*, T) -> Named<T>;

/// All enumerators, by their names.
template <class Enum>
std::array<Named<Enum>, names<Enum>.size()> choices() {
  static_assert(names_every_enumerator<Enum>, "an enumerator has no name");
  std::array<Named<Enum>, names<Enum>.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {names<Enum>[i], static_cast<Enum>(i)};
  return all;
}

/// An option that takes one of a few names.
template <class Target, class T, std::size_t n>
void add_choice(CLI::App& app, const std::string& name, Target& target,
                const std::array<Named<T>, n>& choices, const std::string& help) {
  std::string names;
  for (const Named<T>& choice : choices)
    names += (names.empty() ? "" : "|") + std::string(choice.name);
  const auto parse = [choices](const std::string& text) -> std::optional<T> {
    for (const Named<T>& choice : choices) {
      if (text == choice.name) return choice.value;
    }
    return std::nullopt;
  };
  const auto hint = [choices](const std::string& text) {
    std::vector<std::string_view> known;
    for (const Named<T>& choice : choices) known.push_back(choice.name);
    return did_you_mean(text, known);
  };
  add_parsed(app, name, target, parse, "one of " + names, names, help, hint);
}

/// The option of one row of a list of choices (render/apps/job/options/choice.h).
template <class Owner, class Member, class Rule, class To>
void add_row(CLI::App& app, const Choice<Owner, Member, Rule, To>& row, Owner& owner) {
  const std::string names = (row.name == "threads" ? "-t," : "") + row.option();
  Member& target = owner.*row.member;
  using Value = chosen_value<Member>;
  if constexpr (std::is_same_v<Rule, WholeRule>) {
    add_whole(app, names, target, static_cast<Value>(row.rule.low),
              static_cast<Value>(row.rule.high), row.help);
  } else if constexpr (std::is_same_v<Rule, NumberRule>) {
    const auto parse = [rule = row.rule](const std::string& text) -> std::optional<Value> {
      const auto number =
          parse_number(text, static_cast<Value>(rule.low), static_cast<Value>(rule.high));
      return number && rule.allows(double{*number}) ? number : std::nullopt;
    };
    add_parsed(app, names, target, parse, "a number " + describe(row.rule), row.value, row.help);
  } else if constexpr (std::is_same_v<Rule, NameRule>) {
    add_choice(app, names, target, choices<Value>(), row.help);
  } else if constexpr (std::is_same_v<Rule, FlagRule>) {
    app.add_flag(names, target, row.help);
  } else {
    add_parsed(app, names, target, row.rule.parse, row.rule.expected, row.value, row.help,
               row.rule.hint);
  }
}

/// The options of those rows for which `is_wanted(row)` is true.
template <class List, class Owner, class IsWanted>
void add_rows(CLI::App& app, const List& list, Owner& owner, const IsWanted& is_wanted) {
  const auto add = [&](const auto& row) {
    if (is_wanted(row)) add_row(app, row, owner);
  };
  std::apply([&](const auto&... row) { (add(row), ...); }, list);
}

/// Puts the options that are added from now on under this heading of the help.
inline void start_group(CLI::App& app, const char* heading) {
  app.option_defaults()->group(heading);
}

}  // namespace boule::cli
