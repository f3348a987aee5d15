#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/version.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/messages.h"
#include "render/apps/cli/render/rendering.h"
#include "render/apps/cli/report/picture_stream.h"
#include "render/frame/stopwatch.h"

namespace boule::cli {
namespace {

/// Rounded down to a tenth, so that 100 means all.
double percent_to_tenths(double share) { return std::floor(share * 1000) / 10; }

/// The blocks that are rendered: all of them, or those of the shard.
std::vector<PixelRect> blocks_of(const RenderCommand& command, const Renderer& renderer) {
  const RenderOptions& options = renderer.options();
  std::vector<PixelRect> blocks =
      blocks_of_shard(renderer.rect(), options.tile, command.shard.value_or(Shard{}));
  if ((command.partial || command.preview) && options.order == PixelOrder::rows) {
    std::sort(blocks.begin(), blocks.end(), [](const PixelRect& a, const PixelRect& b) {
      return a.y0 != b.y0 ? a.y0 < b.y0 : a.x0 < b.x0;
    });
  }
  return blocks;
}

/// The tile of a picture that a team renders: the same on all its ranks, whatever machines they
/// have.
int tile_of_team(const RenderOptions& options, const Team& team) {
  constexpr unsigned usual_threads = 8, most = 4096;
  const unsigned each = options.threads != 0 ? options.threads : usual_threads;
  const unsigned shares = std::min(each * static_cast<unsigned>(team.size()), most);
  return shared_tile(rendered_rect(options), static_cast<int>(shares), BlockDealer::blocks_each);
}

}  // namespace

ExitCode refuse(Diagnostic error, const RenderCommand& command, ExitCode code) {
  if (command.frame) error.message = fmt::format("frame {}: {}", *command.frame, error.message);
  return report(error, code);
}

/// What parts of pictures need beside all else: blocks that all processes agree on, a checkpoint.
ExitCode Rendering::prepare_parts(RenderOptions& options) {
  const bool is_free = command_.tile == 0;
  if (command_.shard && is_free)
    options.tile = shared_tile(rendered_rect(options), command_.shard->count);
  if (team_ != nullptr && is_free) options.tile = tile_of_team(options, *team_);
  if (team_ != nullptr || command_.checkpoint) options.cancel = &StopGuard::flag();
  if (!command_.checkpoint || !writes()) return done;
  ExitCode code = failed;
  auto checkpoint = Checkpoint::open(command_, code);
  if (!checkpoint) return refuse(checkpoint.error(), command_, code);
  checkpoint_ = std::move(checkpoint).value();
  return done;
}

FilmHead Rendering::film_head(const Renderer& renderer) const {
  const RenderOptions& options = renderer.options();
  FilmHead head;
  head.facts = facts_of(options, scene_hash_, library_version());
  const Shard shard = command_.shard.value_or(Shard{});
  head.share = {{"shard", fmt::format("{}/{}", shard.index, shard.count)}};
  head.metadata = picture_header(renderer, scene_hash_, origin_);
  for (auto& entry : resolution_header(size_choice(command_)))
    head.metadata.push_back(std::move(entry));
  head.frame_width = options.width;
  head.frame_height = options.height;
  head.rect = renderer.rect();
  head.spp = options.spp;
  head.transparent = options.transparent;
  head.kinds = kinds_of(options);
  if (shows_unfinished()) head.order = options.order;
  return head;
}

std::unique_ptr<PartRun> Rendering::part_run(Renderer& renderer, FilmHead& head) {
  const Checkpoint* const checkpoint = checkpoint_ ? &*checkpoint_ : nullptr;
  if (team_ == nullptr) {
    auto run = std::make_unique<PartRun>(renderer, live_, head, checkpoint, shows_unfinished());
    if (command_.preview) {
      run->show_every(command_.preview->interval,
                      [this, &renderer, &head, of = run.get()] { show(renderer, *of, head); });
    }
    return run;
  }
  return std::make_unique<TeamRun>(renderer, live_, head, checkpoint, *team_,
                                   command_.frame.value_or(0));
}

ExitCode Rendering::render_parts(Renderer& renderer) {
  FilmHead head = film_head(renderer);
  const std::unique_ptr<PartRun> run = part_run(renderer, head);
  live_.start_pass("pixels");
  const Status ended = run->run(blocks_of(command_, renderer));
  live_.end_pass();
  live_.end_time_limit();
  if (!writes()) return run->failed() ? refuse(ended.error(), command_, failed) : done;
  if (!ended && can_show(*run)) partial_ = samples_of(run->sheet(), head.blocks, head.spp);
  if (!ended && !partial_) {
    const ExitCode code = explain_parts(ended.error(), *run);
    checkpoint_.reset();  // the lock goes, whether this was a series or not
    return code;
  }
  if (const auto* team_run = dynamic_cast<const TeamRun*>(run.get())) add_team(renderer, *team_run);
  if (run->resumed() > 0 && tells_of_itself()) {
    report_.note(fmt::format("boule: note: {} had {:.1f} % of the samples", checkpoint_->file(),
                             percent_to_tenths(run->resumed())));
  }
  live_.start_stage("writing " + printable(shown_output(command_)));
  const ExitCode code = write_parts(renderer, *run, head);
  if (code == done && checkpoint_ && !partial_) checkpoint_->remove(command_.output);
  return code == done && StopGuard::caught() != 0 ? interrupted_by(StopGuard::caught()) : code;
}

/// Whether a run that was stopped has something to show, and may. What is not saved is an error.
bool Rendering::can_show(const PartRun& run) const {
  if (!command_.partial || run.failed() || (checkpoint_ && !run.saved())) return false;
  return run.sheet().done() > 0 || run.preview().total_samples() > 0;
}

/// Tells what the ranks did, if somebody asks.
void Rendering::add_team(const Renderer& renderer, const TeamRun& run) {
  of_team_ = renderer.statistics();
  of_team_->rays = run.rays();
  of_team_->faults = run.faults();
  const std::vector<RankWork> work = team_->work();
  std::size_t slowest = 0;
  const auto speed = [](const RankWork& one) {
    return one.seconds > 0 ? static_cast<double>(one.rays) / one.seconds / 1e6 : 0;
  };
  for (std::size_t i = 0; i < work.size(); ++i) {
    if (work[i].blocks > 0 && speed(work[i]) < speed(work[slowest])) slowest = i;
  }
  const TeamTraffic traffic = team_->traffic();
  report_.detail(fmt::format("{} ranks; slowest: rank {} on {}, {:.2f} Mray/s of a thread, {}",
                             work.size(), slowest, work[slowest].host, speed(work[slowest]),
                             counted(work[slowest].blocks, "block")));
  report_.detail(fmt::format("rank 0 sent and received {} in {} bytes",
                             counted(traffic.letters, "letter"), traffic.bytes));
}

/// The picture, as far as it is.
Image Rendering::image_of(const PartRun& run, const FilmHead& head) const {
  const Alpha alpha = head.transparent ? Alpha::coverage : Alpha::none;
  return partial_ ? run.sheet().partial_image(head.order, alpha, run.preview())
                  : run.sheet().image(alpha);
}

ExitCode Rendering::write_parts(Renderer& renderer, PartRun& run, const FilmHead& head) {
  if (command_.shard) {
    const ExitCode written = write_film(run, head);
    if (written != done) return written;
    Image size;
    size.width = head.rect.width();
    size.height = head.rect.height();
    return finish(renderer, size);
  }
  if (head.kinds.measured) noise_ = noise_reached(run.sheet().measured(), head.spp);
  const Image image = image_of(run, head);
  ImageFileOptions options = file_options(renderer);
  options.channels = run.sheet().release_channels();
  const ExitCode written = write(image, options);
  if (written == done && command_.preview) show(renderer, run, head);
  return written == done ? finish(renderer, image) : written;
}

ExitCode Rendering::write_film(const PartRun& run, const FilmHead& head) {
  const Stopwatch watch;
  const auto stop = [] { return WriteGuard::interrupted(); };
  const Status status =
      write_guarded([&] { return film_file::write(command_.output, head, run.sheet(), stop); },
                    "the film had been written");
  stats_.write_seconds = watch.seconds();
  return status ? done : refuse(status.error(), command_, failed);
}

/// What was stopped is told with what the checkpoint holds.
ExitCode Rendering::explain_parts(const Diagnostic& error, const PartRun& run) const {
  if (run.failed()) {
    const bool of_file = !error.file.empty();  // the checkpoint is damaged, or another picture's
    return refuse(error, command_, of_file ? invalid_input : failed);
  }
  if (!checkpoint_ && (team_ == nullptr || StopGuard::caught() == 0)) return explain(error);
  if (!checkpoint_) {  // the other ranks are waiting for this one's end
    print_note(fmt::format("boule: interrupted ({}), nothing written", StopGuard::caught_name()));
    return interrupted_by(StopGuard::caught());
  }
  if (!run.saved()) return refuse(error, command_, failed);
  const std::string cause = StopGuard::caught() != 0
                                ? fmt::format("interrupted ({})", StopGuard::caught_name())
                                : std::string("stopped by the time limit");
  print_note(fmt::format("boule: {}: {}, {} holds {:.1f} % of the samples; --resume goes on",
                         command_.output, cause, checkpoint_->file(),
                         percent_to_tenths(run.share())));
  return StopGuard::caught() != 0 ? interrupted_by(StopGuard::caught()) : failed;
}

}  // namespace boule::cli
