#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_reader.h"
#include "render/files/particle_file/hdf5/hdf5_file.h"
#include "render/files/particle_file/hdf5/hdf5_layout.h"
#include "render/files/particle_file/hdf5/hdf5_text_column.h"

namespace boule {

/// Reads a frame whose places in a file are known.
class Hdf5Parts final : public FrameParts {
 public:
  Hdf5Parts(std::shared_ptr<const Hdf5File> file, Hdf5Layout layout, ParticleFileOptions options);

  [[nodiscard]] std::uint64_t size() const override { return layout_.count(); }
  Result<ParticleFrame> read(std::uint64_t begin, std::size_t count) override;

  /// Reads all texts once: from then on each part has those of the whole frame.
  Status find_texts();
  /// Whether the elements are to be guessed from the whole frame.
  [[nodiscard]] bool guesses_species() const;

 private:
  struct Range {
    std::uint64_t begin;
    std::size_t count;
  };

  template <class Read>
  Status each_part(const Range& range, const Read& read) const;
  Status read_places(const Range& range, std::vector<Vec3d>& positions) const;
  Status read_axes(const Hdf5Places& places, const Range& range, Vec3d* to) const;
  Status read_array(const Hdf5Array& array, const Range& range, ParticleFrame& frame) const;
  Status read_texts(const Range& range, ParticleFrame& frame);
  Status read_numbers(const Hdf5Numbers& numbers, std::size_t width, const Range& range,
                      double* to) const;
  [[nodiscard]] TextColumn kinds_of_parts(const Range& range) const;

  std::shared_ptr<const Hdf5File> file_;
  Hdf5Layout layout_;
  ParticleFileOptions options_;
  std::vector<Hdf5TextColumn> texts_;  ///< first that of the species, if they have one
};

}  // namespace boule
