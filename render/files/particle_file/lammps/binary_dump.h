#pragma once

#include <memory>
#include <string_view>

#include "core/base/error.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// True if bytes start as a binary dump of LAMMPS does.
bool starts_like_binary_dump(std::string_view start);

/// A reader of binary dumps of LAMMPS, atom/binary and custom/binary, with and without a header
/// that names the format, in either order of bytes.
Result<std::unique_ptr<ParticleReader>> open_binary_dump(MappedText bytes,
                                                         const ParticleFileOptions& options);

}  // namespace boule
