#pragma once

#include <fstream>
#include <string>

namespace boule::bench {

/// The model of this machine's processor; "unknown" if the system does not tell.
inline std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// The compiler of this build.
#if defined(__clang__)
inline constexpr const char* compiler = __VERSION__;
#else
inline constexpr const char* compiler = "g++ " __VERSION__;
#endif

}  // namespace boule::bench
