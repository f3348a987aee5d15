#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/sobol.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/aligned_array.h"

namespace boule {

/// The random numbers of many samples at once: the pair of sobol_pair() for each. Precondition of
/// all functions but resize(): there is room.
class RandomNumbers {
 public:
  /// Makes room for `size` pairs.
  void resize(std::size_t size) {
    for (auto* numbers : {&sample_, &shuffle_, &seed_u_, &seed_v_}) numbers->resize(size);
    u_.resize(size);
    v_.resize(size);
  }

  /// Requests pair i, for a pixel's key, a set and a sample.
  void ask(std::size_t i, std::uint64_t key, RandomSet set, std::uint32_t sample) {
    if (key != key_ || set != set_) {  // samples of one pixel often follow each other
      key_ = key;
      set_ = set;
      seeds_ = sobol_seeds(key, set);
    }
    sample_[i] = sample;
    shuffle_[i] = seeds_.shuffle;
    seed_u_[i] = seeds_.u;
    seed_v_[i] = seeds_.v;
  }

  /// The arguments of a sample's numbers besides their set.
  struct Key {
    std::uint64_t pixel;
    std::uint32_t sample;
  };
  /// Requests the first `size` pairs, all of one set: pair i is that of key_of(i).
  template <class KeyOf>
  void ask_all(std::size_t size, RandomSet set, const KeyOf& key_of) {
    std::uint32_t *const sample = sample_.data(), *const shuffle = shuffle_.data(),
                         *const u = seed_u_.data(), *const v = seed_v_.data();
    std::uint64_t pixel = 0;
    SobolSeeds seeds = sobol_seeds(pixel, set);
    for (std::size_t i = 0; i < size; ++i) {
      const Key key = key_of(i);
      if (key.pixel != pixel) {  // samples of one pixel often follow each other
        pixel = key.pixel;
        seeds = sobol_seeds(pixel, set);
      }
      sample[i] = key.sample;
      shuffle[i] = seeds.shuffle;
      u[i] = seeds.u;
      v[i] = seeds.v;
    }
  }

  /// Computes the first `size` pairs. Precondition: all of them were requested.
  void find(const KernelTable& kernels, std::size_t size) {
    kernels.sobol_points({sample_.data(), shuffle_.data(), seed_u_.data(), seed_v_.data(),
                          u_.data(), v_.data(), size});
  }

  [[nodiscard]] UnitPair get(std::size_t i) const { return {u_[i], v_[i]}; }
  [[nodiscard]] UnitPairs view() const { return {u_.data(), v_.data()}; }

 private:
  std::uint64_t key_ = 0;
  RandomSet set_ = RandomSet::film;
  SobolSeeds seeds_ = sobol_seeds(0, RandomSet::film);  ///< of these two
  AlignedArray<std::uint32_t> sample_, shuffle_, seed_u_, seed_v_;
  AlignedArray<double> u_, v_;
};

}  // namespace boule
