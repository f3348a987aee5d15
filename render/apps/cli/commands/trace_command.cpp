#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "render/apps/cli/commands/commands.h"
#include "render/apps/cli/options/trace_options.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/cli/report/live_report.h"
#include "render/apps/cli/report/output_check.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/scene_file/scene_file.h"
#include "render/files/trace_file/hit_file.h"
#include "render/files/trace_file/point_file.h"
#include "render/files/trace_file/ray_file.h"
#include "render/frame/scheduler.h"
#include "render/frame/stopwatch.h"
#include "render/memory/available_memory.h"
#include "render/renderer/queries/point_order.h"
#include "render/renderer/tracer.h"

namespace boule::cli {
namespace {

/// Rays or points in memory at a time, so that a file of any length will do.
constexpr std::uint64_t rays_of_chunk = std::uint64_t{1} << 18;

/// Errors in the command that show without reading any file.
Status check(const TraceCommand& command) {
  if (auto done = check_questions(command); !done) return done;
  if (!is_npy_name(command.output)) {
    return wrong_option(
        "hits are written as .npy, which is not the extension of " + quote(command.output),
        "--output");
  }
  std::vector<std::string> inputs = {command.scene};
  for (const std::string& name : {command.rays, command.points}) {
    if (!name.empty()) inputs.push_back(name);
  }
  return check_run(command, command, "hits", inputs);
}

/// The file with what is asked about: neither for pairs.
struct Questions {
  std::optional<RayFile> rays;
  std::optional<PointFile> points;

  [[nodiscard]] std::uint64_t size() const {
    if (points) return points->size();
    return rays ? rays->size() : 0;
  }
  void count_from(const Vec3d& zero) {
    if (rays) rays->count_from(zero);
    if (points) points->count_from(zero);
  }
};

/// An error and the exit code it leads to.
struct Failure {
  Diagnostic error;
  ExitCode code;
};

/// One run of `boule trace`, step by step; each step that fails leaves its exit code.
class Tracing {
 public:
  explicit Tracing(const TraceCommand& command)
      : command_(command),
        kind_(kind_of(command)),
        live_(command),
        report_(command, command, live_),
        limit_(command.load_limit),
        scheduler_(command.threads) {}

  ExitCode run();

 private:
  Result<LoadedScene> load();
  Result<Questions> open_questions();
  Status read_chunk(Questions& questions, std::size_t size);
  ExitCode write(Questions& questions, Tracer& tracer);
  Result<HitFile> create_file(std::uint64_t size);
  std::optional<Failure> trace_to_file(Questions& questions, Tracer& tracer);
  std::optional<Failure> trace_chunks(Questions& questions, Tracer& tracer, HitFile& file);
  Status trace_chunk(Tracer& tracer);
  Status ask_chunk(Tracer& tracer);
  Status append_chunk(HitFile& file);
  void show_progress(const Progress& progress, std::uint64_t all);
  ExitCode finish(const Tracer& tracer);
  void tell_end() const;

