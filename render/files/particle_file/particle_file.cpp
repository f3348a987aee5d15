#include "render/files/particle_file/particle_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/float_environment.h"
#include "core/base/text.h"
#include "render/files/file/input_file.h"
#include "render/files/file/mapped_text.h"
#include "render/files/file/npz_member.h"
#include "render/files/file/unpack.h"
#include "render/files/particle_file/frame/other_formats.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/text/named_columns.h"

namespace boule {
namespace {

/// The file's name in lower case, without its folder and without an ending of compression.
std::string bare_name(std::string_view path) {
  std::string name = ascii_lower(path.substr(path.rfind('/') + 1));  // npos + 1 is 0
  for (const std::string_view packed : packed_endings) {
    if (!name.ends_with(packed)) continue;
    name.resize(name.size() - packed.size());
    break;
  }
  return name;
}

std::string_view ending_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1);
}

const ParticleFormat* format_of_ending(std::string_view name) {
  const std::string_view ending = ending_of(name);
  if (ending.empty()) return nullptr;
  for (const ParticleFormat& format : all_particle_formats()) {
    if (std::count(format.endings.begin(), format.endings.end(), ending) > 0) return &format;
  }
  return nullptr;
}

/// The format that knows the whole name.
const ParticleFormat* format_of_whole(std::string_view name) {
  for (const ParticleFormat& format : all_particle_formats()) {
    if (format.knows_name != nullptr && format.knows_name(name)) return &format;
  }
  return nullptr;
}

const ParticleFormat* format_of_name(std::string_view name) {
  for (const ParticleFormat& format : all_particle_formats()) {
    if (format.name == name) return &format;
  }
  return nullptr;
}

const ParticleFormat* format_of_content(std::string_view text) {
  constexpr std::size_t start = std::size_t{1} << 16;
  for (const ParticleFormat& format : all_particle_formats()) {
    if (format.starts_like != nullptr && format.starts_like(text.substr(0, start))) return &format;
  }
  return nullptr;
}

/// The format whose prefix the name has: "data.film", "dump.melt". Names with an ending that other
/// readers of this library take are none.
const ParticleFormat* format_of_prefix(std::string_view name) {
  constexpr std::array others{"toml", "nff", "npy", "lens"};
  if (std::count(others.begin(), others.end(), ending_of(name)) > 0) return nullptr;
  for (const ParticleFormat& format : all_particle_formats()) {
    if (!format.prefix.empty() && name.starts_with(format.prefix)) return &format;
  }
  return nullptr;
}

/// Whether the format that is requested, else that of the name's ending, reads files itself: then
/// nobody else need look into them.
bool is_read_elsewhere(const std::string& path, const std::string& requested) {
  const ParticleFormat* const format =
      requested.empty() ? format_of_ending(bare_name(path)) : format_of_name(requested);
  return format != nullptr && format->open_file != nullptr;
}

/// What reads the file, by the request, else its name, else its content.
Result<const ParticleFormat*> find_format(const std::string& path, std::string_view text,
                                          const std::string& requested) {
  if (!requested.empty()) {
    if (const ParticleFormat* format = format_of_name(requested)) return format;
    return Diagnostic::about("format", "there is no format " + quote(requested) +
                                           " of particle files, expected one of " +
                                           joined(particle_formats(), ", "));
  }
  const std::string name = bare_name(path);
  const ParticleFormat* const named = format_of_ending(name);
  constexpr std::array shared{"txt", "bin", "yaml"};  // endings of many formats
  const bool is_shared = std::count(shared.begin(), shared.end(), ending_of(name)) > 0;
  if (named != nullptr && !is_shared) return named;
  if (const ParticleFormat* format = format_of_whole(name)) return format;
  if (const ParticleFormat* format = format_of_content(text)) return format;
  if (named != nullptr) return named;  // its content is of no other format
  if (const ParticleFormat* format = format_of_prefix(name)) return format;
  return Diagnostic::in_file(path,
                             "neither its ending nor its content tells a format of particle files, "
                             "expected one of " +
                                 known_particle_endings() + advice_for(path));
}

