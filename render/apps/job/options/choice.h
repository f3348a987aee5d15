#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/scene/names.h"
#include "core/scene/rule.h"

namespace boule {

/// The options of a job stand in one list each, such as render_choices(). The command line, Python
/// and the manual pages have an option from its row alone.

/// Values that are written as text. Python may give a list of `parts` instead: they are joined.
template <class Value>
struct TextRule {
  std::optional<Value> (*parse)(const std::string& text);  ///< none: not understood
  std::string expected;                                    ///< "A,B with A < B"
  char between = ',';                                      ///< what joins the parts of a list
  /// What is probably meant where the text is not understood: "; did you mean 'viridis'?".
  std::string (*hint)(const std::string& text) = [](const std::string&) { return std::string(); };
};
template <class Value>
TextRule(std::optional<Value> (*)(const std::string&), const char*) -> TextRule<Value>;
template <class Value>
TextRule(std::optional<Value> (*)(const std::string&), std::string) -> TextRule<Value>;
template <class Value>
TextRule(std::optional<Value> (*)(const std::string&), const char*, char) -> TextRule<Value>;
template <class Value>
TextRule(std::optional<Value> (*)(const std::string&), std::string, char,
         std::string (*)(const std::string&)) -> TextRule<Value>;

/// One of the names of an enumeration.
struct NameRule {};

/// On or off.
struct FlagRule {};

/// For a choice that no single member of the result takes.
struct Nowhere {};

/// One option. `Owner` is the struct that keeps what is chosen.
template <class Owner, class Member, class Rule, class To = Nowhere>
struct Choice {
  std::string_view group;  ///< the heading in the help of the command line
  std::string_view name;   ///< in Python; the command line has -- before it, and - for _
  Member Owner::*member;
  Rule rule;
  std::string value;  ///< what stands for the value in the help: "WxH"
  std::string help;
  To to{};  ///< the member of the result that gets the value

  /// "--min-spp".
  [[nodiscard]] std::string option() const {
    std::string text = "--" + std::string(name);
    for (char& c : text) {
      if (c == '_') c = '-';
    }
    return text;
  }
};

namespace detail {

/// A row of a list of options of `Owner`.
template <class Owner, class Base, class Member, class Rule, class To = Nowhere>
Choice<Owner, Member, Rule, To> choice(const char* group, const char* name, Member Base::*member,
                                       Rule rule, std::string value, std::string help, To to = {}) {
  return {group, name, member, std::move(rule), std::move(value), std::move(help), to};
}

}  // namespace detail

/// What a member holds: Value of std::optional<Value>.
template <class Member>
struct ChosenValue {
  using type = Member;
};
template <class Value>
struct ChosenValue<std::optional<Value>> {
  using type = Value;
};
template <class Member>
using chosen_value = typename ChosenValue<Member>::type;

}  // namespace boule
