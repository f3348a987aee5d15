#pragma once

#include <array>
#include <string_view>

#include "core/base/error.h"
#include "render/files/file/growing_bytes.h"

namespace boule {

/// What a file's content is packed by.
enum class Packing { none, gzip, zstandard, bzip2, xz };

/// What the names of packed files end with.
constexpr std::array<std::string_view, 4> packed_endings{".gz", ".zst", ".bz2", ".xz"};

/// By the first bytes of a file.
Packing packing_of(std::string_view bytes);

/// Nothing, or an error that names what the bytes are packed by and what unpacks them: LZMA,
/// LZ4 and others that Boule does not read.
Status check_packing(std::string_view bytes);

struct Unpacked {
  GrowingBytes bytes;
  Status whole;  ///< an error if the packed bytes end too early: `bytes` is what they hold; a
                 ///< message only
};

/// What `packed` holds: all members, streams or frames of the format. Zeros that pad the end are
/// skipped. An error, with a message only, if the bytes are damaged, if the build has
/// no library for them, or if memory does not suffice, as soon as that is known.
Result<Unpacked> unpack(Packing packing, std::string_view packed);

}  // namespace boule
