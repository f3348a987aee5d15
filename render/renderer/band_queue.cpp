#include "render/renderer/band_queue.h"

#include "render/frame/stopwatch.h"

namespace boule {

BandQueue::BandQueue(const Bands& bands, Alpha alpha, bool has_lines, const Take& take)
    : bands_(bands), alpha_(alpha), has_lines_(has_lines), take_(take), slots_(bands.in_memory()) {}

/// Memory is taken when the slot is used first; the last band may be lower.
void BandQueue::open_band(std::size_t band) {
  Band& mine = slot(band);
  mine.rect = bands_[band];
  if (mine.image.height != mine.rect.height())
    mine.image = Image(mine.rect.width(), mine.rect.height(), alpha_);
  if (has_lines_) mine.lines.emplace(mine.rect);
  mine.blocks_left = bands_.blocks_in(band);
}

BandQueue::Band* BandQueue::begin(std::size_t block) {
  const std::size_t band = bands_.band_of(block);
  std::unique_lock lock(mutex_);
  if (!stopped_ && band >= taken_ + slots_.size()) {
    const Stopwatch watch;
    freed_.wait(lock, [&] { return stopped_ || band < taken_ + slots_.size(); });
    seconds_taken_ += watch.seconds();
  }
  if (stopped_) return nullptr;
  for (; opened_ <= band; ++opened_) open_band(opened_);
  return &slot(band);
}

bool BandQueue::may_hand_over() const {
  return !stopped_ && !taking_ && taken_ < opened_ &&
         slots_[taken_ % slots_.size()].blocks_left == 0;
}

void BandQueue::end(std::size_t block) {
  std::unique_lock lock(mutex_);
  --slot(bands_.band_of(block)).blocks_left;
  while (may_hand_over()) {
    const Stopwatch watch;
    taking_ = true;
    Band& band = slot(taken_);
    lock.unlock();
    if (band.lines) band.lines->draw(band.image);
    Status taken = take_(band.image);
    lock.lock();
    taking_ = false;
    ++taken_;
    seconds_taken_ += watch.seconds();
    if (!taken) {
      status_ = std::move(taken);
      stopped_ = true;
    }
    freed_.notify_all();
  }
}

void BandQueue::stop() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  freed_.notify_all();
}

}  // namespace boule
