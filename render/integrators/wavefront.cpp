#include "render/integrators/wavefront.h"

#include <utility>

namespace boule {

void Wavefront::start(RayBuffer& camera_rays) {
  const std::size_t samples = camera_rays.size();
  while (camera_sample_.size() < samples) {
    camera_sample_.push_back(static_cast<std::uint32_t>(camera_sample_.size()));
    camera_throughput_.push_back(gray(1));
    camera_density_.push_back(0);
  }
  // A run that was cancelled or failed may have left streams.
  if (running_) spare_.push_back(std::move(running_));
  recycle(waiting_);
  recycle(children_);
  depth_sums_.start(samples);
  current_ = {&camera_rays, camera_throughput_.data(), camera_sample_.data(),
              camera_density_.data(), 0};
  started_ = false;
}

const PathStream* Wavefront::next() {
  if (!started_) {
    started_ = true;
    if (current_.rays->size() == 0) return nullptr;
    use(current_);
    return &current_;
  }
  if (running_) spare_.push_back(std::move(running_));
  while (!children_.empty()) {  // so that the first child is on top
    waiting_.push_back(std::move(children_.back()));
    children_.pop_back();
  }
  if (waiting_.empty()) return nullptr;
  depth_sums_.finish_below(waiting_.front()->depth);
  running_ = std::move(waiting_.back());
  waiting_.pop_back();
  running_->rays.resize(running_->size);
  use({&running_->rays, running_->throughput.data(), running_->sample.data(),
       running_->density.data(), running_->depth});
  return &current_;
}

void Wavefront::use(PathStream stream) {
  current_ = stream;
  sums_ = depth_sums_.at_depth(stream.depth);
}

void Wavefront::spawn(std::size_t parent, const Ray& ray, const Color& weight, float density) {
  const Color throughput = light_product(current_.throughput[parent], weight);
  if (is_black(throughput)) return;
  if (children_.empty() || children_.back()->size == stream_size_) {
    children_.push_back(take_stream());
    children_.back()->depth = current_.depth + 1;
  }
  Stream& stream = *children_.back();
  stream.rays.set(stream.size, ray);
  stream.throughput[stream.size] = throughput;
  stream.sample[stream.size] = current_.sample[parent];
  stream.density[stream.size] = density;
  ++stream.size;
  ++spawned_;
}

Wavefront::StreamPtr Wavefront::take_stream() {
  StreamPtr stream;
  if (spare_.empty()) {
    stream = std::make_unique<Stream>();
    stream->throughput.resize(stream_size_);
    stream->sample.resize(stream_size_);
    stream->density.resize(stream_size_);
  } else {
    stream = std::move(spare_.back());
    spare_.pop_back();
  }
  stream->rays.resize(stream_size_);
  stream->size = 0;
  return stream;
}

void Wavefront::recycle(std::vector<StreamPtr>& streams) {
  for (StreamPtr& stream : streams) spare_.push_back(std::move(stream));
  streams.clear();
}

}  // namespace boule
