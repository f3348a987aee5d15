#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/scene/names.h"
#include "core/scene/rule.h"

namespace boule {

/// Each struct of the scene lists its fields once, as `fields<Struct>` beside its definition. The
/// reader of scene files, the checker, the hash and `boule info` visit that list by each_field().

/// One field: its key in scene files, its member and the values it may hold.
template <class Owner, class Member, class Rule>
struct Field {
  std::string_view key;
  Member Owner::*member;
  Rule rule;
  /// True if scene files can also give the value by other keys or another type. Their reader then
  /// has a function for it.
  bool has_other_forms = false;

  /// The number of members that the key sets.
  static constexpr std::size_t member_count = 1;

  [[nodiscard]] constexpr Field with_other_forms() const { return {key, member, rule, true}; }
};

/// One field that is an array of two in scene files, and two members here.
template <class Owner, class Member, class Rule>
struct PairField {
  std::string_view key;
  Member Owner::*first;
  Member Owner::*second;
  Rule rule;
  bool has_other_forms = false;

  static constexpr std::size_t member_count = 2;
};

/// References to the two members of a PairField.
template <class Member>
struct Both {
  Member& first;
  Member& second;
};
template <class Member>
Both(Member&, Member&) -> Both<Member>;

/// All fields of a struct, in the order of the struct's members, unless its comment says otherwise.
/// Scene hashes depend on the order.
template <class... Fields>
struct FieldList {
  std::string_view type;  ///< the name of the struct in scene files: the `type` of a camera, a
                          ///< section
  std::tuple<Fields...> list;
};

/// The FieldList of a struct; null for a type without one.
template <class T>
inline constexpr std::nullptr_t fields = nullptr;

template <class T>
concept HasFields =
    !std::is_same_v<std::remove_cvref_t<decltype(fields<std::remove_const_t<T>>)>, std::nullptr_t>;

template <class Owner, class Member, class Rule = TypeRule>
constexpr auto field(std::string_view key, Member Owner::*member, Rule rule = {}) {
  return Field<Owner, Member, Rule>{key, member, rule};
}

template <class Owner, class Member, class Rule>
constexpr auto field(std::string_view key, Member Owner::*first, Member Owner::*second, Rule rule) {
  return PairField<Owner, Member, Rule>{key, first, second, rule};
}

template <class... Fields>
constexpr auto field_list(std::string_view type, Fields... list) {
  return FieldList<Fields...>{type, {list...}};
}

namespace detail {

/// Converts to any type, for code that only counts values.
struct AnyMember {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... i>
constexpr bool takes_members(std::index_sequence<i...>) {
  return requires { T{(static_cast<void>(i), AnyMember{})...}; };
}

/// The number of members of an aggregate.
template <class T, std::size_t least = 0>
constexpr std::size_t count_members() {
  if constexpr (takes_members<T>(std::make_index_sequence<least + 1>{})) {
    return count_members<T, least + 1>();
  } else {
    return least;
  }
}

template <class... Fields>
constexpr std::size_t count_listed(const FieldList<Fields...>&) {
  return (std::size_t{0} + ... + Fields::member_count);
}

template <class A, class B>
constexpr bool are_same_member(A, B) {
  return false;
}
template <class Member>
constexpr bool are_same_member(Member a, Member b) {
  return a == b;
}

template <class Owner, class Member, class Rule>
constexpr auto members_of(const Field<Owner, Member, Rule>& field) {
  return std::tuple{field.member};
}
template <class Owner, class Member, class Rule>
constexpr auto members_of(const PairField<Owner, Member, Rule>& field) {
  return std::tuple{field.first, field.second};
}

/// True if every member is listed only once.
template <class... Fields>
constexpr bool lists_once(const FieldList<Fields...>& all) {
  const auto members = std::apply(
      [](const auto&... field) { return std::tuple_cat(members_of(field)...); }, all.list);
  const auto count = [&](auto member) {
    return std::apply(
        [&](auto... other) { return (0 + ... + static_cast<int>(are_same_member(member, other))); },
        members);
  };
  return std::apply([&](auto... member) { return ((count(member) == 1) && ...); }, members);
}

template <class Owner, class Value, class Member, class Rule, class Visitor>
constexpr void visit_field(const Field<Owner, Member, Rule>& field, Value& value,
                           Visitor& visitor) {
  visitor(field, value.*field.member);
}
template <class Owner, class Value, class Member, class Rule, class Visitor>
constexpr void visit_field(const PairField<Owner, Member, Rule>& field, Value& value,
                           Visitor& visitor) {
  visitor(field, Both{value.*field.first, value.*field.second});
}

}  // namespace detail

/// True if a struct's list has every member of it, each once.
template <class T>
inline constexpr bool lists_every_member =
    detail::count_members<T>() == detail::count_listed(fields<T>) && detail::lists_once(fields<T>);

/// Calls visitor(field, member) for each field of a struct, in the order of its list. `member` is a
/// reference to the member, or for a PairField a Both. Exceptions of the visitor propagate.
template <HasFields T, class Visitor>
constexpr void each_field(T& value, Visitor&& visitor) {
  using Struct = std::remove_const_t<T>;
  static_assert(lists_every_member<Struct>, "a member is not in the list of fields, or twice");
  std::apply([&](const auto&... field) { (detail::visit_field(field, value, visitor), ...); },
             fields<Struct>.list);
}

/// Calls visitor(field) for each field of a struct, in the order of its list.
template <HasFields T, class Visitor>
constexpr void each_field(Visitor&& visitor) {
  std::apply([&](const auto&... field) { (visitor(field), ...); }, fields<T>.list);
}

/// The names of the structs that a variant can hold, in the order of the alternatives.
template <class... Kinds>
inline constexpr std::array<std::string_view, sizeof...(Kinds)> names<std::variant<Kinds...>>{
    fields<Kinds>.type...};

}  // namespace boule
