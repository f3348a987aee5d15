#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/hdf5/hdf5_layout.h"
#include "render/files/particle_file/text/text_interner.h"

namespace boule {

/// Reads a column of texts, part by part, and numbers them in the order of their first use.
class Hdf5TextColumn {
 public:
  explicit Hdf5TextColumn(Hdf5Texts texts) : texts_(std::move(texts)) {}

  [[nodiscard]] const std::string& name() const { return texts_.name; }

  /// The texts' numbers of particles begin .. begin + count - 1.
  Status read(const Hdf5File& file, std::uint64_t begin, std::size_t count,
              std::vector<std::uint32_t>& indices);

  /// All texts so far.
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  std::uint32_t index_of(std::string_view text);
  Result<std::string> text_of(const Hdf5File& file, double code);

  Hdf5Texts texts_;
  std::deque<std::string> bytes_{};  ///< they stay where they are
  TextInterner interner_{};
  std::unordered_map<double, std::uint32_t> codes_{};  ///< those that have been met
  std::optional<std::map<double, std::string>> names_{};
};

}  // namespace boule
