// The quality of the tree: its cost by the surface area heuristic, how full its leaves are, its
// bytes and those of all that a picture keeps, how many nodes and leaves a camera ray visits, and
// the kernels' rays per second.
//
//   bench_tree [spheres...]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "bench/scenes/camera_rays.h"
#include "bench/scenes/uniform_spheres.h"
#include "core/optics/camera_builder.h"
#include "core/scene/camera.h"
#include "simd/abi/isa.h"
#include "simd/dispatch/dispatch.h"
#include "simd/geometry/geometry.h"
#include "simd/stream/stream_buffer.h"

namespace boule::bench {
namespace {

constexpr unsigned side = 1024;

double area(const BvhNode& n, std::size_t k) {
  const double x = double{n.max_x[k]} - double{n.min_x[k]};
  const double y = double{n.max_y[k]} - double{n.min_y[k]};
  const double z = double{n.max_z[k]} - double{n.min_z[k]};
  return x * y + y * z + z * x;
}

/// Expected visits of a random line that meets the root's box, and how full the tree is.
struct Figures {
  double nodes = 1, leaves = 0;  ///< visits
  double leaf_fill = 0, node_fill = 0;
};

Figures figures(const BvhView& bvh) {
  Figures f;
  double spheres = 0, leaf_count = 0, children = 0;
  BvhNode whole = bvh.nodes[0];
  for (std::size_t k = 1; k < whole.size; ++k) {
    whole.min_x[0] = std::min(whole.min_x[0], whole.min_x[k]);
    whole.min_y[0] = std::min(whole.min_y[0], whole.min_y[k]);
    whole.min_z[0] = std::min(whole.min_z[0], whole.min_z[k]);
    whole.max_x[0] = std::max(whole.max_x[0], whole.max_x[k]);
    whole.max_y[0] = std::max(whole.max_y[0], whole.max_y[k]);
    whole.max_z[0] = std::max(whole.max_z[0], whole.max_z[k]);
  }
  const double root = area(whole, 0);
  for (std::size_t i = 0; i < bvh.size; ++i) {
    const BvhNode& node = bvh.nodes[i];
    children += node.size;
    for (std::size_t k = 0; k < node.size; ++k) {
      (node.leaf_size[k] > 0 ? f.leaves : f.nodes) += area(node, k) / root;
      spheres += node.leaf_size[k];
      leaf_count += node.leaf_size[k] > 0 ? 1 : 0;
    }
  }
  f.leaf_fill = spheres / leaf_count;
  f.node_fill = children / static_cast<double>(bvh.size);
  return f;
}

void make_rays(RayBuffer& rays) {
  SampleBuffer samples = pixel_centers(side);
  PinholeCamera camera;
  camera.pose = {{0.5F, 0.5F, -1.2F}, {0.5F, 0.5F, 0.5F}, {0, 1, 0}};
  camera.fov = 25.61F;
  rays.resize(std::size_t{side} * side, CommonPart::origin);
  reference_kernels().primary_rays(build_camera(camera, side, side), samples.view(), rays.view());
}

/// Counts the nodes and leaves that one ray visits, nearest first, until its nearest hit is
/// certain.
struct Visits {
  std::uint64_t nodes = 0, leaves = 0;
};

void visit(const BvhView& bvh, const Ray& ray, double limit, std::uint32_t index, Visits& visits) {
  const BvhNode& node = bvh.nodes[index];
  ++visits.nodes;
  for (std::size_t k = 0; k < node.size; ++k) {
    double near = 0, far = limit;
    const auto cut = [&](float low, float high, double org, float dir) {
      const double a = (double{low} - org) / double{dir}, b = (double{high} - org) / double{dir};
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    };
    cut(node.min_x[k], node.max_x[k], ray.org.x, ray.dir.x);
    cut(node.min_y[k], node.max_y[k], ray.org.y, ray.dir.y);
    cut(node.min_z[k], node.max_z[k], ray.org.z, ray.dir.z);
    if (near > far) continue;
    if (node.leaf_size[k] > 0) {
      ++visits.leaves;
    } else {
      visit(bvh, ray, limit, node.child[k], visits);
    }
  }
}

/// Bytes a sphere takes while a picture is made: nodes, leaves and ids, what is scanned as arrays
/// (SphereView: six floats). Materials are no part of it, spheres share them.
struct Bytes {
  double tree, all;
};

Bytes bytes_per_sphere(const GeometryView& view, std::size_t n) {
  const std::size_t slots = view.spheres.block_count * bvh_leaf_size;
  const std::size_t tree = view.bvh.size * sizeof(BvhNode) +
                           view.spheres.block_count * sizeof(SphereBlock) +
                           slots * sizeof(std::int32_t);
  const std::size_t arrays = padded(view.spheres.scanned) * 6 * sizeof(float);
  const auto count = static_cast<double>(n);
  return {static_cast<double>(tree) / count, static_cast<double>(tree + arrays) / count};
}

double seconds_of(const KernelTable& kernels, const GeometryView& geometry, RayBuffer& rays,
                  HitBuffer& hits, Form form) {
  std::vector<double> times;
  for (int repetition = 0; repetition < 5; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    kernels.closest_hit(geometry, rays.view(), {Solver::robust, form}, hits.view());
    times.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  return times[1];
}

void report(std::size_t n, RayBuffer& rays) {
  const auto spheres = uniform_spheres(n);
  const Geometry geometry(spheres, {}, Structure::bvh);
  const GeometryView view = geometry.view();
  const Figures f = figures(view.bvh);
  const Bytes bytes = bytes_per_sphere(view, n);
  HitBuffer hits(rays.size());
  const KernelTable& kernels = *select_kernels("avx2").value();
  const double count = static_cast<double>(rays.size());
  const double packet = count / seconds_of(kernels, view, rays, hits, Form::packet) * 1e-6;
  const double single = count / seconds_of(kernels, view, rays, hits, Form::single) * 1e-6;
  Visits visits;
  for (std::size_t i = 0; i < rays.size(); i += 16)
    visit(view.bvh, rays.get(i), hits.get(i).t, 0, visits);
  std::printf(
      "u%-8zu SAH nodes %6.2f leaves %6.2f sum %6.2f | fill leaf %.2f node %.2f | "
      "B/sphere tree %5.1f all %5.1f | visits/ray nodes %6.2f leaves %6.2f | "
      "Mray/s packet %6.2f single %6.2f\n",
      n, f.nodes, f.leaves, f.nodes + f.leaves, f.leaf_fill, f.node_fill, bytes.tree, bytes.all,
      static_cast<double>(visits.nodes) * 16 / count,
      static_cast<double>(visits.leaves) * 16 / count, packet, single);
}

}  // namespace
}  // namespace boule::bench

int main(int argc, char** argv) {
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  if (sizes.empty()) sizes = {1000, 10'000, 100'000, 1'000'000};
  boule::RayBuffer rays;
  boule::bench::make_rays(rays);
  for (const std::size_t n : sizes) boule::bench::report(n, rays);
  return 0;
}
