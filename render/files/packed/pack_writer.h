#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/files/packed/packed_contents.h"
#include "render/files/packed/packed_format.h"
#include "render/files/packed/piece_checksum.h"
#include "render/files/packed/spill_file.h"
#include "render/image/output_file.h"
#include "simd/geometry/bvh_builder.h"

namespace boule {

/// Writes a packed scene: chunk by chunk, of each the slots in their order and the nodes in any.
/// Blocks go straight into the file; the other arrays wait beside it until their chunk is complete.
/// The file appears under its name only at the end. Each function gives the system's reason for
/// what cannot be written (cannot_write).
class PackWriter {
 public:
  static Result<PackWriter> create(const std::string& output, const std::function<bool()>& stop);

  /// Begins a chunk. `alike`: all its spheres are made of the same, and it keeps no materials. The
  /// first tree that is appended then is the one without nodes, of the spheres in no leaf.
  Status begin_chunk(bool alike);

  /// Appends a tree's blocks, ids and materials, and its nodes as those of a part of the chunk's
  /// tree. `ids`: of the spheres, by the tree's own ids. Returns the index of its first node.
  Result<std::uint32_t> append(const Bvh& tree, std::span<const std::uint32_t> ids);

  /// Makes room for nodes, which are to be set. Returns the first one's index.
  Result<std::uint32_t> reserve_nodes(std::size_t count);
  Status set_node(std::uint32_t index, const BvhNode& node);

  /// Ends a chunk. Then another can begin.
  Status end_chunk();

  /// Writes what is left, and gives the file its name. Returns its size.
  Result<std::uint64_t> finish(const PackedContents& contents, const std::function<bool()>& stop);

 private:
  using Kind = packed_format::Kind;

  PackWriter(OutputFile output, SpillFile ids, SpillFile materials, SpillFile nodes);
  Status write(const void* bytes, std::size_t count);
  Status begin_section(Kind kind);
  void end_section();
  Status append_spilled(Kind kind, SpillFile& spill);
  Status append_nodes(const Bvh& tree, std::uint32_t first_leaf);

  OutputFile output_;
  std::uint64_t size_ = 0;  ///< of the output
  std::vector<packed_format::Section> sections_;
  std::unique_ptr<PieceChecksum> checksum_;  ///< of the section that is written
  std::uint32_t chunk_ = 0;
  bool alike_ = true;
  SpillFile ids_, materials_, nodes_;  ///< of the chunk that is written
  std::uint64_t blocks_ = 0;           ///< of that chunk, those of no leaf among them
  std::uint64_t scanned_blocks_ = 0;   ///< of no leaf
};

}  // namespace boule
