#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// What a binary dump of LAMMPS says of a frame, as its tools/binary2txt.cpp reads it.
struct BinaryDumpHead {
  bool is_big_endian = false;
  std::uint64_t atoms = 0;
  std::size_t columns = 0;           ///< numbers of a particle, 1 to most_text_columns
  std::vector<std::string> names{};  ///< of the columns; empty: it does not tell
  std::optional<ParticleCell> cell{};
  std::optional<double> time{}, length_in_angstrom{};
  std::uint32_t chunks = 0;     ///< of processes, each with a count of numbers and these
  std::size_t first_chunk = 0;  ///< the byte where they begin
};

/// Reads the head of the frame that begins at a byte. `is_cut`, if it is not null, is set to true
/// where the error is that the bytes end too early; likewise below.
Result<BinaryDumpHead> read_binary_dump_head(std::string_view bytes, std::size_t begin,
                                             bool* is_cut = nullptr);

/// Some particles that follow each other.
struct BinaryDumpChunk {
  std::size_t at;  ///< the first byte
  std::uint64_t rows;
};

/// Goes through a frame's chunks, which hold as many particles as its head says, and returns where
/// the frame ends. `chunks`, if it is not null, gets their particles, in pieces of a size to share.
Result<std::size_t> skip_chunks(std::string_view bytes, const BinaryDumpHead& head,
                                std::vector<BinaryDumpChunk>* chunks, bool* is_cut = nullptr);

}  // namespace boule
