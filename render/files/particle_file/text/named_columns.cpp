#include "render/files/particle_file/text/named_columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

std::string shortest_text(double value) {
  if (std::isnan(value)) return {};
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace

bool is_atomic_number_name(std::string_view name) {
  constexpr std::array names{"element", "symbol", "atomic_number", "atomic_numbers"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool take_atomic_numbers(TextColumn& species) {
  std::vector<std::string> symbols;
  for (const std::string& text : species.texts) {
    const auto number = count_in(text);
    if (!number || *number > last_element) return false;
    symbols.emplace_back(element_of_number(static_cast<std::size_t>(*number)));
  }
  species.texts = std::move(symbols);
  return true;
}

TextColumn texts_of(const NumberColumn& numbers) {
  TextColumn column{numbers.name, {}, {}};
  column.indices.reserve(numbers.values.size());
  std::unordered_map<double, std::uint32_t> known;
  double last = 0;
  std::uint32_t last_index = 0;
  for (const double value : numbers.values) {
    if (column.texts.empty() || value != last) {
      // No NaN is the same as another; infinity is no value of a column.
      const double key = std::isnan(value) ? HUGE_VAL : value;
      const auto [found, is_new] =
          known.try_emplace(key, static_cast<std::uint32_t>(column.texts.size()));
      if (is_new) column.texts.push_back(shortest_text(value));
      last = value;
      last_index = found->second;
    }
    column.indices.push_back(last_index);
  }
  return column;
}

void NamedColumns::add(const std::string& name, std::string_view example) {
  constexpr std::array axes{"x", "y", "z"};
  const auto axis = std::find(axes.begin(), axes.end(), name);
  if (axis != axes.end()) {
    add_position(name, static_cast<std::size_t>(axis - axes.begin()));
  } else if (name == "species" || (is_atomic_number_name(name) && name != "symbol")) {
    add_species(name);
  } else if (name == "-") {
    add_skipped(name);
  } else {
    add_kept(name, number_in(example) ? ColumnUse::number : ColumnUse::text);
  }
}

void NamedColumns::add_position(const std::string& name, std::size_t axis) {
  columns_.push_back({name, ColumnUse::position, axis});
}

void NamedColumns::add_species(const std::string& name) {
  if (frame_.species) return add_kept(name, ColumnUse::text);
  frame_.species.emplace().name = name;
  columns_.push_back({name, ColumnUse::species, 0});
}

void NamedColumns::add_kept(const std::string& name, ColumnUse use) {
  if (!wants(name)) frame_.unread.push_back(name);
  if (!wants(name) && name != "id" && name != "type") {
    add_skipped(name);
  } else if (use == ColumnUse::text) {
    columns_.push_back(add_text_column(frame_, name));
  } else {
    columns_.push_back(add_number_column(frame_, name, use));
  }
}

bool NamedColumns::wants(const std::string& name) const { return is_wanted(wanted_, name); }

Status NamedColumns::check_positions() const {
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found =
        std::count_if(columns_.begin(), columns_.end(), [&](const TextRowColumn& column) {
          return column.use == ColumnUse::position && column.index == axis;
        });
    const std::string name = axes[axis];
    if (found == 0) {
      return Diagnostic::about(
          name, "there is no column of positions for " + name + "; 'columns' can name it");
    }
    if (found > 1) return Diagnostic::about(name, "more than one column has the position " + name);
  }
  return {};
}

void NamedColumns::finish() {
  if (frame_.species && is_atomic_number_name(frame_.species->name)) {
    take_atomic_numbers(*frame_.species);
  }
  take_types_as_species(frame_, wants("type"));
  const auto is_unwanted = [this](const auto& column) { return !wants(column.name); };
  std::erase_if(frame_.texts, is_unwanted);
  std::erase_if(frame_.numbers, is_unwanted);
}

std::optional<std::string> find_repeated(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto found = std::adjacent_find(
      names.begin(), names.end(),
      [](const auto& a, const auto& b) { return a == b && !a.empty() && a != "-"; });
  return found == names.end() ? std::nullopt : std::optional(*found);
}

void take_types_as_species(ParticleFrame& frame, bool keep) {
  if (frame.species) return;
  const auto is_type = [](const auto& column) { return column.name == "type"; };
  const auto texts = std::find_if(frame.texts.begin(), frame.texts.end(), is_type);
  if (texts != frame.texts.end()) {
    frame.species = *texts;
    if (!keep) frame.texts.erase(texts);
    return;
  }
  const auto numbers = std::find_if(frame.numbers.begin(), frame.numbers.end(), is_type);
  if (numbers == frame.numbers.end()) return;
  frame.species = texts_of(*numbers);
  if (!keep) frame.numbers.erase(numbers);
}

}  // namespace boule
