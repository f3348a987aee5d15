#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_reader.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/memory/available_memory.h"

namespace boule {

/// The places of a trajectory's frames.
template <class Place>
struct FramePlaces {
  std::vector<Place> frames;  ///< whole ones, at least one
  Status whole;               ///< as ParticleReader::whole()
};

/// A reader of a text whose frames' places are found.
template <class Place>
class PlacedReader : public ParticleReader {
 public:
  PlacedReader(MappedText bytes, ParticleFileOptions options, FramePlaces<Place> places)
      : bytes_(std::move(bytes)), options_(std::move(options)), places_(std::move(places)) {}

  [[nodiscard]] std::size_t frames() const override { return places_.frames.size(); }
  [[nodiscard]] Status whole() const override { return places_.whole; }

 protected:
  MappedText bytes_;
  ParticleFileOptions options_;
  FramePlaces<Place> places_;
};

/// The reader of the frames whose places were found in these bytes.
template <class Reader, class Places>
Result<std::unique_ptr<ParticleReader>> placed_reader(Result<Places> found, MappedText&& bytes,
                                                      const ParticleFileOptions& options) {
  if (!found) return found.error();
  return std::unique_ptr<ParticleReader>(
      std::make_unique<Reader>(std::move(bytes), options, std::move(found).value()));
}

/// True if the last of some rows, where the file ends without an end of line, is only a part of a
/// row such as `whole`: it has fewer words, or no number where that one ends with a number.
inline bool has_cut_row(std::string_view rows, std::string_view whole) {
  if (rows.empty() || rows.back() == '\n') return false;
  const auto words = words_of(rows.substr(rows.rfind('\n') + 1));  // npos + 1 is 0
  const auto expected = words_of(whole);
  if (words.size() < expected.size()) return true;
  return !words.empty() && words.size() == expected.size() && number_in(expected.back()) &&
         !number_in(words.back());
}

/// Appends the place of a frame to the list of a trajectory. An error if a longer list does not
/// fit into memory: a file of tiny frames makes it longer than the file.
template <class Place>
Status add_frame_place(std::vector<Place>& frames, const Place& place) {
  if (frames.size() == frames.capacity()) {
    const std::uint64_t bytes = std::uint64_t{2} * sizeof(Place) * (frames.size() + 1);
    const std::string who = "the list of its " + std::to_string(frames.size()) + " and more frames";
    if (auto done = check_memory(bytes, who + " needs"); !done) return done;
  }
  frames.push_back(place);
  return {};
}

}  // namespace boule
