#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/view/panes/save_job.h"
#include "render/apps/view/session/mailbox.h"
#include "render/apps/view/session/outbox.h"
#include "render/apps/view/session/pane_stage.h"
#include "render/apps/view/session/picture_sender.h"
#include "render/apps/view/session/picture_store.h"
#include "render/apps/view/session/scene_source.h"
#include "render/apps/view/session/state_text.h"

namespace boule::view {

/// What the loop works with. All of it must outlive the loop.
struct LoopParts {
  SceneSource& source;
  Mailbox& mailbox;
  Outbox& outbox;
  PictureStore& pictures;
  std::string token;
};

/// Renders what the client wishes, as it wishes it: the thread that everything is computed on.
class ViewLoop {
 public:
  ViewLoop(const LoopParts& parts, WorkSettings work)
      : parts_(parts), stage_(std::move(work)), sender_(parts.outbox) {}

  /// Begins with the scene of a wish, and sets its camera, for it to become the mailbox' wish.
  Status open(LoadedScene loaded, Wish& first);
  /// Until the mailbox is stopped. Never throws.
  void run();

 private:
  using Clock = Mailbox::Clock;

  void handle(const News& news);
  void answer(const News& news);
  void reload();
  void send_state();
  void begin();
  void choose_stage();
  [[nodiscard]] StageShape wanted_shape() const;
  [[nodiscard]] int moving_scale() const;
  void render();
  [[nodiscard]] std::optional<double> allowance();
  void end_stage();
  void publish();
  void publish_pane(std::size_t pane, bool finished);
  void publish_difference(bool finished);
  [[nodiscard]] FrameHeader header(int pane) const;
  void report_statistics();
  void pick(const PickMessage& message);
  void save(const SaveMessage& message);
  void step_save();
  void finish_save(const Image& image, std::uint32_t id);
  void send_texts(const TextsMessage& message);
  [[nodiscard]] std::string command_of(std::size_t pane) const;
  [[nodiscard]] Clock::time_point next_time() const;
  [[nodiscard]] bool is_rendering() const;
  void fail(const std::string& about, const Diagnostic& error);

  LoopParts parts_;
  PaneStage stage_;
  PictureSender sender_;
  Wish wish_;        ///< the newest
  Wish shown_wish_;  ///< whose scene was read
  Wish start_;       ///< the first one
  SceneFigures figures_;
  std::vector<NumberRange> columns_;
  std::vector<std::string> notes_;
  std::optional<SaveJob> save_;
  std::optional<PickMessage> late_pick_;         ///< waits until the panes show the whole picture
  std::optional<DifferenceFigures> difference_;  ///< as it was sent last
  bool must_begin_ = false;                      ///< the wish is not what is rendered
  bool dirty_ = false;                           ///< there is more to see than was sent
  bool failed_ = false;                          ///< it cannot be rendered
  bool finished_sent_ = false;                   ///< the pictures at rest
  bool report_due_ = false;                      ///< the statistics have changed since
  std::uint32_t sent_number_ = 0;
  std::optional<Clock::time_point> finished_since_;  ///< when the last pixel at rest was done
  Clock::time_point last_sent_{}, last_report_{}, last_step_{};
  double pixels_due_ = 0;  ///< at a pace
};

}  // namespace boule::view
