#include "render/image/band_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <optional>
#include <utility>
#include <variant>

#include "core/base/float_environment.h"
#include "render/image/image_format.h"
#include "render/image/image_plan.h"
#include "render/image/module/module_loader.h"
#include "render/image/output_file.h"
#include "render/image/tone.h"

namespace boule {
namespace {

namespace module = image_module;

/// The Diagnostic of a Report, or none if it is `done`.
Status status_of(const module::Report& report, const std::string& path) {
  switch (report.outcome) {
    case module::Outcome::done:
      return {};
    case module::Outcome::stopped:
      return cannot_write(path, "interrupted");
    case module::Outcome::system_error:
      return cannot_write(path, report.code);
    case module::Outcome::failed:
      break;
  }
  return cannot_write(path, report.text);
}

/// Checks that the file can be opened: OpenImageIO opens it next and would not say why it fails.
Status check_openable(const OutputFile& file, const std::string& path) {
  const int descriptor = open(file.path().c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return cannot_write(path, errno);
  close(descriptor);
  return {};
}

/// Calls `write`, and turns its exceptions into Diagnostics about this file.
template <class Write>
auto guarded(const std::string& path, const Write& write) -> decltype(write()) {
  const FloatEnvironment environment;
  try {
    return write();
  } catch (const std::bad_alloc&) {
    return cannot_write(path, ENOMEM);
  } catch (const std::exception& other) {  // of a callback
    return cannot_write(path, other.what());
  } catch (...) {
    return cannot_write(path, "an unknown exception");
  }
}

bool has_samples(const ImageChannel& channel, const ChannelForm& form, std::size_t pixels) {
  const bool is_integer = std::holds_alternative<std::vector<std::uint32_t>>(channel.samples);
  const auto count =
      std::visit([](const auto& samples) { return samples.size(); }, channel.samples);
  return channel.name == form.name && is_integer == form.is_integer && count == pixels;
}

/// What is wrong with a band, or an empty text.
std::string band_problem(const Image& band, const std::vector<ImageChannel>& channels,
                         const ImageForm& form, int rows_left) {
  const std::size_t pixels = band.pixels.size();
  if (band.width != form.width || band.height < 1 || band.height > rows_left ||
      pixels != static_cast<std::size_t>(band.width) * static_cast<std::size_t>(band.height)) {
    return "the picture has no pixels";
  }
  if (band.alpha.size() != (form.alpha == Alpha::none ? 0 : pixels))
    return "the picture has not one alpha per pixel";
  for (std::size_t i = 0; i < form.channels.size(); ++i) {
    if (i >= channels.size() || !has_samples(channels[i], form.channels[i], pixels))
      return "channel " + quote(form.channels[i].name) + " has not one sample per pixel";
  }
  return {};
}

/// Where the samples of R, G, B, A and of the other channels are; `codes` are of LDR formats.
std::vector<module::Samples> samples_of(const Image& band,
                                        const std::vector<ImageChannel>& channels, bool hdr,
                                        const std::vector<std::uint8_t>& codes) {
  static_assert(sizeof(Color) == 3 * sizeof(float));
  std::vector<module::Samples> samples;
  const std::size_t count = band.alpha.empty() ? 3 : 4;
  const auto* floats = reinterpret_cast<const unsigned char*>(band.pixels.data());
  const auto* alpha = reinterpret_cast<const unsigned char*>(band.alpha.data());
  for (std::size_t i = 0; i < count; ++i) {
    if (!hdr) {
      samples.push_back({codes.data() + i, count});
    } else if (i < 3) {
      samples.push_back({floats + i * sizeof(float), sizeof(Color)});
    } else {
      samples.push_back({alpha, sizeof(float)});
    }
  }
  for (const ImageChannel& channel : channels) {
    const void* first =
        std::visit([](const auto& values) { return static_cast<const void*>(values.data()); },
                   channel.samples);
    samples.push_back({static_cast<const unsigned char*>(first), 4});
  }
  return samples;
}

}  // namespace

struct BandWriter::State {
  std::string path;
  const ImageFormat* format = nullptr;
  float exposure_stops = 0;
  std::shared_ptr<const PixelLayer> layer;
  std::function<void(const std::string&)> temporary;
  std::unique_ptr<ImagePlan> plan;
  std::optional<OutputFile> file;  ///< none: it is the caller's
  const module::Table* table = nullptr;
  module::Writer* writer = nullptr;  ///< null: there was a failure, or the file is finished
  int rows = 0;                      ///< so far

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { abandon(); }

