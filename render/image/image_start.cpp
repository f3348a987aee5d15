#include "render/image/image_start.h"

#include <algorithm>
#include <cerrno>
#include <new>
#include <utility>

#include "render/image/built_in_table.h"
#include "render/image/image_format.h"
#include "render/image/module/module_loader.h"
#include "render/image/output_file.h"
#include "render/threads/threads.h"

namespace boule {

ImageStart::ImageStart(std::string path, int threads) : path_(std::move(path)), threads_(threads) {
  const ImageFormat* const format = find_image_format(path_);
  if (format != nullptr && built_in_table(*format) != nullptr) {
    done_ = true;
    return;
  }
  // For the loading, and the loops beside it.
  Threads::prepare(static_cast<std::size_t>(std::max(threads, 1)));
  thread_ = std::make_unique<Threads>(1, [this](std::size_t) { run(); });
  if (thread_->size() == 0) run();
}

ImageStart::~ImageStart() = default;

Status ImageStart::wait() {
  thread_.reset();  // joins it
  if (out_of_memory_) return cannot_write(path_, ENOMEM);
  return status_;
}

void ImageStart::run() {
  try {
    status_ = load();
  } catch (const std::bad_alloc&) {
    out_of_memory_ = true;
  }
  done_ = true;
}

Status ImageStart::load() const {
  const ImageFormat* const format = find_image_format(path_);
  if (format == nullptr) return cannot_write(path_, unknown_image_extension());
  const auto loaded = load_image_writer(*format, threads_);
  return loaded ? Status() : cannot_write(path_, loaded.error().message);
}

}  // namespace boule
