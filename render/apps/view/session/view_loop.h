#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/view/session/audience.h"
#include "render/apps/view/session/mailbox.h"
#include "render/apps/view/session/pane_stage.h"
#include "render/apps/view/session/picture_saver.h"
#include "render/apps/view/session/picture_store.h"
#include "render/apps/view/session/publisher.h"
#include "render/apps/view/session/scene_source.h"
#include "render/apps/view/session/state_text.h"

namespace boule::view {

/// What the loop works with. All of it must outlive the loop.
struct LoopParts {
  SceneSource& source;
  Mailbox& mailbox;
  Audience& audience;
  PictureStore& pictures;
  std::string token;
  std::chrono::milliseconds longest_absence;  ///< of a client whose picture is saved
};

/// "first_light.png" of "scenes/first_light.toml"; "pour.####.png" of frames with numbers.
std::string picture_name(const std::string& path, bool numbered);

/// Renders what the clients wish, as they wish it: the thread that everything is computed on.
class ViewLoop {
 public:
  ViewLoop(const LoopParts& parts, WorkSettings work);

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
  void send_camera(int mover);
  void begin();
  void choose_stage();
  [[nodiscard]] StageShape wanted_shape() const;
  [[nodiscard]] int moving_scale() const;
  void render();
  [[nodiscard]] std::optional<double> allowance();
  void pick(const PickMessage& message);
  void answer_saves(const News& news);
  void save(const SaveMessage& message);
  void send_texts(const TextsMessage& message);
  [[nodiscard]] std::string command_of(std::size_t pane) const;
  [[nodiscard]] Clock::time_point next_time() const;
  [[nodiscard]] bool is_rendering() const;
  void fail(const std::string& about, const Diagnostic& error);

  LoopParts parts_;
  PaneStage stage_;
  Publisher publisher_;
  PictureSaver saver_;
  Wish wish_;        ///< the newest
  Wish shown_wish_;  ///< whose scene was read
  Wish start_;       ///< the first one
  SceneFigures figures_;
  std::vector<NumberRange> columns_;
  std::vector<std::string> notes_;
  std::map<int, PickMessage> late_picks_;  ///< wait until the panes show the whole picture
  bool must_begin_ = false;                ///< the wish is not what is rendered
  bool failed_ = false;                    ///< it cannot be rendered
  Clock::time_point last_step_{};
  double pixels_due_ = 0;  ///< at a pace
};

}  // namespace boule::view
