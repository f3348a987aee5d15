#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "render/apps/view/server/web_server.h"

namespace boule::view {

/// A place where a server listens: a port of an address, or a socket in the file system, which only
/// its owner may use, and which goes with this object. What a program that was killed has left at
/// that path is replaced: who opens one keeps other servers away meanwhile, by a lock.
class Listener {
 public:
  /// An error if nobody can listen there.
  static Result<Listener> open(const ServerSettings& settings);
  Listener(Listener&& other) noexcept;
  Listener& operator=(Listener&&) = delete;
  ~Listener();

  /// The descriptor becomes the caller's.
  int release();
  [[nodiscard]] int family() const { return family_; }
  /// The page's address, without its path. Of a socket in the file system: the one that a tunnel by
  /// ssh gives it, at ServerSettings::port.
  [[nodiscard]] const std::string& url() const { return url_; }

 private:
  Listener(int descriptor, int family) : descriptor_(descriptor), family_(family) {}
  static Result<Listener> open_file(const ServerSettings& settings);
  Status bind_to(const void* address, unsigned size) const;
  void name_address();

  int descriptor_, family_;
  std::string url_;
  std::string file_;                         ///< of a socket in the file system
  std::array<std::uint64_t, 2> identity_{};  ///< of that file: another one of its name stays
};

}  // namespace boule::view
