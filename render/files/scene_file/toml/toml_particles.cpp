#include "render/files/scene_file/toml/toml_particles.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "render/files/file/nearest_name.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/particles/between_frames.h"
#include "render/files/scene_file/loaded/frame_name.h"
#include "render/files/scene_file/loaded/particle_file_cache.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/files/scene_file/toml/toml_particle_style.h"

namespace boule {
namespace {

/// What the keys of a table say.
struct ParticleKeys {
  std::string written;  ///< the name of the file in the scene file, with a place for the number
  std::string name;     ///< with the frame's number
  std::string path;
  std::optional<int> frame;  ///< of the file
  ParticleFileOptions file;
  ParticleStyle style;
};

void check_format(TomlTable& table, const std::string& format) {
  if (!table.has("format")) return;
  const std::vector<std::string_view> known = particle_formats();
  if (std::find(known.begin(), known.end(), format) != known.end()) return;
  table.report("format", "unknown format " + quote(format) + ", expected " + list_names(known) +
                             did_you_mean(format, known));
}

ParticleKeys read_particle_keys(TomlTable& table, const ParticleMaterialIds& materials) {
  ParticleKeys keys;
  table.read("file", keys.written);
  table.read_file_name("file", keys.name);
  if (table.has("frame")) table.read("frame", keys.frame.emplace());
  table.read("format", keys.file.format);
  check_format(table, keys.file.format);
  table.read("columns", keys.file.columns);
  table.read("water", keys.file.water);
  if (table.has("topology")) table.read_file_name("topology", keys.file.topology);
  keys.style = read_particle_style(table);
  keys.style.material = materials.own;
  keys.style.ghost_material = materials.ghosts;
  table.finish({"file"});
  return keys;
}

/// Reads the file that the keys name.
class ParticleTable {
 public:
  ParticleTable(TomlTable& table, ParticleKeys keys, const SceneFileOptions& options,
                bool may_stream)
      : table_(table), keys_(std::move(keys)), options_(options), may_stream_(may_stream) {}

  std::optional<TomlParticles> read();

 private:
  std::optional<ParticleFrame> read_frame(ParticleFile& file);
  std::shared_ptr<ParticleSource> open_source(const std::shared_ptr<ParticleFile>& file);
  Result<std::shared_ptr<ParticleSource>> find_source(const std::shared_ptr<ParticleFile>& file);
  template <class Spheres>
  TomlParticles tell(const Spheres& spheres, std::size_t of_file);
  Status find_wrong_radius() const;
  std::shared_ptr<ParticleFile> open(const std::string& name, const std::string& path);
  [[nodiscard]] bool is_of_series(const ParticleFile& file) const;
  std::optional<std::size_t> choose_frame(const ParticleFile& file);
  std::optional<ParticleFrame> read_of(ParticleFile& file, std::size_t frame);
  std::optional<ParticleFrame> read_next(ParticleFile& file, std::size_t frame);
  std::optional<ParticleFrame> kept(Result<ParticleFrame> frame);
  void report_file(const Diagnostic& error);
  void report_key(const Diagnostic& error);

