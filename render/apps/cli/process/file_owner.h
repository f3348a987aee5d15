#pragma once

#include <string>

namespace boule::cli {

/// Who holds a lock file or a claim: what stands in the file.
struct FileOwner {
  std::string host;       ///< its name
  std::string processes;  ///< which system's processes `process` is one of: boot and namespace
  int process = 0;
  std::string started;  ///< the process's start, as /proc tells it: numbers are used again
  std::string time;     ///< when the file was made, in UTC

  /// This process, now.
  static FileOwner self();
  /// From a file's text; `process` is 0 if it is no such text. Takes any text.
  static FileOwner parse(const std::string& text);

  [[nodiscard]] std::string text() const;
  /// Whether the process certainly runs no more: only where it would run on this system.
  [[nodiscard]] bool is_gone() const;
  /// "process 123 on HOST since 2026-11-24 07:00:00 UTC".
  [[nodiscard]] std::string described() const;
};

}  // namespace boule::cli
