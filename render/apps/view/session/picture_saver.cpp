#include "render/apps/view/session/picture_saver.h"

#include "render/apps/view/session/picture_sender.h"
#include "render/apps/view/session/state_text.h"

namespace boule::view {
namespace {

constexpr StepLimit save_step{.seconds = 0.05};

}  // namespace

void PictureSaver::refuse(const Diagnostic& error, std::uint32_t id) {
  outbox_.add_text(error_text("save", error, id));
}

void PictureSaver::begin(std::uint32_t id, Scene scene, const RenderOptions& options) {
  auto job = SaveJob::create(id, std::move(scene), options);
  if (!job) return refuse(job.error(), id);
  job_.emplace(std::move(job).value());
}

void PictureSaver::step(float stops) {
  if (!job_) return;
  const std::uint32_t id = job_->id();
  if (const auto done = job_->step(save_step); !done) {
    refuse(done.error(), id);
    return job_.reset();
  }
  if (!job_->done()) return outbox_.report("saving", saving_text(id, job_->share()));
  const auto image = job_->picture();
  job_.reset();
  image ? keep(image.value(), stops, id) : refuse(image.error(), id);
}

void PictureSaver::stop() {
  if (job_) refuse(Diagnostic::of("stopped"), job_->id());
  job_.reset();
}

void PictureSaver::keep(const Image& image, float stops, std::uint32_t id) {
  std::string bytes = png_of(image, stops);
  if (bytes.empty()) return refuse(Diagnostic::of("the picture cannot be made"), id);
  const int number = pictures_.add({name_, std::move(bytes)});
  outbox_.add_text(
      saved_text(id, "/picture/" + std::to_string(number) + "?token=" + token_, name_));
}

}  // namespace boule::view
