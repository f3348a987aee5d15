#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace boule {

/// The 64-bit XXH3 hash of bytes that come in pieces: it tells whether a file was changed or cut by
/// accident. Not cryptographic.
class Checksum {
 public:
  /// Whether this build can make one; without it add() and value() do nothing, and value() is 0.
  static bool available();

  /// Throws std::bad_alloc.
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(std::string_view bytes);
  [[nodiscard]] std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace boule
