#include "render/apps/view/session/picture_saver.h"

#include "render/apps/view/session/picture_sender.h"
#include "render/apps/view/session/state_text.h"

namespace boule::view {
namespace {

constexpr StepLimit save_step{.seconds = 0.05};

}  // namespace

void PictureSaver::refuse(const Diagnostic& error, Asker asker) {
  audience_.answer(asker.client, error_text("save", error, asker.id));
}

void PictureSaver::begin(Asker asker, Scene scene, const RenderOptions& options) {
  auto job = SaveJob::create(std::move(scene), options);
  if (!job) return refuse(job.error(), asker);
  job_.emplace(std::move(job).value());
  asker_ = asker;
}

void PictureSaver::step(float stops) {
  if (!job_) return;
  if (const auto done = job_->step(save_step); !done) {
    refuse(done.error(), asker_);
    return job_.reset();
  }
  if (!job_->done())
    return audience_.report_to(asker_.client, "saving", saving_text(asker_.id, job_->share()));
  const auto image = job_->picture();
  job_.reset();
  image ? keep(image.value(), stops, asker_) : refuse(image.error(), asker_);
}

void PictureSaver::stop() {
  if (job_) refuse(Diagnostic::of("stopped"), asker_);
  job_.reset();
}

void PictureSaver::keep(const Image& image, float stops, Asker asker) {
  std::string bytes = png_of(image, stops);
  if (bytes.empty()) return refuse(Diagnostic::of("the picture cannot be made"), asker);
  const int number = pictures_.add({name_, std::move(bytes)});
  audience_.answer(
      asker.client,
      saved_text(asker.id, "/picture/" + std::to_string(number) + "?token=" + token_, name_));
}

}  // namespace boule::view
