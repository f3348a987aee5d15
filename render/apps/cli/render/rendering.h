#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "render/apps/cli/options/options.h"
#include "render/apps/cli/process/exit_code.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/cli/render/checkpoint.h"
#include "render/apps/cli/render/part_run.h"
#include "render/apps/cli/render/team_run.h"
#include "render/apps/cli/report/live_report.h"
#include "render/apps/cli/report/run_report.h"
#include "render/apps/cli/report/stats.h"
#include "render/apps/job/overlay/overlay.h"
#include "render/apps/job/picture/picture_header.h"
#include "render/apps/job/scene_loader.h"
#include "render/files/scene_file/scene_file.h"
#include "render/frame/stopwatch.h"
#include "render/image/image_start.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// One run of `boule render` for one picture. It goes step by step; a step that fails returns its
/// exit code.
class Rendering {
 public:
  /// All must outlive it. A series has one of each for all its frames. `team` may be null; else its
  /// ranks render the picture together, and the leader writes it.
  Rendering(RenderCommand command, LiveReport& live, SceneLoader& loader, Team* team = nullptr)
      : command_(std::move(command)),
        live_(live),
        loader_(loader),
        team_(team),
        report_(command_, command_, live),
        reading_limit_(command_.load_limit) {}

  ExitCode run();

  /// After run(): whether the picture was there already, and else its statistics.
  [[nodiscard]] bool skipped() const { return skipped_; }
  [[nodiscard]] const Stats& stats() const { return stats_; }

 private:
  /// Loads the scene and moves it into the renderer: it may take half the memory, so no copy stays.
  /// Returns done without a renderer if the picture is there already.
  ExitCode prepare(std::optional<Renderer>& renderer);
  Result<LoadedScene> load();
  [[nodiscard]] Status check_module(bool draws) const;
  Status keep_facts(LoadedScene& loaded);
  Status complete_overlay(Renderer& renderer);
  ExitCode render(Renderer& renderer);
  /// Also the AOVs that tell of its noise, into `channels`.
  Result<Image> make_image(Renderer& renderer, std::vector<ImageChannel>& channels);
  ExitCode render_whole(Renderer& renderer);
  /// The same for a picture that is written while it is rendered.
  ExitCode render_bands(Renderer& renderer);
  /// The same for a picture whose samples are kept: with a checkpoint, or of which this is a shard.
  ExitCode render_parts(Renderer& renderer);
  ExitCode prepare_parts(RenderOptions& options);
  [[nodiscard]] Image image_of(const PartRun& run, const FilmHead& head) const;
  /// Writes the picture as far as it is, if a preview of it is asked for. A note if it cannot.
  void show(const Renderer& renderer, const PartRun& run, const FilmHead& head);
  ExitCode write_parts(Renderer& renderer, PartRun& run, const FilmHead& head);
  ExitCode write_film(const PartRun& run, const FilmHead& head);
  /// Whether the picture is written before it is finished.
  [[nodiscard]] bool shows_unfinished() const { return command_.partial || command_.preview; }
  [[nodiscard]] bool can_show(const PartRun& run) const;
  ExitCode explain_parts(const Diagnostic& error, const PartRun& run) const;
  [[nodiscard]] FilmHead film_head(const Renderer& renderer) const;
  std::unique_ptr<PartRun> part_run(Renderer& renderer, FilmHead& head);
  void add_team(const Renderer& renderer, const TeamRun& run);
  /// Whether this process writes the picture.
  [[nodiscard]] bool writes() const { return team_ == nullptr || team_->leads(); }
  ExitCode explain(const Diagnostic& error) const;
  ExitCode write(const Image& image, ImageFileOptions options);
  Status write_shown(const Image& image, const std::string& output, ImageFileOptions file) const;
  /// Calls write(options), with what it must do at signals.
  template <class Write>
  Status guarded_write(ImageFileOptions options, const Write& write);
  void tell_written() const;
  ExitCode finish(const Renderer& renderer, const Image& image);
  void tell_end(const Image& image) const;
  [[nodiscard]] bool tells_of_itself() const;
  [[nodiscard]] ImageFileOptions file_options(const Renderer& renderer) const;

  const RenderCommand command_;  ///< before what refers to it
  LiveReport& live_;
  SceneLoader& loader_;
  Team* const team_;
  RunReport report_;
  ReadingLimit reading_limit_;
  bool skipped_ = false;
  Stopwatch watch_;
  Stats stats_;
  std::string date_;  ///< the file's time stamp
  std::uint64_t scene_hash_ = 0;
  Vec3d origin_;                           ///< that the scene's points are counted from
  std::optional<PartialSamples> partial_;  ///< none: the picture is finished
  bool draws_ = false;                     ///< something is drawn on the picture
  OverlayFacts overlay_;
  std::vector<ParticleFacts> labelled_;  ///< tables whose labels are drawn
  std::optional<NoiseReached> noise_;    ///< none: it was not measured
  std::optional<Checkpoint> checkpoint_;
  std::optional<RenderStatistics> of_team_;  ///< what all ranks traced
  std::optional<ImageStart> image_start_;    ///< loads the image module while the scene is prepared
};

/// report() with the number of the frame, if any.
ExitCode refuse(Diagnostic error, const RenderCommand& command, ExitCode code);

}  // namespace boule::cli
