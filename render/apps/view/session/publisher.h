#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "render/apps/view/session/audience.h"
#include "render/apps/view/session/mailbox.h"
#include "render/apps/view/session/pane_stage.h"
#include "render/apps/view/session/picture_sender.h"
#include "render/apps/view/session/state_text.h"

namespace boule::view {

/// Sends what a stage has rendered, and its statistics: as often as somebody can see it. The stage
/// and the audience must outlive it.
class Publisher {
 public:
  using Clock = Mailbox::Clock;

  Publisher(PaneStage& stage, Audience& audience)
      : stage_(stage), audience_(audience), sender_(audience) {}

  /// The stage begins anew.
  void begin();
  /// Somebody has come who has seen nothing yet.
  void send_all_again();
  /// The stage has rendered more, just now.
  void note_step();
  /// Sends what there is to see: the first picture of a new wish at once, others now and then.
  void publish(const Wish& wish);
  /// Sends the statistics, now and then and at the end.
  void report_statistics(const Wish& wish);
  /// When there will be something to send; the latest possible time if nothing waits.
  [[nodiscard]] Clock::time_point next_time() const;

 private:
  void publish_panes(const Wish& wish, bool finished);
  void publish_pane(const Wish& wish, std::size_t index, bool finished);
  void publish_difference(const Wish& wish, bool finished);
  [[nodiscard]] FrameHeader header(const Wish& wish, int pane) const;

  PaneStage& stage_;
  Audience& audience_;
  PictureSender sender_;
  std::optional<DifferenceFigures> difference_;  ///< as it was sent last
  bool dirty_ = false;                           ///< there is more to see than was sent
  bool finished_sent_ = false;                   ///< the pictures at rest
  bool report_due_ = false;                      ///< the statistics have changed since
  std::uint32_t sent_number_ = 0;
  std::optional<Clock::time_point> finished_since_;  ///< when the last pixel at rest was done
  Clock::time_point last_sent_{}, last_report_{}, last_step_{};
};

}  // namespace boule::view
