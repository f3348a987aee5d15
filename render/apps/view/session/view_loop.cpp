#include "render/apps/view/session/view_loop.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/base/float_environment.h"
#include "render/apps/view/session/state_text.h"

namespace boule::view {
namespace {

using std::chrono::milliseconds;

/// How long the loop renders before it looks for news.
constexpr double step_seconds = 0.025;
/// A moving picture is to be rendered within this time; a step then lasts until it is whole.
constexpr double moving_seconds = 0.035, longest_moving_step = 0.06;

bool is_frameless(const ViewSettings& settings) {
  return std::any_of(settings.panes.begin(), settings.panes.end(),
                     [](const PaneSettings& pane) { return pane.order == PixelOrder::frameless; });
}

double seconds_of(Mailbox::Clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

std::string picture_name(const std::string& path, bool numbered) {
  return std::filesystem::path(path).stem().string() + (numbered ? ".####.png" : ".png");
}

ViewLoop::ViewLoop(const LoopParts& parts, WorkSettings work)
    : parts_(parts),
      stage_(std::move(work)),
      publisher_(stage_, parts.audience),
      saver_(parts.audience, parts.pictures, picture_name(parts.source.facts().path, false),
             parts.token, parts.longest_absence) {}

Status ViewLoop::open(LoadedScene loaded, Wish& first) {
  const FloatEnvironment floats;
  stage_.set_scene(std::move(loaded));
  auto camera = stage_.scene_camera(first.settings.width, first.settings.height);
  if (!camera) return camera.error();
  first.camera = std::move(camera).value();
  notes_ = stage_.loaded().notes;
  figures_ = figures_of(stage_.loaded());
  columns_ = parts_.source.columns();
  parts_.mailbox.set_origin(stage_.loaded().origin);
  wish_ = shown_wish_ = start_ = first;
  must_begin_ = true;
  return {};
}

void ViewLoop::run() {
  const FloatEnvironment floats;
  while (true) {
    try {
      const News news = parts_.mailbox.wait_until(next_time(), wish_);
      if (news.stop) return;
      handle(news);
      saver_.give_up_absent(Clock::now());
      if (parts_.audience.size() == 0) continue;
      choose_stage();
      for (const auto& [client, late] : std::exchange(late_picks_, {})) pick(late);
      render();
      if (!failed_) publisher_.publish(wish_);
      if (!parts_.mailbox.is_moving(Clock::now())) saver_.step(wish_.settings.exposure);
      if (!failed_) publisher_.report_statistics(wish_);
    } catch (const std::exception& error) {
      fail("scene", Diagnostic::of(error.what()));
    }
  }
}

/// When there is something to do even if nothing comes.
ViewLoop::Clock::time_point ViewLoop::next_time() const {
  const auto now = Clock::now();
  // A picture is not saved while the camera moves.
  const auto saving = std::max(saver_.next_time(now), parts_.mailbox.moving_until());
  const auto later = std::min(now + std::chrono::hours(1), saving);
  if (parts_.audience.size() == 0) return later;
  if (must_begin_ && !failed_) return now;
  if (is_rendering()) return wish_.settings.pace > 0 ? last_step_ + milliseconds(30) : now;
  auto next = later;
  if (!failed_ && stage_.shape().kind == StageKind::moving)
    next = std::min(next, parts_.mailbox.moving_until());
  return std::min(next, publisher_.next_time());
}

bool ViewLoop::is_rendering() const { return !failed_ && stage_.started() && !stage_.done(); }

void ViewLoop::handle(const News& news) {
  if (news.scene) reload();
  if (news.camera || news.settings || news.scene) must_begin_ = true;
  if (must_begin_) failed_ = false;
  if (news.connected || news.settings || news.scene || news.camera_type) send_state();
  if (news.camera) send_camera(news.mover);
  if (news.connected) publisher_.send_all_again();
  answer(news);
}

void ViewLoop::answer(const News& news) {
  for (const auto& [client, message] : news.picks) pick(message);
  for (const auto& [client, message] : news.texts) send_texts(message);
  answer_saves(news);
}

/// Reads the scene of the wish. If that fails, the wish is taken back.
void ViewLoop::reload() {
  parts_.audience.add_text(busy_text("reading " + parts_.source.facts().path));
  auto loaded = parts_.source.load(wish_.look, wish_.frame);
  parts_.audience.add_text(busy_text({}));
  if (!loaded) {
    wish_.look = shown_wish_.look;
    wish_.frame = shown_wish_.frame;
    parts_.mailbox.correct(wish_);
    parts_.audience.add_text(error_text("scene", loaded.error()));
    return;
  }
  stage_.set_scene(std::move(loaded).value());
  notes_ = stage_.loaded().notes;
  figures_ = figures_of(stage_.loaded());
  columns_ = parts_.source.columns();
  parts_.mailbox.set_origin(stage_.loaded().origin);
  shown_wish_ = wish_;
}

void ViewLoop::send_state() {
  parts_.audience.add_text(state_text(
      {wish_, parts_.source.facts(), stage_.loaded(), columns_, notes_, figures_, start_}));
}

/// Tells the clients of a camera that another one moves; the mover too, once it rests: others may
/// have moved it meanwhile.
void ViewLoop::send_camera(int mover) {
  if (parts_.audience.size() < 2) return;
  parts_.audience.report_to_others(mover, "camera",
                                   camera_text(wish_.number, wish_.camera, stage_.loaded().origin));
}

void ViewLoop::fail(const std::string& about, const Diagnostic& error) {
  failed_ = true;
  must_begin_ = false;
  saver_.fail(error);
  parts_.audience.add_text(error_text(about, error));
}

/// How coarse a moving picture must be. Order frameless need not be: it shows its pixels as they
/// come; and at a pace the order is what somebody wants to see.
int ViewLoop::moving_scale() const {
  if (is_frameless(wish_.settings) || wish_.settings.pace > 0) return 1;
  const double pixels = static_cast<double>(wish_.settings.width) * wish_.settings.height;
  const double seconds = pixels * stage_.sample_seconds();
  for (const int scale : {1, 2, 3, 4, 6, 8, 12}) {
    if (seconds <= moving_seconds * scale * scale) return scale;
  }
  return 16;
}

StageShape ViewLoop::wanted_shape() const {
  if (parts_.mailbox.is_moving(Clock::now())) return {StageKind::moving, moving_scale()};
  const bool was_coarse = stage_.started() && stage_.shape().scale > 1;
  const bool unknown = !stage_.started() || !(stage_.sample_seconds() > 0);
  if ((was_coarse || unknown) && wish_.settings.spp > 1) return {StageKind::preview, 1};
  return {StageKind::rest, 1};
}

/// Begins anew where the wish or the movement asks for it.
void ViewLoop::choose_stage() {
  if (failed_) return;
  const StageKind kind = stage_.shape().kind;
  const bool stopped = kind == StageKind::moving && !must_begin_ && stage_.started() &&
                       !parts_.mailbox.is_moving(Clock::now());
  const bool previewed = kind == StageKind::preview && !must_begin_ && stage_.done();
  if (must_begin_ || stopped) {
    begin();
  } else if (previewed) {
    if (auto done = stage_.begin(wish_, {StageKind::rest, 1}, parts_.mailbox.overtaken()); !done)
      fail("settings", done.error());
  }
}

void ViewLoop::begin() {
  const StageShape shape = wanted_shape();
  must_begin_ = false;
  publisher_.begin();
  pixels_due_ = 0;
  if (auto done = stage_.begin(wish_, shape, parts_.mailbox.overtaken()); !done)
    fail("settings", done.error());
}

/// How many pixels a step may render at a pace; none: wait.
std::optional<double> ViewLoop::allowance() {
  const auto now = Clock::now();
  const double passed = std::min(seconds_of(now - last_step_), 0.1);
  last_step_ = now;
  if (!(wish_.settings.pace > 0)) return std::numeric_limits<double>::infinity();
  pixels_due_ += wish_.settings.pace * passed;
  constexpr double smallest_block = 64;
  if (pixels_due_ < smallest_block) return std::nullopt;
  return std::exchange(pixels_due_, 0);
}

void ViewLoop::render() {
  if (!is_rendering()) return;
  const auto pixels = allowance();
  if (!pixels) return;
  const bool moving = stage_.shape().kind == StageKind::moving;
  // A moving picture that is coarse enough is made whole; another one is shown as it comes.
  const bool whole = moving && wish_.settings.pace == 0 && !is_frameless(wish_.settings);
  const double seconds = whole ? longest_moving_step : step_seconds;
  if (const auto done = stage_.step({seconds, *pixels}); !done) {
    if (!parts_.mailbox.overtaken()) return fail("scene", done.error());
    must_begin_ = true;
    return;
  }
  publisher_.note_step();
}

}  // namespace boule::view
