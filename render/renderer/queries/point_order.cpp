#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/scene/number_text.h"
#include "render/renderer/queries/point_order.h"
#include "simd/points/point_distance.h"

namespace boule {
namespace {

/// Cells along each axis: 2^cell_bits.
constexpr unsigned cell_bits = 5;
constexpr std::size_t cells = std::size_t{1} << (3 * cell_bits);

/// Bits of a number below 2^cell_bits, two zeros behind each.
std::uint32_t spread_bits(std::uint32_t x) {
  std::uint32_t spread = 0;
  for (unsigned bit = 0; bit < cell_bits; ++bit) spread |= (x >> bit & 1) << (3 * bit);
  return spread;
}

/// Cuts a range into cells; a cell's number is that of a curve that keeps neighbours together.
class Axis {
 public:
  void add(double x) {
    low_ = std::min(low_, x);
    high_ = std::max(high_, x);
  }
  void cut() {
    constexpr double most = (1U << cell_bits) * (1 - 0x1p-30);
    scale_ = high_ > low_ ? most / (high_ - low_) : 0;
    for (std::uint32_t cell = 0; cell < spread_.size(); ++cell) spread_[cell] = spread_bits(cell);
  }
  [[nodiscard]] std::uint32_t cell(double x) const {
    const auto cell = static_cast<std::size_t>((x - low_) * scale_);
    return spread_[std::min(cell, spread_.size() - 1)];
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  double scale_ = 0;
  std::array<std::uint32_t, 1U << cell_bits> spread_{};
};

}  // namespace

Status check_points(const PointColumns& points, std::uint64_t first_row) {
  const auto is_good = [](double x) { return std::fabs(x) <= most_point_coordinate; };
  for (std::size_t row = 0; row < points.size(); ++row) {
    const Vec3d point = points.at(row);
    for (const double x : {point.x, point.y, point.z}) {
      if (is_good(x)) continue;
      return Diagnostic::about("points", "row " + std::to_string(first_row + row) +
                                             ": must be finite and at most 1e150 in size, is " +
                                             number_text(x));
    }
  }
  return {};
}

void PointOrder::make(const PointColumns& points, std::size_t first, std::size_t count) {
  rows.resize(count);
  constexpr std::size_t fewest = 4096;
  if (count < fewest) {
    std::iota(rows.begin(), rows.end(), 0U);
    return;
  }
  Axis x, y, z;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3d point = points.at(first + k);
    x.add(point.x);
    y.add(point.y);
    z.add(point.z);
  }
  for (Axis* axis : {&x, &y, &z}) axis->cut();
  cells_.resize(count);
  ends_.assign(cells + 1, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3d point = points.at(first + k);
    cells_[k] = x.cell(point.x) | y.cell(point.y) << 1 | z.cell(point.z) << 2;
    ++ends_[cells_[k] + 1];
  }
  std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
  for (std::size_t k = 0; k < count; ++k) rows[ends_[cells_[k]]++] = static_cast<std::uint32_t>(k);
}

}  // namespace boule
