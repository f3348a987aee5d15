#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/packed/packed_contents.h"
#include "render/files/packed/packed_format.h"

namespace boule {

/// Whether a name is that of a packed scene: it ends with .boule.
bool is_packed_name(std::string_view path);

/// How a packed scene is opened.
struct PackedOptions {
  /// The file is one's own: neither its nodes nor their checksum are looked at, so that opening it
  /// takes no time whatever its size.
  bool trust = false;
  ParallelFor parallel_for = serial_for;
};

/// A packed scene that is mapped into memory, for as long as it or the scene lives. Only what is
/// used is read from the disk. The file must keep its length meanwhile: if another program cuts it
/// off, the system ends the process that reads what is gone (SIGBUS).
///
/// A file that is none, is cut off, or was changed such that reading it would leave it, is refused.
/// What is not looked at when it is opened is safe whatever it holds: ids, materials and spheres of
/// slots.
class PackedFile {
 public:
  /// Opens any name. Throws std::bad_alloc, as the others do.
  static Result<PackedFile> open(const std::string& path, const PackedOptions& options = {});

  /// The scene with its packed spheres. An error if there are more chunks of them than fit into one
  /// geometry, or several with spheres that are too far away for it.
  [[nodiscard]] Result<Scene> scene() const;
  [[nodiscard]] const PackedContents& contents() const { return contents_; }
  [[nodiscard]] const std::vector<packed_format::Section>& sections() const { return sections_; }

  /// Reads the whole file: an error if a section is not what it was when it was packed, or if the
  /// file or this build has no checksums.
  [[nodiscard]] Status verify(const ParallelFor& parallel_for) const;

 private:
  class Map;
  using Section = packed_format::Section;

  explicit PackedFile(std::string path) : path_(std::move(path)) {}
  Status map();
  Status read_header();
  Status read_contents();
  Status read_chunk(std::uint32_t chunk, const PackedOptions& options);
  [[nodiscard]] const Section* find(packed_format::Kind kind, std::uint32_t chunk) const;
  [[nodiscard]] std::string_view bytes_of(const Section& section) const;
  [[nodiscard]] bool is_sound(const Section& section, const ParallelFor& parallel_for) const;
  [[nodiscard]] Status check_parts() const;
  [[nodiscard]] Diagnostic wrong(const std::string& what) const;

  std::string path_;
  std::shared_ptr<const Map> map_;
  std::vector<Section> sections_;
  PackedContents contents_;
  std::vector<std::shared_ptr<const Bvh>> trees_;  ///< of the chunks
};

}  // namespace boule
