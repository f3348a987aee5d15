#pragma once

#include <ctime>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/apps/cli/process/pulse.h"

namespace boule::cli {

/// One process's claim on a picture: the file PICTURE.claim, which only one process can make. Its
/// owner touches it as long as it works, and removes it at the end.
class Claim {
 public:
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

 private:
  friend class Claims;
  Claim(std::string path, int descriptor);

  std::string path_;
  int descriptor_;
  std::optional<Pulse> pulse_;  ///< last: it uses the others
};

/// The claims of the processes that share a series, as one of them sees them.
class Claims {
 public:
  /// How long a claim of another machine's process may go untouched.
  static constexpr double silence = 60;  // seconds

  /// Claims a picture. Null if another process has it: one that is not certainly gone, and that
  /// touched its claim within `silence`, as far as this process could see.
  Result<std::unique_ptr<Claim>> take(const std::string& picture);

  /// Whether there is a picture that is newer than this process's first claim: another process of
  /// the series has made it. Both times are the file system's.
  [[nodiscard]] bool is_new(const std::string& picture) const;

 private:
  struct Sight {
    timespec touched{};
    Pulse::Clock::time_point since;  ///< when this process first saw it so
  };
  bool is_silent(const std::string& path, const timespec& touched);
  Result<std::unique_ptr<Claim>> take_over(const std::string& path);

  std::map<std::string, Sight> seen_;
  std::optional<timespec> first_;  ///< when the first claim was made
};

}  // namespace boule::cli