  TomlTable& table_;
  ParticleKeys keys_;
  const SceneFileOptions& options_;
  bool may_stream_;
  std::string held_;  ///< why a frame that is read part by part is held as a whole
  ParticleFacts facts_;
};

std::optional<TomlParticles> ParticleTable::read() {
  keys_.style.chosen = find_choices(options_.choices, table_.path());
  keys_.style.lacks_kinds = options_.frame.has_value();
  keys_.file.wanted = columns_of(keys_.style);
  if (options_.between > 0) keys_.file.wanted->emplace_back("id");
  keys_.file.most_bonded = most_bonded_of(keys_.style);
  const std::shared_ptr<ParticleFile> file = open(keys_.name, keys_.path);
  if (!file) return std::nullopt;
  const auto number = choose_frame(*file);
  if (!number) return std::nullopt;
  facts_ = {.table = table_.path(),
            .file = keys_.path,
            .format = std::string(file->format()),
            .frames = file->frames(),
            .frame = *number};
  if (may_stream_) {
    auto source = open_source(file);
    if (!table_.ok()) return std::nullopt;
    if (source) {
      const PartedSpheres& spheres = source->spheres();
      facts_.time = spheres.time();
      facts_.particles = static_cast<std::size_t>(spheres.particles());
      TomlParticles particles = tell(spheres, 0);
      particles.source = std::move(source);
      return particles;
    }
  }
  auto frame = read_frame(*file);
  if (!frame) return std::nullopt;
  const std::size_t of_file = frame->notes.size();
  auto made = ParticleSpheres::make(std::move(*frame), keys_.style, options_.parallel_for);
  if (!made) {
    const Status place = made.error().key == "radius" ? find_wrong_radius() : Status();
    place ? report_key(made.error()) : report_file(place.error());
    return std::nullopt;
  }
  ParticleSpheres& spheres = made.value();
  facts_.bonds = spheres.bonds();
  facts_.own = spheres.own_choices();
  facts_.labels = spheres.labels();
  TomlParticles particles = tell(spheres, of_file);
  particles.spheres = std::move(spheres);
  return particles;
}

/// What is told of spheres; so many notes are those of the file.
template <class Spheres>
TomlParticles ParticleTable::tell(const Spheres& spheres, std::size_t of_file) {
  TomlParticles particles{{}, {}, std::move(facts_), {}};
  particles.facts.spheres = static_cast<std::size_t>(spheres.size());
  particles.facts.radius_source = spheres.radius_source();
  particles.facts.colors = spheres.colors();
  if (auto& scale = particles.facts.colors.scale)
    scale->unit = column_unit(particles.facts.format, scale->by);
  particles.facts.cell = spheres.cell();
  particles.facts.axes_matter = spheres.axes_matter();
  // What is decided is told once for all files of a series.
  for (std::size_t i = 0; i < spheres.notes().size(); ++i) {
    const std::string& name = i < of_file ? keys_.name : keys_.written;
    particles.notes.push_back(printable(name) + ": " + spheres.notes()[i]);
  }
  if (!held_.empty()) {
    particles.notes.push_back(printable(keys_.name) +
                              ": the frame is held in memory as a whole: " + held_);
  }
  return particles;
}

/// The frame part by part, with what is to be known of all of it; null if it is read as a whole.
Result<std::shared_ptr<ParticleSource>> ParticleTable::find_source(
    const std::shared_ptr<ParticleFile>& file) {
  const std::shared_ptr<ParticleSource> none;
  auto parts = file->parts(facts_.frame);
  if (!parts) return parts.error();
  if (!parts.value() || parts.value()->size() == 0) return none;
  const auto some = parts.value()->read(0, 1);
  if (!some) return some.error();
  const std::string needs = what_needs_all(some.value(), keys_.style);
  if (!needs.empty()) {
    constexpr std::uint64_t many = std::uint64_t{1} << 22;
    if (parts.value()->size() >= many) held_ = needs;
    return none;
  }
  auto spheres = PartedSpheres::make(std::move(parts).value(), keys_.style, options_.parallel_for);
  if (!spheres) return spheres.error();
  return std::make_shared<ParticleSource>(file, std::move(spheres).value(), options_.parallel_for);
}

std::shared_ptr<ParticleSource> ParticleTable::open_source(
    const std::shared_ptr<ParticleFile>& file) {
  auto source = find_source(file);
  if (source) return source.value();
  if (source.error().key == "file" || source.error().key.empty()) {
    report_file(Diagnostic::of(source.error().message));
  } else {
    report_key(source.error());
  }
  return nullptr;
}

std::shared_ptr<ParticleFile> ParticleTable::open(const std::string& name,
                                                  const std::string& path) {
  if (options_.data != nullptr) {
    const auto found = options_.data->particles.find(name);
    if (found != options_.data->particles.end()) return found->second;
  }
  ParticleFileCache own;
  ParticleFileCache& cache = options_.particle_files != nullptr ? *options_.particle_files : own;
  auto opened = cache.open(path, keys_.file, options_.parallel_for);
  if (opened) return opened.value();
  report_file(opened.error());
  return nullptr;
}

std::optional<ParticleFrame> ParticleTable::read_frame(ParticleFile& file) {
  auto frame = read_of(file, facts_.frame);
  if (frame && options_.between > 0) {
    const auto next = read_next(file, facts_.frame);
    if (!table_.ok()) return std::nullopt;
    auto mixed = next ? between_frames(*std::move(frame), *next, options_.between)
                      : Result<ParticleFrame>(*std::move(frame));
    frame = kept(std::move(mixed));
  }
  if (!frame) return std::nullopt;
  facts_.time = frame->time;
  facts_.particles = frame->size();
  return frame;
}

/// The value, or nothing if its error is reported.
std::optional<ParticleFrame> ParticleTable::kept(Result<ParticleFrame> frame) {
  if (frame) return std::move(frame).value();
  report_file(frame.error());
  return std::nullopt;
}

std::optional<ParticleFrame> ParticleTable::read_of(ParticleFile& file, std::size_t frame) {
  return kept(file.read(static_cast<long>(frame), options_.parallel_for));
}

/// The next frame of a series; nothing if there is none.
std::optional<ParticleFrame> ParticleTable::read_next(ParticleFile& file, std::size_t frame) {
  if (is_of_series(file)) return read_of(file, std::min(frame + 1, file.frames() - 1));
  if (!options_.frame || !has_frame_slot(keys_.written)) return std::nullopt;
  const std::string name = frame_name(keys_.written, *options_.frame + 1);
  const std::shared_ptr<ParticleFile> other = open(name, table_.file_path(name));
  const auto number = other ? choose_frame(*other) : std::nullopt;
  return number ? read_of(*other, *number) : std::nullopt;
}

/// Whether the number of the series is that of a frame in the file.
bool ParticleTable::is_of_series(const ParticleFile& file) const {
  return !keys_.frame && options_.frame && file.frames() > 1 && !has_frame_slot(keys_.written);
}

/// Reads the file once more, to say in which line a radius is that cannot be used; none, if the
/// format has no lines, or where a particle that is not shown may be the first such.
Status ParticleTable::find_wrong_radius() const {
  std::vector<std::string> columns{"radius", "diameter"};
  if (const auto* rule = std::get_if<RadiusColumn>(&keys_.style.radius)) columns = {rule->name};
  if (!keys_.style.select.empty()) return {};
  for (const std::string& column : columns) {
    ParticleFileOptions options = keys_.file;
    options.positive = column;
    auto file = ParticleFile::open(keys_.path, options, options_.parallel_for);
    if (!file) return {};
    const auto frame = file.value().read(static_cast<long>(facts_.frame), options_.parallel_for);
    if (!frame && frame.error().line > 0) return frame.error();
  }
  return {};
}

/// The frame that the keys or the series ask for, from 0.
std::optional<std::size_t> ParticleTable::choose_frame(const ParticleFile& file) {
  const std::size_t frames = file.frames();
  const long asked = is_of_series(file) ? *options_.frame : keys_.frame.value_or(-1);
  const long count = static_cast<long>(frames);
  if (asked >= -count && asked < count) {
    return static_cast<std::size_t>(asked < 0 ? asked + count : asked);
  }
  const std::string cut = asked == count ? file.cut_text() : std::string();
  table_.report(
      keys_.frame ? "frame" : "file",
      quote(keys_.name) + " has no frame " + std::to_string(asked) + ", it has " +
          (count == 1 ? "one frame, number 0"
                      : std::to_string(count) + " frames, from 0 to " + std::to_string(count - 1)) +
          (cut.empty() ? "" : ": ") + cut);
  return std::nullopt;
}

/// Reports an error of the file: at its own line, else where the scene file names it.
void ParticleTable::report_file(const Diagnostic& error) {
  if (error.line > 0) return table_.report(error);
  for (const char* key : {"columns", "format", "topology"}) {
    if (error.key == key && table_.has(key)) return table_.report(key, error.message);
  }
  const std::string column = error.key.empty() ? "" : "column " + quote(error.key) + " ";
  table_.report("file", quote(keys_.name) + ": " + column + error.message);
}

/// Reports what ParticleSpheres::make() refuses, at the key that is at fault.
void ParticleTable::report_key(const Diagnostic& error) {
  const std::size_t dot = error.key.find('.');
  const std::string key = error.key.empty() ? "file" : error.key.substr(0, dot);
  if (dot != std::string::npos && table_.has_table(key)) {
    return table_.table(key)->report(error.key.substr(dot + 1), error.message);
  }
  table_.report(key, error.message);
}

}  // namespace

std::optional<TomlParticles> read_particles(TomlTable& table, const ParticleMaterialIds& materials,
                                            const SceneFileOptions& options, bool may_stream) {
  ParticleKeys keys = read_particle_keys(table, materials);
  if (!table.ok()) return std::nullopt;
  keys.path = table.file_path(keys.name);
  if (!keys.file.topology.empty()) keys.file.topology = table.file_path(keys.file.topology);
  return ParticleTable(table, std::move(keys), options, may_stream).read();
}

}  // namespace boule
