#include "render/frame/pixel_order.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/math/random.h"

namespace boule {
namespace {

/// The 16 bits of x, each followed by a 0.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

/// The index along the Morton curve: the bits of x and y in turn, that of x lowest.
template <class Cell>
std::uint32_t morton_code(const Cell& cell) {
  return spread(cell.x) | spread(cell.y) << 1;
}

/// The largest k such that the cell lies on the grid of spacing 2^k; 16 for cell (0, 0).
template <class Cell>
int coarseness(const Cell& cell) {
  return std::countr_zero(static_cast<unsigned>(cell.x | cell.y) | 0x10000u);
}

int legal(int tile) { return std::clamp(tile, 1, max_tile); }

/// The number of tiles that cover so many pixels; `tile` is legal.
std::size_t tiles_along(int pixels, int tile) {
  return static_cast<std::size_t>((pixels + tile - 1) / tile);
}

/// The shuffle of Fisher and Yates, the same on every machine.
template <class Cell>
void shuffle(std::vector<Cell>& cells) {
  for (std::size_t i = cells.size(); i > 1; --i) {
    const auto words = philox({static_cast<std::uint32_t>(i), 0, 0, 0}, {0x626f756cu, 0x65u});
    const std::uint64_t pick = (std::uint64_t{words[0]} * i) >> 32;
    std::swap(cells[i - 1], cells[static_cast<std::size_t>(pick)]);
  }
}

template <class Cell>
void put_in_order(std::vector<Cell>& cells, PixelOrder order) {
  const auto along_curve = [](const Cell& a, const Cell& b) {
    return morton_code(a) < morton_code(b);
  };
  const auto coarse_first = [](const Cell& a, const Cell& b) {
    return coarseness(a) > coarseness(b);
  };
  switch (order) {
    case PixelOrder::rows:
      break;
    case PixelOrder::tiles:
      std::sort(cells.begin(), cells.end(), along_curve);
      break;
    case PixelOrder::progressive:
      std::stable_sort(cells.begin(), cells.end(), coarse_first);
      break;
    case PixelOrder::frameless:
      shuffle(cells);
      break;
  }
}

}  // namespace

BlockOrder::BlockOrder(const PixelRect& rect, int tile, PixelOrder order)
    : rect_(rect), tile_(legal(tile)) {
  if (rect.empty()) return;
  const std::size_t columns = tiles_along(rect.width(), tile_);
  const std::size_t rows = tiles_along(rect.height(), tile_);
  blocks_.reserve(columns * rows);
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      blocks_.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    }
  }
  put_in_order(blocks_, order);
}

PixelRect BlockOrder::operator[](std::size_t i) const {
  const int x = rect_.x0 + blocks_[i].x * tile_, y = rect_.y0 + blocks_[i].y * tile_;
  return {x, y, std::min(x + tile_, rect_.x1), std::min(y + tile_, rect_.y1)};
}

std::uint64_t BlockOrder::bytes(const PixelRect& rect, int tile) {
  if (rect.empty()) return 0;
  return std::uint64_t{tiles_along(rect.width(), legal(tile))} *
         tiles_along(rect.height(), legal(tile)) * sizeof(Block);
}

std::vector<PixelOffset> block_pixels(int tile) {
  const int side = legal(tile);
  std::vector<PixelOffset> pixels;
  pixels.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    }
  }
  put_in_order(pixels, PixelOrder::tiles);
  return pixels;
}

}  // namespace boule
