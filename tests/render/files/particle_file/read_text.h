#pragma once

#include <string>

#include "render/files/particle_file/particle_file.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::test {

/// Frame `frame` of a file of this name and these bytes.
inline Result<ParticleFrame> read_particles(const std::string& name, const std::string& bytes,
                                            const ParticleFileOptions& options = {},
                                            long frame = -1,
                                            const ParallelFor& parallel_for = serial_for) {
  const TempDir folder;
  const std::string path = folder.path() / name;
  write_bytes(path, bytes);
  auto file = ParticleFile::open(path, options, parallel_for);
  if (!file) return file.error();
  return file.value().read(frame, parallel_for);
}

/// "LINE:COLUMN: MESSAGE (KEY)" of the error, or "no error".
inline std::string particle_error(const std::string& name, const std::string& bytes,
                                  const ParticleFileOptions& options = {}, long frame = -1) {
  const auto read = read_particles(name, bytes, options, frame);
  if (read) return "no error";
  const Diagnostic& error = read.error();
  return std::to_string(error.line) + ":" + std::to_string(error.column) + ": " + error.message +
         " (" + error.key + ")";
}

}  // namespace boule::test
