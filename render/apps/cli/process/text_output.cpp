#include "render/apps/cli/process/text_output.h"

#include "render/apps/cli/process/interrupt.h"
#include "render/image/output_file.h"

namespace boule::cli {

Status write_text_file(const std::string& text, const std::string& path) {
  const auto stop = [] { return WriteGuard::interrupted(); };
  auto file = OutputFile::create(path, stop);
  if (!file) return file.error();
  if (auto done = file.value().write(text.data(), text.size()); !done) return done;
  return file.value().commit(stop);
}

}  // namespace boule::cli
