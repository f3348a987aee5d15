#include "render/frame/bands.h"

#include <algorithm>

namespace boule {
namespace {

constexpr std::uint64_t ceil_div(std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; }

}  // namespace

Bands::Bands(const PixelRect& rect, int tile, unsigned workers, std::size_t pixel_bytes)
    : rect_(rect), tile_(tile) {
  constexpr std::uint64_t blocks_per_worker = 4;
  constexpr std::size_t least_in_memory = 2, most_in_memory = 4;
  const auto height = static_cast<std::uint64_t>(rect.height());
  const auto side = static_cast<std::uint64_t>(tile);
  row_bytes_ = static_cast<std::uint64_t>(rect.width()) * pixel_bytes;
  const std::uint64_t columns = ceil_div(static_cast<std::uint64_t>(rect.width()), side);
  const std::uint64_t wanted = ceil_div(blocks_per_worker * workers, columns) * side;
  std::uint64_t most = std::max<std::uint64_t>(most_bytes / (least_in_memory * row_bytes_), 1);
  if (most > side) most -= most % side;
  rows_ = std::min({wanted, most, height});
  size_ = static_cast<std::size_t>(ceil_div(height, rows_));
  const auto fitting = static_cast<std::size_t>(most_bytes / (rows_ * row_bytes_));
  in_memory_ = std::min(std::clamp(fitting, least_in_memory, most_in_memory), size_);
}

PixelRect Bands::operator[](std::size_t band) const {
  const int first = rect_.y0 + static_cast<int>(band * rows_);
  return {rect_.x0, first, rect_.x1, std::min(first + static_cast<int>(rows_), rect_.y1)};
}

std::size_t Bands::blocks_in(std::size_t band) const {
  const auto side = static_cast<std::uint64_t>(tile_);
  const PixelRect rect = (*this)[band];
  return static_cast<std::size_t>(ceil_div(static_cast<std::uint64_t>(rect.width()), side) *
                                  ceil_div(static_cast<std::uint64_t>(rect.height()), side));
}

std::size_t Bands::blocks() const { return (size_ - 1) * blocks_in(0) + blocks_in(size_ - 1); }

PixelRect Bands::block(std::size_t block) const {
  const PixelRect band = (*this)[band_of(block)];
  const auto columns =
      ceil_div(static_cast<std::uint64_t>(rect_.width()), static_cast<std::uint64_t>(tile_));
  const std::uint64_t in_band = block % blocks_in(0);
  const int x = band.x0 + static_cast<int>(in_band % columns) * tile_;
  const int y = band.y0 + static_cast<int>(in_band / columns) * tile_;
  return {x, y, std::min(x + tile_, band.x1), std::min(y + tile_, band.y1)};
}

}  // namespace boule
