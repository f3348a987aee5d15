#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {

/// Columns that are known by their names: "x", "y", "z" are the position, "element", "species" or
/// "atomic_number" the species, "-" is skipped, and all others are kept under their names.
class NamedColumns {
 public:
  /// `wanted` as in ParticleFileOptions; `frame` gets the columns.
  NamedColumns(const std::optional<std::vector<std::string>>& wanted, ParticleFrame& frame)
      : wanted_(wanted), frame_(frame) {}

  /// Adds a column. What `example`, its text in the first row, is decides whether it is of numbers;
  /// what nobody wants is skipped, but for "id" and "type".
  void add(const std::string& name, std::string_view example);
  /// The same for the i-th column of a format whose ids are numbers, by the words of the first row.
  void add(const std::string& name, std::span<const std::string_view> words, std::size_t i) {
    const bool is_number = name == "id" || i >= words.size();
    add(name, is_number ? std::string_view("0") : words[i]);
  }
  void add_position(const std::string& name, std::size_t axis);
  void add_species(const std::string& name);
  void add_kept(const std::string& name, ColumnUse use);  ///< number, logical or text
  void add_skipped(const std::string& name) { columns_.push_back({name, ColumnUse::skipped, 0}); }

  /// What is to be done when the rows are read: makes atomic numbers elements, takes types as
  /// species, and drops what was read for such ends only.
  void finish();

  /// True if a column of this name is to be kept.
  [[nodiscard]] bool wants(const std::string& name) const;

  /// Nothing if there is exactly one column for each axis; else a message.
  [[nodiscard]] Status check_positions() const;

  [[nodiscard]] std::span<const TextRowColumn> columns() const { return columns_; }

 private:
  const std::optional<std::vector<std::string>>& wanted_;
  ParticleFrame& frame_;
  std::vector<TextRowColumn> columns_;
};

/// True for the names under which atomic numbers stand: "element", "atomic_numbers", ...
bool is_atomic_number_name(std::string_view name);

/// Makes atomic numbers, all of them whole and from 0 (which is "X") to 118, symbols of elements.
/// False, and nothing changes, for other texts.
bool take_atomic_numbers(TextColumn& species);

/// The shortest texts of numbers: 1 is "1". What is missing is "".
TextColumn texts_of(const NumberColumn& numbers);

/// A name that stands twice among names of columns, if one does; "" and "-" may.
std::optional<std::string> find_repeated(std::vector<std::string> names);

/// Makes the column "type" the species where there is none: numbers become texts. With `keep`, the
/// column stays as it is too. To be called when the columns are read.
void take_types_as_species(ParticleFrame& frame, bool keep);

}  // namespace boule
