#include <memory>
#include <string_view>
#include <utility>

#include "render/files/file/unpack.h"
#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/hdf5/hdf5_file.h"
#include "render/files/particle_file/hdf5/hdf5_layout.h"
#include "render/files/particle_file/hdf5/hdf5_parts.h"

namespace boule {
namespace {

bool starts_like_hdf5(std::string_view start) { return start.starts_with("\x89HDF\r\n\x1a\n"); }

class Hdf5Reader final : public ParticleReader {
 public:
  Hdf5Reader(std::shared_ptr<const Hdf5File> file, std::unique_ptr<Hdf5Family> family,
             ParticleFileOptions options)
      : file_(std::move(file)), family_(std::move(family)), options_(std::move(options)) {}

  [[nodiscard]] std::size_t frames() const override { return family_->frames(); }

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor&) override {
    auto opened = open(frame);
    if (!opened) return opened.error();
    Hdf5Parts& parts = *opened.value();
    auto read = parts.read(0, static_cast<std::size_t>(parts.size()));
    if (!read) return read;
    if (parts.guesses_species()) guess_species(read.value());
    leave_out_unwanted(options_.wanted, read.value());
    return read;
  }

  Result<std::unique_ptr<FrameParts>> parts(std::size_t frame) override {
    auto opened = open(frame);
    if (!opened) return opened.error();
    if (opened.value()->guesses_species()) return std::unique_ptr<FrameParts>();
    if (auto done = opened.value()->find_texts(); !done) return done.error();
    return std::unique_ptr<FrameParts>(std::move(opened).value());
  }

 private:
  [[nodiscard]] Result<std::unique_ptr<Hdf5Parts>> open(std::size_t frame) const {
    auto layout = family_->layout(frame, options_);
    if (!layout) return layout.error();
    layout.value().facts.notes.push_back("read by " + file_->library());
    return std::make_unique<Hdf5Parts>(file_, std::move(layout).value(), options_);
  }

  std::shared_ptr<const Hdf5File> file_;
  std::unique_ptr<Hdf5Family> family_;
  ParticleFileOptions options_;
};

/// Which family a file is of, its groups tell.
Hdf5Opened open_family(const Hdf5File& file) {
  for (const auto open : {open_snapshot, open_openpmd, open_h5md}) {
    auto family = open(file);
    if (!family || family.value()) return family;
  }
  return Diagnostic::of("it is of no known family");
}

Result<std::unique_ptr<ParticleReader>> open_hdf5(const std::string& path,
                                                  const ParticleFileOptions& options, std::size_t) {
  for (const std::string_view packed : packed_endings) {
    if (path.ends_with(packed))
      return Diagnostic::of("HDF5 reads no packed files: unpack it first");
  }
  auto opened = Hdf5File::open(path);
  if (!opened) return opened.error();
  const std::shared_ptr<const Hdf5File> file = std::move(opened).value();
  auto family = open_family(*file);
  if (!family) return family.error();
  if (family.value()->frames() == 0) return Diagnostic::of("it holds no frames");
  return std::unique_ptr<ParticleReader>(
      std::make_unique<Hdf5Reader>(file, std::move(family).value(), options));
}

}  // namespace

constinit const ParticleFormat hdf5_format = {.name = "hdf5",
                                              .endings = {"h5md", "h5", "hdf5"},
                                              .starts_like = starts_like_hdf5,
                                              .is_trajectory = true,
                                              .names_columns = true,
                                              .open_file = open_hdf5};

}  // namespace boule
