#include "render/frame/pixel_order.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/math/random.h"

namespace boule {
namespace {

/// A grid of cells.
struct Grid {
  std::size_t columns, rows;

  [[nodiscard]] std::size_t size() const { return columns * rows; }
};

/// Adds the cells of a square with this upper left corner that lie in the grid, along the Morton
/// curve: its four quarters in turn. `side` is a power of two.
template <class Cell>
void add_along_curve(const Grid& grid, std::size_t x, std::size_t y, std::size_t side,
                     std::vector<Cell>& cells) {
  if (x >= grid.columns || y >= grid.rows) return;
  if (side == 1) {
    cells.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    return;
  }
  const std::size_t half = side / 2;
  for (const std::size_t down : {std::size_t{0}, half}) {
    add_along_curve(grid, x, y + down, half, cells);
    add_along_curve(grid, x + half, y + down, half, cells);
  }
}

template <class Cell>
void add_in_rows(const Grid& grid, std::vector<Cell>& cells) {
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) {
      cells.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    }
  }
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
std::vector<Cell> cells_of(const Grid& grid, PixelOrder order) {
  const auto coarse_first = [](const Cell& a, const Cell& b) {
    return coarseness(a) > coarseness(b);
  };
  std::vector<Cell> cells;
  cells.reserve(grid.size());
  if (order == PixelOrder::tiles) {
    add_along_curve(grid, 0, 0, std::bit_ceil(std::max(grid.columns, grid.rows)), cells);
  } else {
    add_in_rows(grid, cells);
  }
  if (order == PixelOrder::progressive) std::stable_sort(cells.begin(), cells.end(), coarse_first);
  if (order == PixelOrder::frameless) shuffle(cells);
  return cells;
}

}  // namespace

BlockOrder::BlockOrder(const PixelRect& rect, int tile, PixelOrder order)
    : rect_(rect), tile_(legal(tile)) {
  if (rect.empty()) return;
  blocks_ =
      cells_of<Block>({tiles_along(rect.width(), tile_), tiles_along(rect.height(), tile_)}, order);
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
  const auto side = static_cast<std::size_t>(legal(tile));
  return cells_of<PixelOffset>({side, side}, PixelOrder::tiles);
}

}  // namespace boule
