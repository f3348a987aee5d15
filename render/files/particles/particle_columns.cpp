#include "render/files/particles/particle_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "render/files/file/nearest_name.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

/// The norm; the sum of squares is used where it neither overflows nor loses digits.
double norm(double x, double y, double z) {
  const double sum = x * x + y * y + z * z;
  if (sum > 1e-280 && sum < 1e300) return std::sqrt(sum);
  const double largest = std::max({std::fabs(x), std::fabs(y), std::fabs(z)});
  if (largest == 0) return 0;
  const double a = x / largest, b = y / largest, c = z / largest;
  return std::min(largest * std::sqrt(a * a + b * b + c * c), std::numeric_limits<double>::max());
}

std::string axis_name(std::string_view vector, std::string_view separator, std::string_view axis) {
  return std::string(vector) + std::string(separator) + std::string(axis);
}

std::optional<ParticleNumbers> find_norm(const ParticleFrame& frame, std::string_view name) {
  for (const std::string_view separator : {"", "_"}) {
    std::array<const double*, 3> columns{};
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const NumberColumn* const column =
          find_number_column(frame, axis_name(name, separator, axis_names[axis]));
      if (column == nullptr) break;
      columns[axis] = column->values.data();
      ++found;
    }
    if (found == 3) return ParticleNumbers(columns);
  }
  return std::nullopt;
}

ParticleNumbers axis_of(const std::vector<Vec3d>& positions, std::ptrdiff_t axis) {
  constexpr std::array members{&Vec3d::x, &Vec3d::y, &Vec3d::z};
  return {&(positions.front().*members[static_cast<std::size_t>(axis)]), 3};
}

/// The texts as numbers; nothing if one of them is none.
std::optional<std::vector<double>> numbers_of(const std::vector<std::string>& texts) {
  std::vector<double> values;
  for (const std::string& text : texts) {
    const auto value = number_in(text);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string_view> column_names(const ParticleFrame& frame) {
  std::vector<std::string_view> names(axis_names.begin(), axis_names.end());
  for (const NumberColumn& column : frame.numbers) names.push_back(column.name);
  for (const TextColumn& column : frame.texts) names.push_back(column.name);
  if (frame.species) names.push_back(frame.species->name);
  for (const std::string& name : frame.unread) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace

void ParticleNumbers::read(std::size_t begin, std::size_t end, double* numbers) const {
  if (indices_ != nullptr) {
    for (std::size_t i = begin; i < end; ++i) *numbers++ = values_[indices_[i]];
  } else if (first_[1] != nullptr) {
    const auto [x, y, z] = first_;
    for (std::size_t i = begin; i < end; ++i) *numbers++ = norm(x[i], y[i], z[i]);
  } else if (first_[0] != nullptr) {
    for (std::size_t i = begin; i < end; ++i) *numbers++ = first_[0][i * stride_];
  } else {
    std::fill(numbers, numbers + (end - begin), constant_);
  }
}

double ParticleNumbers::at(std::size_t particle) const {
  double number = 0;
  read(particle, particle + 1, &number);
  return number;
}

Result<ParticleNumbers> find_particle_numbers(const ParticleFrame& frame, const std::string& name,
                                              const std::string& key) {
  if (const NumberColumn* const column = find_number_column(frame, name)) {
    return ParticleNumbers(column->values.data(), 1);
  }
  if (const std::string_view vector = norm_name(name); !vector.empty()) {
    if (auto found = find_norm(frame, vector)) return *std::move(found);
    const std::string safe = printable(vector, 40);
    return Diagnostic::about(key, "there are no columns of numbers '" + safe + "x', '" + safe +
                                      "y' and '" + safe + "z'");
  }
  const TextColumn* const texts = find_particle_texts(frame, name);
  if (texts == nullptr) {
    const auto axis = std::find(axis_names.begin(), axis_names.end(), name);
    if (axis == axis_names.end()) return no_such_column(frame, name, key);
    return frame.positions.empty() ? ParticleNumbers(0)
                                   : axis_of(frame.positions, axis - axis_names.begin());
  }
  if (auto values = numbers_of(texts->texts)) return ParticleNumbers(*texts, *std::move(values));
  return Diagnostic::about(key, "the column " + quote(name) + " is of texts, expected numbers");
}

const TextColumn* find_particle_texts(const ParticleFrame& frame, const std::string& name) {
  if (const TextColumn* const column = find_text_column(frame, name)) return column;
  if (!frame.species) return nullptr;
  const bool is_species = name == frame.species->name || name == "species" || name == "element";
  return is_species ? &*frame.species : nullptr;
}

Diagnostic no_such_column(const ParticleFrame& frame, const std::string& name,
                          const std::string& key) {
  constexpr std::size_t most_listed = 20;
  std::vector<std::string_view> names = column_names(frame);
  std::string message = "there is no column " + quote(name);
  const std::string meant = did_you_mean(name, names);
  if (!meant.empty()) return Diagnostic::about(key, message + meant);
  const bool all = names.size() <= most_listed;
  if (!all) names.resize(most_listed);
  message += ", expected " + list_names(names);
  return Diagnostic::about(key, all ? message : message + " ...");
}

std::string_view norm_name(std::string_view text) {
  if (text.size() < 3 || text.front() != '|' || text.back() != '|') return {};
  return text.substr(1, text.size() - 2);
}

void add_column_names(const std::string& name, std::vector<std::string>& names) {
  const std::string_view vector = norm_name(name);
  if (vector.empty()) {
    names.push_back(name);
    return;
  }
  for (const std::string_view separator : {"", "_"}) {
    for (const std::string_view axis : axis_names) {
      names.push_back(axis_name(vector, separator, axis));
    }
  }
}

std::string particle_text(std::size_t particle, std::size_t count,
                          const std::optional<ParticleFrame::Part>& part) {
  if (part) {
    particle += static_cast<std::size_t>(part->before);
    count = static_cast<std::size_t>(part->all);
  }
  return "particle " + std::to_string(particle + 1) + " of " + std::to_string(count);
}

}  // namespace boule
