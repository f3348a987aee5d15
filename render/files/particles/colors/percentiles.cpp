#include "render/files/particles/colors/percentiles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/chunks.h"

namespace boule {
namespace {

constexpr std::size_t bins = 4096;
constexpr std::size_t binning_block = 2048;

/// Calls body(number) for each number of begin .. end - 1 that is not missing.
template <class Body>
void for_numbers(const ParticleNumbers& numbers, std::size_t begin, std::size_t end,
                 const Body& body) {
  std::array<double, binning_block> block;
  for (; begin < end; begin += binning_block) {
    const std::size_t stop = std::min(begin + binning_block, end);
    numbers.read(begin, stop, block.data());
    std::for_each_n(block.begin(), stop - begin, [&](double number) {
      if (!std::isnan(number)) body(number);
    });
  }
}

struct ValueRange {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();
};

ValueRange range_of(const ParticleNumbers& numbers, std::size_t count,
                    const ParallelFor& parallel_for) {
  std::vector<ValueRange> ranges(chunks_of(count));
  in_chunks(parallel_for, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    ValueRange range;
    for_numbers(numbers, begin, end, [&](double number) {
      range.least = std::min(range.least, number);
      range.largest = std::max(range.largest, number);
    });
    ranges[chunk] = range;
  });
  ValueRange all;
  for (const ValueRange& range : ranges) {
    all.least = std::min(all.least, range.least);
    all.largest = std::max(all.largest, range.largest);
  }
  return all;
}

/// Bins of the same width between the least and the largest number. A larger number is in the same
/// bin or a later one, however this rounds.
class Binning {
 public:
  explicit Binning(const ValueRange& range)
      : half_least_(range.least / 2),
        bins_per_half_(static_cast<double>(bins) / (range.largest / 2 - half_least_)) {}

  [[nodiscard]] std::size_t bin(double number) const {
    const double part = (number / 2 - half_least_) * bins_per_half_;
    return part > 0 ? std::min(static_cast<std::size_t>(std::min(part, 1e9)), bins - 1) : 0;
  }

 private:
  double half_least_, bins_per_half_;
};

using Counts = std::array<std::uint64_t, bins>;

Counts count_bins(const ParticleNumbers& numbers, std::size_t count, const Binning& binning,
                  const ParallelFor& parallel_for) {
  // A few long pieces: each has counts of its own.
  constexpr std::size_t most_pieces = 64;
  const std::size_t chunks = chunks_of(count), pieces = std::min(chunks, most_pieces);
  std::vector<Counts> found(pieces);
  parallel_for(pieces, [&](std::size_t piece) {
    const FloatEnvironment environment;
    const std::size_t begin = piece * chunks / pieces * chunk_size;
    const std::size_t end = std::min((piece + 1) * chunks / pieces * chunk_size, count);
    for_numbers(numbers, begin, end, [&](double number) { ++found[piece][binning.bin(number)]; });
  });
  Counts all{};
  for (const Counts& part : found) {
    for (std::size_t i = 0; i < bins; ++i) all[i] += part[i];
  }
  return all;
}

/// A place in the order of the numbers of a bin.
struct Place {
  std::size_t bin = 0, rank = 0;
};

Place place_of(std::size_t rank, const Counts& counts) {
  std::size_t bin = 0;
  for (; rank >= counts[bin]; ++bin) rank -= counts[bin];
  return {bin, rank};
}

/// The numbers of the two bins, in no order that matters.
std::array<std::vector<double>, 2> numbers_in(const std::array<Place, 2>& places,
                                              const ParticleNumbers& numbers, std::size_t count,
                                              const Binning& binning, const Counts& counts,
                                              const ParallelFor& parallel_for) {
  std::vector<std::array<std::vector<double>, 2>> found(chunks_of(count));
  in_chunks(parallel_for, count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for_numbers(numbers, begin, end, [&](double number) {
      const std::size_t bin = binning.bin(number);
      if (bin == places[0].bin) found[chunk][0].push_back(number);
      if (bin == places[1].bin) found[chunk][1].push_back(number);
    });
  });
  std::array<std::vector<double>, 2> all;
  for (std::size_t k = 0; k < 2; ++k) {
    all[k].reserve(counts[places[k].bin]);
    for (auto& part : found) {
      all[k].insert(all[k].end(), part[k].begin(), part[k].end());
      part[k] = {};
    }
  }
  return all;
}

}  // namespace

std::array<double, 2> percentiles(const ParticleNumbers& numbers, std::size_t count,
                                  const ParallelFor& parallel_for) {
  const ValueRange range = range_of(numbers, count, parallel_for);
  if (!(range.least < range.largest)) return {range.least, range.largest};
  const Binning binning(range);
  const Counts counts = count_bins(numbers, count, binning, parallel_for);
  const std::size_t last =
      std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) - 1;  // those that are there
  const std::size_t low = last / 100;
  const std::array<Place, 2> places{place_of(low, counts), place_of(last - low, counts)};
  auto in_bins = numbers_in(places, numbers, count, binning, counts, parallel_for);
  std::array<double, 2> found{};
  parallel_for(found.size(), [&](std::size_t k) {
    const auto at = in_bins[k].begin() + static_cast<std::ptrdiff_t>(places[k].rank);
    std::nth_element(in_bins[k].begin(), at, in_bins[k].end());
    found[k] = *at;
  });
  return found;
}

}  // namespace boule
