#include "render/integrators/wavefront.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace boule {

void Wavefront::start(RayBuffer& camera_rays) {
  const std::size_t samples = camera_rays.size();
  if (samples > most_samples_) {
    most_samples_ = std::bit_ceil(samples);
    camera_throughput_.resize(most_samples_, 1);
    camera_density_.resize(most_samples_);
    camera_sample_.resize(most_samples_);
    for (std::size_t k = 0; k < most_samples_; ++k)
      camera_sample_[k] = static_cast<std::uint32_t>(k);
  }
  // A run that was cancelled or failed may have left streams.
  if (running_) spare_.push_back(std::move(running_));
  recycle(waiting_);
  recycle(children_);
  depth_sums_.start(samples);
  current_ = {&camera_rays, camera_throughput_.view(), camera_sample_.data(),
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
  use({&running_->rays, running_->throughput.view(), running_->sample.data(),
       running_->density.data(), running_->depth});
  return &current_;
}

void Wavefront::use(PathStream stream) {
  current_ = stream;
  sums_ = depth_sums_.at_depth(stream.depth);
}

void Wavefront::add(const ColorStream& radiance) {
  kernels_.add_weighted_light(
      {current_.throughput, radiance, current_.sample, current_.rays->size()}, sums_);
}

/// The stream to which the next ray belongs.
Wavefront::Stream& Wavefront::open_stream() {
  if (children_.empty() || children_.back()->size == stream_size_) {
    children_.push_back(take_stream());
    children_.back()->depth = current_.depth + 1;
  }
  return *children_.back();
}

void Wavefront::spawn(std::size_t parent, const Ray& ray, const Color& weight) {
  const ColorStream& before = current_.throughput;
  const Color throughput =
      light_product({before.r[parent], before.g[parent], before.b[parent]}, weight);
  if (is_black(throughput)) return;
  Stream& stream = open_stream();
  stream.rays.set(stream.size, ray);
  stream.throughput.set(stream.size, throughput);
  stream.sample[stream.size] = current_.sample[parent];
  stream.density[stream.size] = 0;
  ++stream.size;
  ++spawned_;
}

void Wavefront::spawn(const GoingOn& rays) {
  for (std::size_t done = 0; done < rays.size;) {
    Stream& stream = open_stream();
    const std::size_t count = std::min(rays.size - done, stream_size_ - stream.size);
    const auto copy = [&](const auto* from, auto* to) {
      std::copy_n(from + done, count, to + stream.size);
    };
    RayStream to = stream.rays.view();
    each_array(copy, rays.rays, to);
    const ColorStream throughput = stream.throughput.view();
    copy(rays.throughput.r, throughput.r);
    copy(rays.throughput.g, throughput.g);
    copy(rays.throughput.b, throughput.b);
    copy(rays.sample, stream.sample.data());
    copy(rays.density, stream.density.data());
    stream.size += count;
    done += count;
  }
  spawned_ += rays.size;
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
