#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// A format of particle files: how it is known and what reads it.
struct ParticleFormat {
  std::string_view name;  ///< as --input-format takes it: "xyz"
  /// The endings of its files' names, without the dot and in lower case, without those of
  /// compression; empty entries at the end.
  std::array<std::string_view, 4> endings;
  /// True if a file that starts with `start` (its first 64 KiB, unpacked) is likely of this
  /// format. Never for formats that only their ending tells.
  bool (*starts_like)(std::string_view start);
  /// A reader of the file's bytes, which finds its frames. The Diagnostic's file is set by the
  /// caller.
  Result<std::unique_ptr<ParticleReader>> (*open)(MappedText bytes,
                                                  const ParticleFileOptions& options,
                                                  const ParallelFor& parallel_for);
  /// Whether files hold many frames, of which the whole ones are read where the file is cut off.
  bool is_trajectory = false;
};

/// All formats, in the order in which a file's content is compared with them.
std::span<const ParticleFormat> all_particle_formats();

}  // namespace boule
