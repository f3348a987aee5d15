#pragma once

#include <memory>
#include <string_view>

#include "core/base/error.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// True if a text starts as LAMMPS writes its dumps in YAML (docs.lammps.org/dump.html, style
/// yaml).
bool starts_like_yaml_dump(std::string_view start);

/// A reader of such a text. It is no parser of YAML: it takes the lines that LAMMPS writes, whose
/// keys stand in any order, but for "data:", which comes last.
Result<std::unique_ptr<ParticleReader>> open_yaml_dump(MappedText bytes,
                                                       const ParticleFileOptions& options);

}  // namespace boule
