#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/scene/field.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// Finds the materials and groups that a table names.
class TomlNames {
 public:
  virtual std::uint32_t material_of(TomlTable& table) = 0;
  /// The same in the colour that the table names, if it names one.
  virtual MaterialRef colored_material_of(TomlTable& table) = 0;
  virtual std::uint32_t group_of(TomlTable& table) = 0;

 protected:
  ~TomlNames() = default;
};

/// Reads the fields of structs from one table, each under its key, in the order of their list. A
/// key that is absent leaves its member as it is.
class TomlFields {
 public:
  /// `table` and `names` must outlive it. Only structs that refer to materials or groups need
  /// names.
  explicit TomlFields(TomlTable& table, TomlNames* names = nullptr)
      : table_(table), names_(names) {}

  /// Leaves out what stands in other files and what has other forms: the caller reads these.
  template <HasFields T>
  void read(T& value) {
    each_field(value, [this](const auto& field, auto&& member) {
      if (!field.has_other_forms) this->read(field.key, field.rule, member);
    });
  }

 private:
  template <class Rule, class T>
  void read(std::string_view key, const Rule&, T& member) {
    table_.read(key, member);
  }
  template <class Rule, class T>
  void read(std::string_view key, const Rule& rule, std::optional<T>& member) {
    if (table_.has(key)) read(key, rule, member.emplace());
  }
  void read(std::string_view key, const PointRule&, Vec3f& point) { table_.read_point(key, point); }
  void read(std::string_view key, const WholeRule&, Both<int>& both) {
    table_.read(key, both.first, both.second);
  }
  template <HasFields T>
  void read(std::string_view, const TypeRule&, T& part) {
    read(part);
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void read(std::string_view key, const TypeRule&, Enum& member) {
    static_assert(names_every_enumerator<Enum>, "an enumerator has no name");
    if (table_.has(key)) member = static_cast<Enum>(table_.choose(key, names<Enum>));
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void read(std::string_view key, const TypeRule&, std::vector<Enum>& members) {
    static_assert(names_every_enumerator<Enum>, "an enumerator has no name");
    for (const std::size_t index : table_.choose_some(key, names<Enum>))
      members.push_back(static_cast<Enum>(index));
  }
  void read(std::string_view, const MaterialRule&, std::uint32_t& member) {
    member = names_->material_of(table_);
  }
  void read(std::string_view, const MaterialRule&, MaterialRef& member) {
    member = names_->colored_material_of(table_);
  }
  void read(std::string_view, const GroupRule&, std::uint32_t& member) {
    member = names_->group_of(table_);
  }
  template <class T>
  void read(std::string_view, const FileRule&, T&) {}

  TomlTable& table_;
  TomlNames* names_;
};

/// A struct whose every field stands in the table.
template <HasFields T>
void read_fields(TomlTable& table, T& value) {
  TomlFields(table).read(value);
}

/// The kind that a table's `type` names, with the fields of that kind read; its default kind where
/// there is no `type`. `read(table, kind)` reads the fields.
template <class Variant, class Read>
Variant read_kind(TomlTable& table, const Read& read) {
  Variant value;
  const std::size_t index = table.choose("type", names<Variant>);
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (static_cast<void>(index == i && (value.template emplace<i>(), true)), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
  std::visit([&](auto& kind) { read(table, kind); }, value);
  return value;
}

}  // namespace boule
