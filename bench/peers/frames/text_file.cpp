#include "bench/peers/frames/text_file.h"

#include <fstream>

namespace boule::bench {

Status write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (file) return {};
  return Diagnostic::of("cannot write " + quote(path, 200));
}

}  // namespace boule::bench
