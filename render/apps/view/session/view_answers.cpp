#include <filesystem>
#include <utility>

#include "render/apps/view/messages/camera_edit.h"
#include "render/apps/view/messages/picked_text.h"
#include "render/apps/view/session/state_text.h"
#include "render/apps/view/session/view_loop.h"

/// What the loop answers to questions.
namespace boule::view {
namespace {

constexpr StepLimit save_step{.seconds = 0.05};

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

/// "first_light.png" of "scenes/first_light.toml".
std::string picture_name(const std::string& path, const char* ending = ".png") {
  return std::filesystem::path(path).stem().string() + ending;
}

}  // namespace

void ViewLoop::send_texts(const TextsMessage& message) {
  const Vec3d& origin = stage_.loaded().origin;
  parts_.outbox.add_text(texts_text(message.id, camera_toml(wish_.camera, origin),
                                    command_of(static_cast<std::size_t>(message.pane))));
}

/// A lens is in a file that only the scene knows: it has no command.
std::string ViewLoop::command_of(std::size_t index) const {
  if (std::holds_alternative<LensCamera>(wish_.camera)) return {};
  const SourceFacts& facts = parts_.source.facts();
  const ViewSettings& settings = wish_.settings;
  const PaneSettings& pane = settings.panes[index];
  const std::string name = picture_name(facts.path, facts.numbered ? ".####.png" : ".png");
  std::string text = "boule render " + word(facts.path) + " -o " + word(name) + " --size " +
                     std::to_string(settings.width) + "x" + std::to_string(settings.height) +
                     " --spp " + std::to_string(settings.spp) + " --camera " +
                     word(camera_keys(wish_.camera, stage_.loaded().origin)) + " --method " +
                     std::string(name_of(pane.method)) + " --max-depth " +
                     std::to_string(settings.max_depth);
  if (pane.solver != Solver::robust) text += " --solver " + std::string(name_of(pane.solver));
  if (settings.exposure != 0) text += " --exposure " + shortest(settings.exposure);
  if (pane.shadow_epsilon)
    text += " --shadow-epsilon " +
            (*pane.shadow_epsilon == 0 ? std::string("none") : shortest(*pane.shadow_epsilon));
  return text + facts.shared_options + parts_.source.options_of(wish_.look, wish_.frame);
}

void ViewLoop::save(const SaveMessage& message) {
  if (save_) {
    parts_.outbox.add_text(
        error_text("save", Diagnostic::of("a picture is being saved already"), message.id));
    return;
  }
  const auto pane = static_cast<std::size_t>(message.pane);
  if (pane >= wish_.settings.panes.size()) return;  // the panes have changed meanwhile
  RenderOptions options = stage_.options(wish_, pane);
  options.spp = message.spp.value_or(options.spp);
  const bool is_shown = !must_begin_ && !failed_ && stage_.started() && stage_.done() &&
                        stage_.shape().kind == StageKind::rest && options.spp == wish_.settings.spp;
  if (is_shown) return finish_save(stage_.pane(pane).picture(), message.id);
  Scene scene = stage_.scene();
  scene.camera = wish_.camera;
  auto job = SaveJob::create(message.id, std::move(scene), options);
  if (!job) {
    parts_.outbox.add_text(error_text("save", job.error(), message.id));
    return;
  }
  save_.emplace(std::move(job).value());
}

/// Goes on with a picture that is saved, while nothing else moves.
void ViewLoop::step_save() {
  if (!save_ || parts_.mailbox.is_moving(Clock::now())) return;
  if (const auto done = save_->step(save_step); !done) {
    parts_.outbox.add_text(error_text("save", done.error(), save_->id()));
    return save_.reset();
  }
  if (!save_->done()) {
    parts_.outbox.report("saving", saving_text(save_->id(), save_->share()));
    return;
  }
  const std::uint32_t id = save_->id();
  const auto image = save_->picture();
  save_.reset();
  if (image) {
    finish_save(image.value(), id);
  } else {
    parts_.outbox.add_text(error_text("save", image.error(), id));
  }
}

void ViewLoop::finish_save(const Image& image, std::uint32_t id) {
  std::string bytes = png_of(image, wish_.settings.exposure);
  if (bytes.empty()) {
    parts_.outbox.add_text(error_text("save", Diagnostic::of("the picture cannot be made"), id));
    return;
  }
  const std::string name = picture_name(parts_.source.facts().path);
  const int number = parts_.pictures.add({name, std::move(bytes)});
  parts_.outbox.add_text(
      saved_text(id, "/picture/" + std::to_string(number) + "?token=" + parts_.token, name));
}

void ViewLoop::pick(const PickMessage& message) {
  const auto refuse = [&](const Diagnostic& error) {
    parts_.outbox.add_text(error_text("pick", error, message.id));
  };
  const auto pane = static_cast<std::size_t>(message.pane);
  const bool is_there = pane < wish_.settings.panes.size() && message.x < wish_.settings.width &&
                        message.y < wish_.settings.height;
  if (!is_there) return refuse(Diagnostic::of("the panes or the size have changed meanwhile"));
  auto scene = stage_.prepared(wish_, Method::whitted);
  if (!scene) return refuse(scene.error());
  if (!scene.value()) {  // once the panes have come to rest
    late_pick_ = message;
    return;
  }
  RenderOptions options = stage_.options(wish_, pane);
  options.method = Method::whitted;
  const auto renderer = Renderer::create(scene.value(), options);
  if (!renderer) return refuse(renderer.error());
  RayRecord record;
  const auto weight = renderer.value().record_pixel(message.x, message.y, record);
  if (!weight) return refuse(weight.error());
  parts_.outbox.add_text(
      picked_text({message, *scene.value(), stage_.loaded(), record, weight.value()}));
}

}  // namespace boule::view
