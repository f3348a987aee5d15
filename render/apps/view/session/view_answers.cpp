#include <utility>

#include "render/apps/view/messages/camera_edit.h"
#include "render/apps/view/messages/picked_text.h"
#include "render/apps/view/session/state_text.h"
#include "render/apps/view/session/view_loop.h"

/// What the loop answers to questions.
namespace boule::view {
namespace {

/// A word of a command line, in quotes where a shell needs them.
std::string word(const std::string& text) {
  constexpr const char* plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=+:,%@#";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos && text[0] != '#')
    return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

void ViewLoop::send_texts(const TextsMessage& message) {
  const Vec3d& origin = stage_.loaded().origin;
  parts_.audience.answer(message.client,
                         texts_text(message.id, camera_toml(wish_.camera, origin),
                                    command_of(static_cast<std::size_t>(message.pane))));
}

/// A lens is in a file that only the scene knows: it has no command.
std::string ViewLoop::command_of(std::size_t index) const {
  if (std::holds_alternative<LensCamera>(wish_.camera)) return {};
  const SourceFacts& facts = parts_.source.facts();
  const ViewSettings& settings = wish_.settings;
  const PaneSettings& pane = settings.panes[index];
  const std::string name = picture_name(facts.path, facts.numbered);
  std::string text = "boule render " + word(facts.path) + " -o " + word(name) + " --size " +
                     std::to_string(settings.width) + "x" + std::to_string(settings.height) +
                     " --spp " + std::to_string(settings.spp) + " --camera " +
                     word(camera_keys(wish_.camera, stage_.loaded().origin)) + " --method " +
                     std::string(name_of(pane.method)) + " --max-depth " +
                     std::to_string(settings.max_depth);
  if (pane.solver != Solver::robust) text += " --solver " + std::string(name_of(pane.solver));
  const ImageSettings& usual = stage_.scene().image;
  if (settings.outline != usual.outline) text += " --outline " + shortest(settings.outline);
  if (settings.fog != usual.fog) text += " --fog " + shortest(settings.fog);
  if (settings.exposure != 0) text += " --exposure " + shortest(settings.exposure);
  if (pane.shadow_epsilon)
    text += " --shadow-epsilon " +
            (*pane.shadow_epsilon == 0 ? std::string("none") : shortest(*pane.shadow_epsilon));
  return text + facts.shared_options + parts_.source.options_of(wish_.look, wish_.frame);
}

/// A save that waits may be stopped too.
void ViewLoop::answer_saves(const News& news) {
  auto saves = news.saves;
  for (const auto& [client, stop] : news.stops) {
    const auto waiting = saves.find(client);
    if (waiting != saves.end() && waiting->second.id == stop.id) {
      saver_.refuse(Diagnostic::of("stopped"), {client, stop.id});
      saves.erase(waiting);
    } else {
      saver_.stop({client, stop.id});
    }
  }
  for (const auto& [client, message] : saves) save(message);
}

void ViewLoop::save(const SaveMessage& message) {
  const Asker asker{message.client, message.id};
  if (saver_.is_busy()) return saver_.take_over(asker);
  const auto pane = static_cast<std::size_t>(message.pane);
  if (pane >= wish_.settings.panes.size())
    return saver_.refuse(Diagnostic::of("the panes have changed meanwhile"), asker);
  RenderOptions options = stage_.options(wish_, pane);
  options.spp = message.spp.value_or(options.spp);
  const bool is_shown = !must_begin_ && !failed_ && stage_.started() && stage_.done() &&
                        stage_.shape().kind == StageKind::rest && options.spp == wish_.settings.spp;
  if (is_shown) return saver_.keep(stage_.pane(pane).picture(), wish_.settings.exposure, asker);
  Scene scene = stage_.scene();
  scene.camera = wish_.camera;
  saver_.begin(asker, std::move(scene), options);
}

void ViewLoop::pick(const PickMessage& message) {
  const auto refuse = [&](const Diagnostic& error) {
    parts_.audience.answer(message.client, error_text("pick", error, message.id));
  };
  const auto pane = static_cast<std::size_t>(message.pane);
  const bool is_there = pane < wish_.settings.panes.size() && message.x < wish_.settings.width &&
                        message.y < wish_.settings.height;
  if (!is_there) return refuse(Diagnostic::of("the panes or the size have changed meanwhile"));
  auto scene = stage_.prepared(wish_, Method::whitted);
  if (!scene) return refuse(scene.error());
  if (!scene.value()) {  // once the panes have come to rest
    late_picks_[message.client] = message;
    return;
  }
  RenderOptions options = stage_.options(wish_, pane);
  options.method = Method::whitted;
  const auto renderer = Renderer::create(scene.value(), options);
  if (!renderer) return refuse(renderer.error());
  RayRecord record;
  const auto weight = renderer.value().record_pixel(message.x, message.y, record);
  if (!weight) return refuse(weight.error());
  parts_.audience.answer(message.client, picked_text({message, *scene.value(), stage_.loaded(),
                                                      record, weight.value()}));
}

}  // namespace boule::view
