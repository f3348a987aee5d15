#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "core/base/parallel.h"
#include "render/files/file/checksum.h"

namespace boule {

/// The checksum of a section: that of the checksums of its pieces, so that threads can share it.
/// 0 where this build has none (Checksum::available()).
class PieceChecksum {
 public:
  static constexpr std::size_t piece = std::size_t{1} << 20;

  /// Throws std::bad_alloc, as the others do.
  void add(std::string_view bytes);
  [[nodiscard]] std::uint64_t value();

  /// Of one piece, and of all of them in order.
  static std::uint64_t of_piece(std::string_view bytes);
  static std::uint64_t of_all(std::string_view bytes, const ParallelFor& parallel_for);

 private:
  void end_piece();

  Checksum pieces_;
  std::unique_ptr<Checksum> current_;
  std::size_t size_ = 0;  ///< of the piece that has begun
};

}  // namespace boule
