#include "render/files/particle_file/lammps/id_order.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/number_text.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

constexpr std::size_t no_row = std::numeric_limits<std::size_t>::max();

Diagnostic id_twice(double id, std::size_t first, std::size_t second, std::uint64_t first_line) {
  const auto [earlier, later] = std::minmax(first, second);
  const std::string text = std::isfinite(id) && std::fabs(id) < 1e15
                               ? std::to_string(static_cast<long long>(id))
                               : number_text(id);
  const std::string other = first_line > 0 ? "line " + std::to_string(first_line + earlier)
                                           : "particle " + std::to_string(earlier + 1);
  return error_at_row(first_line, later, "the id " + text + " is that of " + other + " too", "id");
}

bool is_whole(double id) { return std::trunc(id) == id; }

/// The rows in the order of their ids, which are whole: by a table of all ids, if they lie as close
/// as usual.
Result<std::vector<std::size_t>> order_of_close(const std::vector<double>& ids, double least,
                                                std::size_t range, std::uint64_t first_line) {
  std::vector<std::size_t> rows(range, no_row);
  for (std::size_t row = 0; row < ids.size(); ++row) {
    std::size_t& place = rows[static_cast<std::size_t>(ids[row] - least)];
    if (place != no_row) return id_twice(ids[row], place, row, first_line);
    place = row;
  }
  rows.erase(std::remove(rows.begin(), rows.end(), no_row), rows.end());
  return rows;
}

Result<std::vector<std::size_t>> order_of(const std::vector<double>& ids,
                                          std::uint64_t first_line) {
  const auto [least, most] = std::minmax_element(ids.begin(), ids.end());
  if (*most - *least < 4 * static_cast<double>(ids.size())) {
    return order_of_close(ids, *least, static_cast<std::size_t>(*most - *least) + 1, first_line);
  }
  std::vector<std::size_t> rows(ids.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    return ids[a] < ids[b] || (ids[a] == ids[b] && a < b);
  });
  const auto twice = std::adjacent_find(
      rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return ids[a] == ids[b]; });
  if (twice != rows.end()) return id_twice(ids[*twice], *twice, *(twice + 1), first_line);
  return rows;
}

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::size_t>& rows) {
  if (values.empty()) return;  // velocities come without positions
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::size_t row : rows) sorted.push_back(values[row]);
  values = std::move(sorted);
}

}  // namespace

Diagnostic error_at_row(std::uint64_t first_line, std::uint64_t row, std::string message,
                        std::string key) {
  if (first_line > 0) return error_at_line(first_line + row, std::move(message), std::move(key));
  return Diagnostic::about(std::move(key),
                           "particle " + std::to_string(row + 1) + ": " + std::move(message));
}

Status sort_by_id(ParticleFrame& frame, std::uint64_t first_line, const ParallelFor& parallel_for) {
  const NumberColumn* const column = find_number_column(frame, "id");
  if (column == nullptr || column->values.empty()) return {};
  const std::vector<double>& ids = column->values;
  const auto broken = std::find_if(ids.begin(), ids.end(), [](double id) { return !is_whole(id); });
  if (broken != ids.end()) {
    return error_at_row(first_line, static_cast<std::uint64_t>(broken - ids.begin()),
                        "the id " + number_text(*broken) + " is no whole number", "id");
  }
  // The last comparison is false for equal ids.
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end()) {
    return {};
  }
  // A table of at most 4 numbers each, and a copy of the longest list for each thread.
  if (auto done = check_memory(ids.size() * 64, "to sort its particles, it needs"); !done) {
    return done;
  }
  const auto order = order_of(ids, first_line);
  if (!order) return order.error();
  const std::vector<std::size_t>& rows = order.value();
  std::vector<std::function<void()>> lists{[&] { reorder(frame.positions, rows); }};
  for (NumberColumn& numbers : frame.numbers) {
    lists.emplace_back([&] { reorder(numbers.values, rows); });
  }
  for (TextColumn& texts : frame.texts) lists.emplace_back([&] { reorder(texts.indices, rows); });
  if (frame.species) lists.emplace_back([&] { reorder(frame.species->indices, rows); });
  parallel_for(lists.size(), [&](std::size_t i) { lists[i](); });
  return {};
}

}  // namespace boule