/// An error about names for columns, if the format leaves nothing to be named, or if one of them
/// occurs twice.
Status check_columns(const std::vector<std::string>& columns, const ParticleFormat& format) {
  if (!columns.empty() && format.names_columns) {
    return Diagnostic::about(
        "columns", "a file of the format " + quote(format.name) + " names its columns itself");
  }
  const auto repeated = find_repeated(columns);
  if (!repeated) return {};
  return Diagnostic::about("columns", "two columns have the name " + quote(*repeated));
}

/// No bytes, or an error if there is no such file.
Result<MappedText> open_without_bytes(const std::string& path) {
  const auto file = InputFile::open(path);
  if (!file) return file.error();
  return MappedText::of({});
}

Result<MappedText> open_bytes(const std::string& path) {
  const auto in_archive = npz_name(path);
  if (!in_archive) return MappedText::open(path, MappedText::Cut::keep);
  auto bytes = read_npz_array(*in_archive);
  if (!bytes) return bytes.error();
  return MappedText::of(std::move(bytes).value());
}

Diagnostic in_file(Diagnostic error, const std::string& path) {
  if (error.file.empty()) error.file = path;
  return error;
}

/// What the particles are, by the first frame of the topology; nothing without one.
Result<ParticleFrame> open_topology(const ParticleFileOptions& options,
                                    const ParallelFor& parallel_for) {
  if (options.topology.empty()) return ParticleFrame{};
  const ParticleFileOptions its{.water = true,
                                .wanted = options.wanted,
                                .most_bonded = options.most_bonded,
                                .places_matter = false};
  auto file = ParticleFile::open(options.topology, its, parallel_for);
  if (!file) return file.error();
  return file.value().read(0, parallel_for);
}

/// Gives a frame the kinds and bonds of a topology, and the columns that it lacks but for
/// velocities, which are those of another time.
Status add_topology(const ParticleFrame& topology, ParticleFrame& frame) {
  if (topology.size() != frame.size()) {
    return Diagnostic::about("topology", "it has " + std::to_string(topology.size()) +
                                             " particles, the file has " +
                                             std::to_string(frame.size()));
  }
  for (const std::string& note : topology.notes) frame.notes.push_back("topology: " + note);
  if (topology.species) frame.species = topology.species;
  if (!topology.bonds.empty()) {
    frame.bonds = topology.bonds;
    frame.lists_all_bonds = topology.lists_all_bonds;
  }
  for (const TextColumn& column : topology.texts) {
    if (find_text_column(frame, column.name) == nullptr) frame.texts.push_back(column);
  }
  for (const NumberColumn& column : topology.numbers) {
    const bool is_velocity = column.name == "vx" || column.name == "vy" || column.name == "vz";
    if (!is_velocity && find_number_column(frame, column.name) == nullptr)
      frame.numbers.push_back(column);
  }
  return {};
}

/// A frame that is in memory already.
class FramesInMemory final : public ParticleReader {
 public:
  explicit FramesInMemory(std::vector<ParticleFrame> frames) : frames_(std::move(frames)) {}

  [[nodiscard]] std::size_t frames() const override { return frames_.size(); }
  Result<ParticleFrame> read(std::size_t index, const ParallelFor&) override {
    return frames_[index];
  }

 private:
  std::vector<ParticleFrame> frames_;
};

}  // namespace

std::vector<std::string_view> particle_formats() {
  std::vector<std::string_view> names;
  for (const ParticleFormat& format : all_particle_formats()) names.push_back(format.name);
  return names;
}

std::string known_particle_endings() {
  std::string endings;
  for (const ParticleFormat& format : all_particle_formats()) {
    for (const std::string_view ending : format.endings) {
      if (!ending.empty()) endings += (endings.empty() ? "." : " .") + std::string(ending);
    }
  }
  return endings;
}

bool is_particle_name(std::string_view path) {
  const std::string name = bare_name(path);
  return format_of_ending(name) != nullptr || format_of_prefix(name) != nullptr ||
         format_of_whole(name) != nullptr || npz_name(std::string(path));
}