  void abandon() {
    module::Report ignored{};
    if (writer != nullptr) table->close(std::exchange(writer, nullptr), &ignored);
    file.reset();
  }
  /// The Diagnostic of a report. What `stop` threw goes on from here.
  [[nodiscard]] Status status(const module::Report& report) const {
    if (plan->thrown) std::rethrow_exception(std::exchange(plan->thrown, nullptr));
    return status_of(report, path);
  }
  Status begin(int descriptor, int threads);
  Status put(const Image& band, const std::vector<ImageChannel>& channels);
  Status finish();
};

Status BandWriter::State::begin(int descriptor, int threads) {
  const auto loaded = load_image_writer(*format, threads);
  if (!loaded) return cannot_write(path, loaded.error().message);
  table = loaded.value().table;
  plan->picture.threads = loaded.value().threads;
  module::Report report{};
  writer = table->open(&plan->picture, descriptor, &report);
  return status(report);
}

Status BandWriter::State::put(const Image& band, const std::vector<ImageChannel>& channels) {
  if (writer == nullptr) return cannot_write(path, "it has failed before");
  if (const auto problem = band_problem(band, channels, plan->form, plan->form.height - rows);
      !problem.empty()) {
    return cannot_write(path, problem);
  }
  std::vector<std::uint8_t> codes;
  if (!format->hdr) codes = tone_map(band, exposure_stops);
  if (layer) draw_over(*layer, rows, band.alpha.empty() ? 3 : 4, codes);
  const auto samples = samples_of(band, channels, format->hdr, codes);
  module::Report report{};
  table->put(writer, samples.data(), band.height, &report);
  rows += band.height;
  return status(report);
}

Status BandWriter::State::finish() {
  if (writer == nullptr) return cannot_write(path, "it has failed before");
  if (rows < plan->form.height) return cannot_write(path, "the picture has too few rows");
  module::Report report{};
  table->close(std::exchange(writer, nullptr), &report);
  if (auto done = status(report); !done) return done;
  if (!file) return {};
  if (auto done = check_openable(*file, path); !done) return done;
  table->check(&plan->picture, file->path().c_str(), &report);
  if (auto done = status(report); !done) return done;
  if (auto done = file->sync(); !done) return done;
  if (temporary) temporary({});
  return file->commit(plan->stop);
}

BandWriter::BandWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
BandWriter::BandWriter(BandWriter&& other) noexcept = default;
BandWriter& BandWriter::operator=(BandWriter&& other) noexcept = default;
BandWriter::~BandWriter() = default;

Result<BandWriter> BandWriter::open(const ImageForm& form, const std::string& path,
                                    const ImageFileOptions& options) {
  return guarded(path, [&]() -> Result<BandWriter> {
    auto state = std::make_unique<State>();
    state->path = path;
    state->format = find_image_format(path);
    auto plan = make_plan(form, path, options, state->format);
    if (!plan) return plan.error();
    state->plan = std::move(plan).value();
    state->exposure_stops = options.exposure_stops;
    state->layer = options.layer;
    state->temporary = options.temporary;
    // The file comes first, so that a missing folder is reported without loading anything.
    Result<OutputFile> created = OutputFile::create(path, options.stop);
    if (!created.ok()) return created.error();
    state->file.emplace(std::move(created).value());
    if (options.temporary) options.temporary(state->file->path());
    if (auto done = state->begin(state->file->descriptor(), options.threads); !done)
      return done.error();
    return BandWriter(std::move(state));
  });
}

Result<BandWriter> BandWriter::open_png(const ImageForm& form, const OpenFile& file,
                                        const ImageFileOptions& options) {
  return guarded(file.name, [&]() -> Result<BandWriter> {
    auto state = std::make_unique<State>();
    state->path = file.name;
    state->format = find_image_format("picture.png");
    auto plan = make_plan(form, file.name, options, state->format);
    if (!plan) return plan.error();
    state->plan = std::move(plan).value();
    state->exposure_stops = options.exposure_stops;
    state->layer = options.layer;
    if (auto done = state->begin(file.descriptor, options.threads); !done) return done.error();
    return BandWriter(std::move(state));
  });
}

Status BandWriter::put(const Image& band, const std::vector<ImageChannel>& channels) {
  if (!state_) return Diagnostic::of("the writer was moved away");
  Status done = guarded(state_->path, [&] { return state_->put(band, channels); });
  if (!done) state_->abandon();
  return done;
}

Status BandWriter::finish() {
  if (!state_) return Diagnostic::of("the writer was moved away");
  Status done = guarded(state_->path, [&] { return state_->finish(); });
  state_->abandon();
  return done;
}

}  // namespace boule
