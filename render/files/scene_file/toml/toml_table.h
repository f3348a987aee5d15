#pragma once

#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/color.h"
#include "core/math/vec.h"
#include "core/scene/primitive.h"
#include "render/files/scene_file/loaded/first_error.h"
#include "render/files/scene_file/toml/toml_document.h"

namespace boule {

/// Reads one table key by key. A key that is absent leaves its variable as it is; a wrong value is
/// reported with its place and dotted path. Every key that is asked for becomes known, and finish()
/// refuses all others: the known keys are those that the code reads for the table's `type`.
class TomlTable {
 public:
  /// `members` and `error` must outlive it; `path` is the table's own ("camera", "sphere[3]").
  TomlTable(const TomlMembers& members, TextPlace place, std::string path, FirstError& error);

  /// True if the table has no keys at all.
  [[nodiscard]] bool is_empty() const { return members_->empty(); }

  /// All of its keys, in the order of the file.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// True if the table has `key`, which becomes known.
  bool has(std::string_view key) { return find(key) != nullptr; }

  /// True if `key` has an array, a text, or a table.
  bool has_array(std::string_view key) { return holds<TomlArray>(key); }
  bool has_text(std::string_view key) { return holds<std::string>(key); }
  bool has_table(std::string_view key) { return holds<TomlMembers>(key); }

  /// One number, integer or not, rounded to float once; too large for a float is an error.
  void read(std::string_view key, float& out);
  /// One number, as it is.
  void read(std::string_view key, double& out);
  /// `true` or `false`.
  void read(std::string_view key, bool& out);
  /// One integer of 32 bits.
  void read(std::string_view key, int& out);
  /// Two integers of 32 bits, as an array.
  void read(std::string_view key, int& first, int& second);
  /// Three integers of 32 bits, as an array.
  void read(std::string_view key, std::array<int, 3>& out);
  /// Two or three numbers, as an array.
  void read(std::string_view key, std::array<double, 2>& out);
  void read(std::string_view key, Vec3f& out);
  void read(std::string_view key, Vec3d& out);
  /// A point: three numbers, from which the origin is subtracted before they are rounded. That of a
  /// key that is absent, too: `out` holds its default.
  void read_point(std::string_view key, Vec3f& out);
  /// Three linear numbers, or a text that parse_color() takes. A "color" of three numbers that look
  /// like codes up to 255 gets a note.
  void read(std::string_view key, Color& out);
  void read(std::string_view key, std::string& out);
  /// Texts, as an array.
  void read(std::string_view key, std::vector<std::string>& out);
  /// A file's name, with the number of the frame that is read put in, if any (frame_name()).
  void read_file_name(std::string_view key, std::string& name);

  /// The index in `names` of the name under `key`; 0 if it is absent.
  std::size_t choose(std::string_view key, std::span<const std::string_view> names);
  /// The same for an array of names; none if it is absent.
  std::vector<std::size_t> choose_some(std::string_view key,
                                       std::span<const std::string_view> names);

  /// The table under `key`, or nothing.
  std::optional<TomlTable> table(std::string_view key);
  /// The tables of the array under `key` ([[key]]), in order.
  std::vector<TomlTable> tables(std::string_view key);
  /// The tables inside the table under `key` ([key.NAME]), in the order of the file.
  std::vector<TomlTable> named_tables(std::string_view key);

  /// Refuses the keys that were not asked for, then the absence of a required one.
  void finish(std::initializer_list<std::string_view> required = {});

  /// The table's origin, which must outlive the table and may change until points are read; null:
  /// none. Tables inside have that of the table around them.
  void set_origin(const Vec3d* origin) { origin_ = origin; }
  [[nodiscard]] Vec3d origin() const { return origin_ != nullptr ? *origin_ : Vec3d{}; }

  /// Reports a Problem of what was read from this table, at its field.
  void check(const std::optional<Problem>& problem);

  /// Reports an error of `key`: at its value, or at the table where it is absent.
  void report(std::string_view key, std::string message);
  /// The same, at another place.
  void report_at(TextPlace place, std::string_view key, std::string message);
  /// Reports an error of another file.
  void report(const Diagnostic& error) { error_->report(error); }

  /// Keeps a note for the user about `key`.
  void note(std::string_view key, const std::string& text);

  /// What the file may name besides files, or null.
  [[nodiscard]] const SceneData* data() const { return error_->data(); }
  /// True if nothing was reported about the file so far.
  [[nodiscard]] bool ok() const { return error_->status().ok(); }
  /// The path of a file name in this table, which is relative to the scene file. It becomes one of
  /// the scene's data files.
  [[nodiscard]] std::string file_path(const std::string& name);
  /// The same path alone.
  [[nodiscard]] std::string beside_scene(const std::string& name) const;

  /// Where the table begins, and where the value under `key` does (the table, if it is absent).
  [[nodiscard]] TextPlace place() const { return place_; }
  [[nodiscard]] TextPlace place_of(std::string_view key) const;
  /// Its dotted path in the file: "sphere[3]", "group.bunny.particles[0]".
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Its name in the table around it: "red" for [material.red]; else "".
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  const TomlValue* find(std::string_view key);
  [[nodiscard]] TomlTable inner(const TomlMembers& members, TextPlace place,
                                std::string path) const;
  [[nodiscard]] std::string path_of(std::string_view key) const;
  std::size_t index_of(std::string_view key, const std::string& name,
                       std::span<const std::string_view> names);
  template <class Value>
  bool holds(std::string_view key) {
    const TomlValue* value = find(key);
    return value != nullptr && std::holds_alternative<Value>(value->data);
  }
  template <class Number>
  void read_array(std::string_view key, const char* of_what, std::initializer_list<Number*> out);
  void report_type(const TomlValue& value, std::string_view key, const std::string& expected);
  const TomlArray* find_array(std::string_view key, std::size_t count, const char* of_what);
  void convert(const TomlValue& value, std::string_view key, float& out);
  void convert(const TomlValue& value, std::string_view key, double& out);
  void convert(const TomlValue& value, std::string_view key, int& out);

  const TomlMembers* members_;
  TextPlace place_;
  std::string path_;
  std::string name_;
  FirstError* error_;
  const Vec3d* origin_ = nullptr;
  std::vector<std::string_view> known_;
};

}  // namespace boule