bool has_particle_content(const std::string& path) {
  const auto bytes = open_bytes(path);
  return bytes && format_of_content(bytes.value().text()) != nullptr;
}

ParticleFile::ParticleFile(std::string path, std::string_view format,
                           std::unique_ptr<ParticleReader> reader)
    : path_(std::move(path)), format_(format), reader_(std::move(reader)) {}

ParticleFile ParticleFile::of(ParticleFrame frame) {
  std::vector<ParticleFrame> frames;
  frames.push_back(std::move(frame));
  return of(std::move(frames));
}

ParticleFile ParticleFile::of(std::vector<ParticleFrame> frames) {
  return {"", "memory", std::make_unique<FramesInMemory>(std::move(frames))};
}

Result<ParticleFile> ParticleFile::open(const std::string& path, const ParticleFileOptions& options,
                                        const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  auto bytes =
      is_read_elsewhere(path, options.format) ? open_without_bytes(path) : open_bytes(path);
  if (!bytes) return bytes.error();
  const auto format = find_format(path, bytes.value().text(), options.format);
  if (!format) return in_file(format.error(), path);
  if (auto done = check_columns(options.columns, *format.value()); !done) return done.error();
  const Status whole = bytes.value().whole();
  auto topology = open_topology(options, parallel_for);
  if (!topology) return topology.error();
  auto reader = format.value()->open_file != nullptr
                    ? format.value()->open_file(path, options, topology.value().size())
                    : format.value()->open(std::move(bytes).value(), options, parallel_for);
  if (!whole && !(reader && format.value()->is_trajectory))
    return cannot_read(path, whole.error().message);
  if (!reader) return in_file(reader.error(), path);
  ParticleFile opened(path, format.value()->name, std::move(reader).value());
  opened.packing_whole_ = whole;
  if (!options.topology.empty()) opened.topology_ = std::move(topology).value();
  return opened;
}

std::string ParticleFile::cut_text() const {
  const Status whole = reader_->whole();
  if (whole && !packing_whole_) {
    return "the file is cut off behind frame " + std::to_string(frames() - 1) + ": " +
           packing_whole_.error().message;
  }
  if (whole) return {};
  const int line = whole.error().line;
  return "the file is cut off in frame " + std::to_string(frames()) + " (" +
         (line > 0 ? "line " + std::to_string(line) + ": " : "") + whole.error().message + ")";
}

Result<std::unique_ptr<FrameParts>> ParticleFile::parts(std::size_t frame) {
  if (topology_) return std::unique_ptr<FrameParts>();
  const FloatEnvironment environment;
  auto parts = reader_->parts(frame);
  if (!parts) return in_file(parts.error(), path_);
  return parts;
}

Result<ParticleFrame> ParticleFile::read(long frame, const ParallelFor& parallel_for) {
  const FloatEnvironment environment;
  const auto count = static_cast<long>(frames());
  if (frame < -count || frame >= count) {
    const std::string cut = frame == count ? cut_text() : std::string();
    return Diagnostic{.message = "there is no frame " + std::to_string(frame) + ", it has " +
                                 std::to_string(count) + (count == 1 ? " frame" : " frames") +
                                 (cut.empty() ? "" : ": ") + cut,
                      .key = "frame",
                      .file = path_};
  }
  auto read =
      reader_->read(static_cast<std::size_t>(frame < 0 ? frame + count : frame), parallel_for);
  if (!read) return in_file(read.error(), path_);
  if (topology_) {
    if (auto done = add_topology(*topology_, read.value()); !done) return done.error();
  } else if (!read.value().species &&
             (format_ == library_format.name || format_ == hdf5_format.name)) {
    read.value().notes.emplace_back(
        "the file does not tell kinds of particles: --topology names a file that does");
  }
  if (format_ == library_format.name) {
    read.value().axes_matter = read.value().cell.has_value() || !read.value().species;
  }
  if (std::string cut = cut_text(); !cut.empty()) read.value().notes.push_back(std::move(cut));
  return read;
}

}  // namespace boule
