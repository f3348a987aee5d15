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
  absent_since_.reset();
}

PictureSaver::Clock::time_point PictureSaver::next_time(Clock::time_point now) const {
  if (!job_) return Clock::time_point::max();
  return absent_since_ ? *absent_since_ + longest_absence_ : now;
}

void PictureSaver::step(float stops) {
  if (!job_ || absent_since_) return;
  if (const auto done = job_->step(save_step); !done) return fail(done.error());
  if (!job_->done())
    return audience_.report_to(asker_.client, "saving", saving_text(asker_.id, job_->share()));
  const auto image = job_->picture();
  job_.reset();
  image ? keep(image.value(), stops, asker_) : refuse(image.error(), asker_);
}

void PictureSaver::take_over(Asker asker) {
  if (asker == asker_) return;  // it has asked twice
  if (asker.id == asker_.id && !is_client_here()) {
    asker_ = asker;
    absent_since_.reset();
    return;
  }
  const char* const whose = asker.client == asker_.client ? "this" : "another";
  refuse(Diagnostic::of(std::string(whose) + " page is saving a picture: wait until it has it"),
         asker);
}

void PictureSaver::give_up_absent(Clock::time_point now) {
  if (!job_ || is_client_here()) return;
  if (!absent_since_) absent_since_ = now;
  if (now - *absent_since_ >= longest_absence_) job_.reset();
}

void PictureSaver::stop(Asker asker) {
  if (job_ && asker == asker_) return fail(Diagnostic::of("stopped"));
  audience_.answer(asker.client,
                   error_text("stop_saving", Diagnostic::of("you save no such picture"), asker.id));
}

void PictureSaver::fail(const Diagnostic& error) {
  if (job_) refuse(error, asker_);
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
