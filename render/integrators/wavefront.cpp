#include "render/integrators/wavefront.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace boule {

void Wavefront::start(RayBuffer& camera_rays) {
  const std::size_t samples = camera_rays.size();
  if (samples > most_samples_) {
    const std::size_t most = std::bit_ceil(samples);
    camera_throughput_.resize(most, 1);
    camera_density_.resize(most);
    camera_sample_.resize(most);
    for (std::size_t k = 0; k < most; ++k) camera_sample_[k] = static_cast<std::uint32_t>(k);
    most_samples_ = most;
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
    auto& to = children_.back()->size > 0 ? waiting_ : spare_;
    to.push_back(std::move(children_.back()));
    children_.pop_back();
  }
  if (waiting_.empty()) return nullptr;
  depth_sums_.finish_below(waiting_.front()->depth);
  running_ = std::move(waiting_.back());
  waiting_.pop_back();
  RayBuffer& rays = running_->rays.rays();
  rays.resize(running_->size);
  const GoingOn all = running_->rays.view();
  use({&rays, all.throughput, all.sample, all.density, running_->depth});
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

/// The stream to which the next `rays` rays belong.
Wavefront::Stream& Wavefront::open_stream(std::size_t rays) {
  const auto is_full = [&](const Stream& stream) {
    return stream.size > 0 && stream.size + rays > stream_size_;
  };
  if (children_.empty() || is_full(*children_.back())) {
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
  Stream& stream = open_stream(1);
  const std::size_t first = stream.size++;
  stream.rays.set(first, ray, throughput, current_.sample[parent]);
  count_spawned(stream, first);
}

GoingOn Wavefront::begin_spawning(std::size_t most) {
  Stream& stream = open_stream(most);
  return stream.rays.view(stream.size);
}

void Wavefront::end_spawning(const GoingOn& rays) {
  Stream& stream = *children_.back();
  const std::size_t first = stream.size;
  stream.size = rays.size;
  count_spawned(stream, first);
}

/// Counts the rays of a stream from `first` on, without those that are too faint.
void Wavefront::count_spawned(Stream& stream, std::size_t first) {
  if (left_out_ > 0) leave_out_faint(stream, first);
  spawned_ += stream.size - first;
}

/// Leaves out rays from `first` on, while their sample may lose more weight at this depth. The rays
/// of a sample and depth come in order, so the same ones are left out whatever the streams. The
/// fourth number of a sum, to which no light is added, is the weight left out so far.
void Wavefront::leave_out_faint(Stream& stream, std::size_t first) {
  ColorSum* const sums = depth_sums_.at_depth(stream.depth);
  const GoingOn rays = stream.rays.view();
  std::size_t size = first;
  for (std::size_t k = first; k < stream.size; ++k) {
    const float weight =
        std::max({rays.throughput.r[k], rays.throughput.g[k], rays.throughput.b[k]});
    float& left_out = sums[rays.sample[k]].rgb0[3];
    if (left_out + weight <= left_out_) {
      left_out += weight;
      continue;
    }
    if (size != k)
      stream.rays.set(size, stream.rays.rays().get(k),
                      {rays.throughput.r[k], rays.throughput.g[k], rays.throughput.b[k]},
                      rays.sample[k]);
    ++size;
  }
  stream.size = size;
}

Wavefront::StreamPtr Wavefront::take_stream() {
  StreamPtr stream;
  if (spare_.empty()) {
    stream = std::make_unique<Stream>();
  } else {
    stream = std::move(spare_.back());
    spare_.pop_back();
  }
  stream->rays.resize(room_);
  stream->size = 0;
  return stream;
}

void Wavefront::recycle(std::vector<StreamPtr>& streams) {
  while (!streams.empty()) {  // one by one: where memory ends, what is left is whole
    spare_.push_back(std::move(streams.back()));
    streams.pop_back();
  }
}

}  // namespace boule
