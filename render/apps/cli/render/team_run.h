#pragma once

#include <vector>

#include "render/apps/cli/render/part_run.h"
#include "render/apps/team/team.h"

namespace boule::cli {

/// Renders a picture, or a shard of it, together with the other ranks of a team. The leader has the
/// sheet in the end; the others have none.
class TeamRun : public PartRun {
 public:
  /// `number` is that of the frame, or 0; all ranks the same.
  TeamRun(Renderer& renderer, LiveReport& live, FilmHead& head, const Checkpoint* checkpoint,
          Team& team, int number)
      : PartRun(renderer, live, head, checkpoint, team.leads() ? renderer.rect() : PixelRect{}),
        team_(team),
        number_(number) {}

  Status run(const std::vector<PixelRect>& blocks) override;
  [[nodiscard]] bool failed() const override { return failed_; }

  /// The leader's, of all ranks together.
  [[nodiscard]] const RayCounts& rays() const { return cost_.rays; }
  [[nodiscard]] const SampleFaults& faults() const { return cost_.faults; }

 private:
  /// What a block has cost: it goes before its part.
  struct Cost {
    RayCounts rays;
    SampleFaults faults;
  };

  [[nodiscard]] std::vector<std::uint32_t> unfinished(const std::vector<PixelRect>& blocks) const;
  void render(BlockTools& tools, const std::vector<PixelRect>& blocks);
  bool take(const PixelRect& block, std::string_view part);
  void tick();

  Team& team_;
  int number_;
  Cost cost_;
  bool failed_ = false;
  Status last_save_;         ///< an error if a checkpoint could not be replaced
  bool saves_soon_ = false;  ///< the ranks were told to be patient
};

}  // namespace boule::cli