  const TraceCommand& command_;
  HitKind kind_;
  LiveReport live_;
  RunReport report_;
  ReadingLimit limit_;
  Scheduler scheduler_;
  Stopwatch watch_;
  Stats stats_;
  std::vector<Ray> rays_;  ///< of the chunk, and so are its answers
  std::vector<TracedHit> hits_;
  std::vector<std::uint8_t> met_;
  Crossings crossings_;
  std::vector<std::int64_t> counts_;
  std::vector<double> lengths_;
  std::vector<Vec3d> points_;
  std::vector<double> distances_;
  std::vector<std::int32_t> ids_;
  Members members_;
  SpherePairs pairs_;
  std::uint64_t chunk_ = rays_of_chunk;
  std::uint64_t traced_ = 0;  ///< rays or points of the chunks before
  std::uint64_t hit_count_ = 0;
  std::uint64_t lost_ = 0;  ///< as RayFile::lost()
};

Result<LoadedScene> Tracing::load() {
  live_.start_stage("reading " + printable(command_.scene));
  const ReadingLimit::Reading reading(limit_, command_.scene);
  return SceneLoader({command_}).load(std::nullopt);
}

Result<Questions> Tracing::open_questions() {
  Questions questions;
  if (!command_.rays.empty()) {
    const ReadingLimit::Reading reading(limit_, command_.rays);
    auto rays = RayFile::open(command_.rays);
    if (!rays) return rays.error();
    questions.rays = std::move(rays).value();
  }
  if (!command_.points.empty()) {
    const ReadingLimit::Reading reading(limit_, command_.points);
    auto points = PointFile::open(command_.points);
    if (!points) return points.error();
    questions.points = std::move(points).value();
  }
  return questions;
}

Status Tracing::read_chunk(Questions& questions, std::size_t size) {
  if (questions.points) {
    const ReadingLimit::Reading reading(limit_, command_.points);
    points_.resize(size);
    if (auto done = questions.points->read(points_); !done) return done;
    if (auto done = check_points(points_, traced_); !done) {
      Diagnostic error = done.error();
      error.file = command_.points;
      return error;
    }
  }
  if (questions.rays) {
    const ReadingLimit::Reading reading(limit_, command_.rays);
    rays_.resize(size);
    return questions.rays->read(rays_);
  }
  return {};
}

ExitCode Tracing::run() {
  if (auto done = check(command_); !done) return report(done.error(), wrong_usage);
  if (auto done = check_stats_target(command_.stats); !done) return report(done.error(), failed);
  if (auto done = check_output(command_.output); !done) return report(done.error(), failed);
  auto loaded = load();
  if (!loaded) return report(loaded.error(), code_of_loading(loaded.error()));
  if (auto done = check_data_files(command_, "hits", loaded.value().data_files); !done)
    return report(done.error(), wrong_usage);
  auto questions = open_questions();
  if (!questions) return report(questions.error(), invalid_input);
  stats_.load_seconds = watch_.seconds();
  report_.loaded(loaded.value(), stats_.load_seconds);
  questions.value().count_from(loaded.value().origin);
  live_.start_stage("preparing " + printable(command_.scene));

  TraceOptions options;
  options.solver = command_.solver;
  options.threads = command_.threads;
  options.isa = command_.isa;
  options.progress = [this, all = questions.value().size()](const Progress& progress) {
    show_progress(progress, all);
  };
  auto tracer = Tracer::create(std::move(loaded.value().scene), options);
  if (!tracer) return report(tracer.error(), failed);
  live_.end_stage();
  report_.prepared(tracer.value().statistics());
  if (auto& rays = questions.value().rays) rays->limit_sources(tracer.value().primitives());
  return write(questions.value(), tracer.value());
}

ExitCode Tracing::write(Questions& questions, Tracer& tracer) {
  std::optional<Failure> failure;
  {
    const WriteGuard guard;
    failure = trace_to_file(questions, tracer);
    if (!failure) set_written("the hits had been written");
  }
  exit_if_interrupted();
  live_.end_pass();
  return failure ? report(failure->error, failure->code) : finish(tracer);
}

/// Chunks of points are smaller if each has many answers.
Result<HitFile> Tracing::create_file(std::uint64_t size) {
  const auto stop = [] { return WriteGuard::interrupted(); };
  if (kind_ == HitKind::nearest) {
    const std::uint64_t k = command_.nearest.value_or(1);
    chunk_ = std::max<std::uint64_t>(rays_of_chunk / k, 1);
    const std::uint64_t bytes =
        std::min(size, chunk_) * k * (sizeof(double) + sizeof(std::int32_t));
    if (auto done = check_memory(bytes, "the nearest objects of points need"); !done)
      return done.error();
    return HitFile::create_nearest(command_.output, size, k, stop);
  }
  return HitFile::create(command_.output, kind_, size, stop);
}

std::optional<Failure> Tracing::trace_to_file(Questions& questions, Tracer& tracer) {
  auto file = create_file(questions.size());
  if (!file) return Failure{file.error(), failed};
  {
    const RemovalGuard removal(file.value().temporary());
    live_.start_pass(command_.pairs ? "spheres" : (questions.points ? "points" : "rays"));
    if (auto bad = trace_chunks(questions, tracer, file.value())) return bad;
    live_.end_pass();
    live_.start_stage("writing " + printable(command_.output));
    const Stopwatch watch;
    if (auto done = file.value().sync(); !done) return Failure{done.error(), failed};
    stats_.write_seconds += watch.seconds();
  }
  tell_sending(command_.output);
  const Stopwatch watch;
  if (auto done = file.value().commit([] { return WriteGuard::interrupted(); }); !done) {
    return Failure{done.error(), failed};
  }
  stats_.write_seconds += watch.seconds();
  return std::nullopt;
}

/// Traces at least one chunk: a file without rays is no special case.
std::optional<Failure> Tracing::trace_chunks(Questions& questions, Tracer& tracer, HitFile& file) {
  do {
    const std::uint64_t left = questions.size() - traced_;
    const auto size = static_cast<std::size_t>(std::min(left, chunk_));
    const Stopwatch reading;
    if (auto done = read_chunk(questions, size); !done) return Failure{done.error(), invalid_input};
    stats_.load_seconds += reading.seconds();
    if (auto done = trace_chunk(tracer); !done) return Failure{done.error(), failed};
    const Stopwatch writing;
    if (auto done = append_chunk(file); !done) return Failure{done.error(), failed};
    stats_.write_seconds += writing.seconds();
    traced_ += size;
  } while (traced_ < questions.size());
  if (questions.rays) lost_ = questions.rays->lost();
  return std::nullopt;
}

Status Tracing::trace_chunk(Tracer& tracer) {
  const std::size_t size = rays_.size();
  switch (kind_) {
    case HitKind::closest:
      hits_.resize(size);
      return tracer.closest(rays_, hits_);
    case HitKind::any:
      met_.resize(size);
      return tracer.any(rays_, met_);
    case HitKind::all: {
      auto found = tracer.all_hits(rays_, command_.limit);
      if (!found) return found.error();
      crossings_ = std::move(found).value();
      return {};
    }
    case HitKind::count:
      counts_.resize(size);
      return tracer.count(rays_, counts_);
    case HitKind::chord:
      lengths_.resize(size);
      return tracer.chord(rays_, lengths_);
    case HitKind::nearest:
    case HitKind::members:
    case HitKind::pairs:
      return ask_chunk(tracer);
  }
  return {};
}

/// The same about points and pairs.
Status Tracing::ask_chunk(Tracer& tracer) {
  if (kind_ == HitKind::nearest) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::size_t k = command_.nearest.value_or(1);
    distances_.resize(points_.size() * k);
    ids_.resize(points_.size() * k);
    return tracer.nearest(points_, k, command_.within.value_or(infinity),
                          {distances_.data(), ids_.data()});
  }
  if (kind_ == HitKind::members) {
    auto found = tracer.within(points_, command_.within.value_or(0));
    if (!found) return found.error();
    members_ = std::move(found).value();
    return {};
  }
  auto found = tracer.pairs(command_.pairs.value_or(0));
  if (!found) return found.error();
  pairs_ = std::move(found).value();
  return {};
}

/// Appends the answers of the chunk, and counts the hits among them.
Status Tracing::append_chunk(HitFile& file) {
  const auto count_hits = [this](const auto& answers, const auto& is_hit) {
    hit_count_ += static_cast<std::uint64_t>(std::count_if(answers.begin(), answers.end(), is_hit));
  };
  switch (kind_) {
    case HitKind::closest:
      count_hits(hits_, [](const TracedHit& hit) { return hit.id != no_primitive; });
      return file.append(hits_);
    case HitKind::any:
      count_hits(met_, [](std::uint8_t met) { return met != 0; });
      return file.append(met_);
    case HitKind::all:
      hit_count_ += crossings_.t.size();
      return file.append(crossings_, traced_);
    case HitKind::count:
      count_hits(counts_, [](std::int64_t count) { return count > 0; });
      return file.append(counts_);
    case HitKind::chord:
      count_hits(lengths_, [](double length) { return length > 0; });
      return file.append(lengths_);
    case HitKind::nearest:
      count_hits(ids_, [](std::int32_t id) { return id != no_primitive; });
      return file.append(distances_, ids_);
    case HitKind::members:
      hit_count_ += members_.id.size();
      return file.append(members_, traced_);
    case HitKind::pairs:
      hit_count_ += pairs_.gap.size();
      return file.append(pairs_);
  }
  return {};
}

/// Shows the progress of one chunk as part of `all` rays or points.
void Tracing::show_progress(const Progress& progress, std::uint64_t all) {
  if (command_.pairs) return live_.update({progress.share});
  const std::uint64_t done = traced_ + progress.rays;
  const double share = all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 1;
  live_.update({share, done});
}

/// Writes the final line and the statistics.
ExitCode Tracing::finish(const Tracer& tracer) {
  const TraceStatistics tracing = tracer.statistics();
  static_cast<RunStatistics&>(stats_) = static_cast<const RunStatistics&>(tracing);
  stats_.work_seconds = tracing.trace_seconds;
  stats_.rays = tracing.rays;
  stats_.points = tracing.points;
  stats_.total_seconds = watch_.seconds();
  live_.end_stage();
  try {
    tell_end();
  } catch (const std::bad_alloc&) {  // the hits are written: a missing line is no failure
  }
  return report_.finish(stats_);
}

void Tracing::tell_end() const {
  if (lost_ > 0) {
    report_.note(
        fmt::format("{}: warning: {} with a direction beyond the range of float32: a miss for each",
                    command_.rays, counted(lost_, "ray")));
  }
  report_.detail(fmt::format("written in {:.3f} s", stats_.write_seconds));
  const std::string how = fmt::format("({}, {})", stats_.isa, counted(stats_.threads, "thread"));
  if (kind_ == HitKind::pairs) {
    report_.note(fmt::format("boule: {}: {}, {:.2f} s {}", command_.output,
                             counted(hit_count_, "pair"), stats_.work_seconds, how));
  } else if (!command_.points.empty()) {
    report_.note(fmt::format("boule: {}: {}, {} near them, {:.2f} s {}", command_.output,
                             counted(stats_.points, "point"), counted(hit_count_, "object"),
                             stats_.work_seconds, how));
  } else {
    report_.note(fmt::format("boule: {}: {}, {}, {:.2f} s, {:.1f} Mray/s {}", command_.output,
                             counted(stats_.rays, "ray"), counted(hit_count_, "hit"),
                             stats_.work_seconds, mrays_per_s(stats_), how));
  }
}

}  // namespace

ExitCode run(const TraceCommand& command) { return Tracing(command).run(); }

}  // namespace boule::cli
