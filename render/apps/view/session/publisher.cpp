#include "render/apps/view/session/publisher.h"

#include <algorithm>
#include <chrono>

#include "render/apps/view/panes/difference.h"

namespace boule::view {
namespace {

using std::chrono::milliseconds;

/// How often a picture at rest is shown as it grows.
constexpr milliseconds time_between_frames{100}, time_between_reports{250};
/// The PNG waits for this: nobody who is about to move the camera has to wait for it.
constexpr milliseconds quiet_time{200};

}  // namespace

void Publisher::begin() {
  finished_since_.reset();
  finished_sent_ = false;
}

void Publisher::send_all_again() {
  dirty_ = true;
  finished_sent_ = false;
}

void Publisher::note_step() {
  dirty_ = true;
  last_step_ = Clock::now();
  if (stage_.done() && stage_.shape().kind == StageKind::rest) finished_since_ = last_step_;
}

Publisher::Clock::time_point Publisher::next_time() const {
  auto next = Clock::time_point::max();
  if (finished_since_ && !finished_sent_) next = std::min(next, *finished_since_ + quiet_time);
  if (dirty_) next = std::min(next, last_sent_ + time_between_frames);
  return next;
}

FrameHeader Publisher::header(const Wish& wish, int pane) const {
  FrameHeader header;
  header.pane = pane;
  header.moving = stage_.shape().kind == StageKind::moving;
  header.scale = stage_.shape().scale;
  header.number = wish.number;
  return header;
}

void Publisher::publish(const Wish& wish) {
  if (!stage_.started()) return;
  const auto now = Clock::now();
  if (finished_since_ && !finished_sent_ && now >= *finished_since_ + quiet_time) {
    finished_sent_ = true;
    dirty_ = false;
    return publish_panes(wish, true);
  }
  if (!dirty_) return;
  const bool moving = stage_.shape().kind == StageKind::moving;
  const bool urgent = sent_number_ != wish.number || moving || stage_.done();
  if (!urgent && now < last_sent_ + time_between_frames) return;
  if (audience_.holds_frame(0) && sent_number_ == wish.number && !stage_.done()) return;
  dirty_ = false;
  last_sent_ = now;
  sent_number_ = wish.number;
  publish_panes(wish, false);
}

void Publisher::publish_panes(const Wish& wish, bool finished) {
  for (std::size_t i = 0; i < stage_.size(); ++i) publish_pane(wish, i, finished);
  publish_difference(wish, finished);
}

void Publisher::publish_pane(const Wish& wish, std::size_t index, bool finished) {
  LivePane& pane = stage_.pane(index);
  const LivePane::Progress now = pane.progress();
  FrameHeader header = this->header(wish, static_cast<int>(index));
  header.passes = now.passes;
  header.share = static_cast<float>(now.share);
  const Image image = pane.picture();
  header.spp = static_cast<float>(static_cast<double>(now.samples) /
                                  static_cast<double>(image.pixels.size()));
  const float stops = wish.settings.exposure;
  if (!finished || !sender_.send_finished(image, header, stops)) sender_.send(image, header, stops);
}

void Publisher::publish_difference(const Wish& wish, bool finished) {
  const Difference kind = wish.settings.difference;
  difference_.reset();
  if (kind == Difference::none || stage_.size() < 2) return;
  const auto make = [&]() -> Result<DifferencePicture> {
    LivePane &a = stage_.pane(0), &b = stage_.pane(1);
    if (kind == Difference::color)
      return color_difference(a.picture(), b.picture(), wish.settings.exposure);
    const auto left = a.hits(), right = b.hits();
    if (!left) return left.error();
    if (!right) return right.error();
    return t_difference(left.value(), right.value(), a.options().width, a.options().height);
  };
  const auto made = make();
  if (!made) return;
  const Image& image = made.value().image;
  report_due_ = finished;
  difference_ = DifferenceFigures{made.value().pixels, made.value().largest};
  const FrameHeader header = this->header(wish, difference_pane);
  if (!finished || !sender_.send_finished(image, header, 0)) sender_.send(image, header, 0);
}

void Publisher::report_statistics(const Wish& wish) {
  const auto now = Clock::now();
  if (!stage_.started()) return;
  const bool last = (stage_.done() && last_report_ < last_step_) || report_due_;
  if (!last && (stage_.done() || now < last_report_ + time_between_reports)) return;
  last_report_ = now;
  report_due_ = false;
  audience_.report("statistics", statistics_text(wish.number, stage_, difference_));
}

}  // namespace boule::view
