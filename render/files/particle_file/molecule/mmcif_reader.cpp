#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "render/files/particle_file/molecule/molecule_columns.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

class MmcifReader : public ParticleReader {
 public:
  explicit MmcifReader(std::vector<ParticleFrame> frames) : frames_(std::move(frames)) {}

  [[nodiscard]] std::size_t frames() const override { return frames_.size(); }

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor&) override {
    const ParticleFrame& found = frames_[frame];
    if (auto done = MoleculeColumns::check_room(found.size()); !done) return done.error();
    return found;
  }

 private:
  std::vector<ParticleFrame> frames_;
};

/// Bytes of memory that gemmi's document of this text takes at most: a string for each word, whose
/// list doubles as it grows, and the letters of long ones.
std::uint64_t document_bytes(std::string_view text) {
  constexpr std::uint64_t growing_string = 3 * sizeof(std::string);
  std::uint64_t words = 0;
  bool in_word = false;
  for (const char c : text) {
    const bool blank = is_blank(c) || c == '\n';
    if (!blank && !in_word) ++words;
    in_word = !blank;
  }
  return words * growing_string + 2 * text.size();
}

Result<std::unique_ptr<ParticleReader>> open_mmcif(MappedText bytes,
                                                   const ParticleFileOptions& options,
                                                   const ParallelFor&) {
  if (!has_gemmi()) {
    return Diagnostic::of("this build of Boule lacks gemmi's reader of CIF files");
  }
  if (auto done = check_memory(document_bytes(bytes.text()), "reading it needs"); !done) {
    return done.error();
  }
  auto frames = read_cif_frames(bytes.text(), options);
  if (!frames) return frames.error();
  return std::unique_ptr<ParticleReader>(std::make_unique<MmcifReader>(std::move(frames).value()));
}

/// The first word that is no comment begins a block: "data_1CRN".
bool starts_like_mmcif(std::string_view start) {
  for (TextLines lines(start); !lines.at_end();) {
    const auto words = words_of(lines.next());
    if (words.empty() || words.front().starts_with('#')) continue;
    return words.front().starts_with("data_");
  }
  return false;
}

}  // namespace

constinit const ParticleFormat mmcif_format = {.name = "mmcif",
                                               .endings = {"cif", "mmcif"},
                                               .starts_like = starts_like_mmcif,
                                               .open = open_mmcif,
                                               .names_columns = true};

}  // namespace boule
