#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "render/apps/python/pictures/picture.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/presence.h"
#include "render/apps/python/values/values.h"
#include "simd/dispatch/dispatch.h"

namespace py = pybind11;

namespace boule::python {
namespace {

[[noreturn]] void refuse_state() { throw_error("state", "is none that boule has pickled"); }

/// Plain values as the bytes that they have in memory.
template <class T>
py::bytes bytes_of(const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// The way back. `count`: how many there are, where that is known.
template <class T>
std::vector<T> values_in(const py::handle& bytes) {
  const std::string_view memory = py::cast<std::string_view>(bytes);
  if (memory.size() % sizeof(T) != 0) refuse_state();
  std::vector<T> values(memory.size() / sizeof(T));
  if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), memory.data(), memory.size());
  return values;
}
template <class T>
std::vector<T> values_in(const py::handle& bytes, std::size_t count) {
  std::vector<T> values = values_in<T>(bytes);
  if (values.size() != count) refuse_state();
  return values;
}

py::tuple tuple_of(const Vec3d& v) { return py::make_tuple(v.x, v.y, v.z); }
Vec3d vector_in(const py::handle& three) {
  const auto [x, y, z] = py::cast<std::tuple<double, double, double>>(three);
  return {x, y, z};
}

template <class Arrays, class Primitive>
py::tuple state_of(const char* kind, const Arrays& arrays, const std::vector<Primitive>& primitives,
                   const std::vector<Vec3d>& exact) {
  return py::make_tuple(kind, bytes_of(primitives), tuple_of(arrays.base), bytes_of(exact),
                        arrays.materials, arrays.has_colors);
}

/// What spheres and capsules have in common. `exact_each`: points of double precision of each.
template <class Arrays, class Primitive>
std::shared_ptr<const Arrays> arrays_in(const py::tuple& state,
                                        std::vector<Primitive> Arrays::*primitives,
                                        std::vector<Vec3d> Arrays::*exact, std::size_t exact_each) {
  if (state.size() != 6) refuse_state();
  auto arrays = std::make_shared<Arrays>();
  (*arrays).*primitives = values_in<Primitive>(state[1]);
  arrays->base = vector_in(state[2]);
  (*arrays).*exact = values_in<Vec3d>(state[3]);
  arrays->materials = py::cast<std::vector<std::string>>(state[4]);
  arrays->has_colors = py::cast<bool>(state[5]);
  const std::size_t points = ((*arrays).*exact).size();
  const std::size_t materials = std::max<std::size_t>(arrays->materials.size(), 1);
  const auto is_right = [materials](const Primitive& one) {
    return !find_problem(one) && one.material.index() < materials;
  };
  const std::vector<Primitive>& all = (*arrays).*primitives;
  if ((points != 0 && points != exact_each * all.size()) ||
      !std::all_of(all.begin(), all.end(), is_right)) {
    refuse_state();
  }
  return arrays;
}

py::tuple data_state(const Data& data) {
  if (const auto* spheres = std::get_if<std::shared_ptr<const SphereArrays>>(&data.held))
    return state_of("spheres", **spheres, (*spheres)->spheres, (*spheres)->centers);
  if (const auto* capsules = std::get_if<std::shared_ptr<const CapsuleArrays>>(&data.held))
    return state_of("capsules", **capsules, (*capsules)->capsules, (*capsules)->ends);
  if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&data.held))
    return py::make_tuple("image", (*image)->width, (*image)->height, bytes_of((*image)->pixels));
  using Lens = std::shared_ptr<const std::vector<LensSurface>>;
  if (const auto* lens = std::get_if<Lens>(&data.held))
    return py::make_tuple("lens", bytes_of(**lens));
  throw py::type_error("particles cannot be pickled; the scenes that show them can");
}

/// The pixels of a picture of the sides state[1] and state[2].
Image image_in(const py::tuple& state) {
  const int width = py::cast<int>(state[1]), height = py::cast<int>(state[2]);
  if (width < 1 || height < 1 || width > max_image_side || height > max_image_side) refuse_state();
  Image image;
  image.width = width;
  image.height = height;
  image.pixels = values_in<Color>(
      state[3], static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return image;
}

Data data_in(const py::tuple& state) {
  if (state.empty()) refuse_state();
  const auto kind = py::cast<std::string>(state[0]);
  if (kind == "spheres")
    return {arrays_in(state, &SphereArrays::spheres, &SphereArrays::centers, 1)};
  if (kind == "capsules")
    return {arrays_in(state, &CapsuleArrays::capsules, &CapsuleArrays::ends, 2)};
  if (kind == "image" && state.size() == 4) return {std::make_shared<const Image>(image_in(state))};
  if (kind != "lens" || state.size() != 2) refuse_state();
  return {std::make_shared<const std::vector<LensSurface>>(values_in<LensSurface>(state[1]))};
}

/// Entries of a file's header. Texts are bytes: they need not be UTF-8.
py::list state_of(const Metadata& header) {
  py::list entries;
  for (const auto& [name, value] : header) {
    const auto put = [&]<class Value>(const Value& one) -> py::object {
      if constexpr (std::is_same_v<Value, std::string>) {
        return py::bytes(one);
      } else {
        return py::cast(one);
      }
    };
    entries.append(py::make_tuple(py::bytes(name), value.index(), std::visit(put, value)));
  }
  return entries;
}

Metadata header_in(const py::handle& entries) {
  Metadata header;
  for (const py::handle entry : entries) {
    const auto [name, kind, value] =
        py::cast<std::tuple<std::string, std::size_t, py::object>>(entry);
    switch (kind) {
      case 0:
        header.emplace_back(name, py::cast<std::string>(value));
        break;
      case 1:
        header.emplace_back(name, py::cast<std::int32_t>(value));
        break;
      case 2:
        header.emplace_back(name, py::cast<float>(value));
        break;
      case 3:
        header.emplace_back(name, py::cast<MetadataMatrix>(value));
        break;
      default:
        refuse_state();
    }
  }
  return header;
}

py::tuple state_of(const RenderStatistics& all) {
  return py::make_tuple(all.prepare_seconds, py::bytes(std::string(all.isa)), all.width,
                        static_cast<int>(all.solver), all.threads, all.rays.primary,
                        all.rays.shadow, all.rays.continuation, all.faults.not_finite,
                        all.faults.too_bright, all.render_seconds);
}

RenderStatistics statistics_in(const py::tuple& state) {
  if (state.size() != 11) refuse_state();
  RenderStatistics all;
  all.prepare_seconds = py::cast<double>(state[0]);
  const auto isa = py::cast<std::string>(state[1]);
  for (const Isa one : {Isa::scalar, Isa::sse42, Isa::avx2, Isa::avx512, Isa::neon}) {
    if (isa_name(one) == isa) all.isa = isa_name(one);
  }
  all.width = py::cast<int>(state[2]);
  const int solver = py::cast<int>(state[3]);
  if (solver < 0 || solver >= static_cast<int>(names<Solver>.size())) refuse_state();
  all.solver = static_cast<Solver>(solver);
  all.threads = py::cast<unsigned>(state[4]);
  std::uint64_t* const counts[] = {&all.rays.primary, &all.rays.shadow, &all.rays.continuation,
                                   &all.faults.not_finite, &all.faults.too_bright};
  for (std::size_t k = 0; k < std::size(counts); ++k)
    *counts[k] = py::cast<std::uint64_t>(state[5 + k]);
  all.render_seconds = py::cast<double>(state[10]);
  return all;
}

py::list state_of(const std::vector<ImageChannel>& channels) {
  py::list all;
  for (const ImageChannel& channel : channels) {
    all.append(py::make_tuple(
        channel.name, channel.samples.index(),
        std::visit([](const auto& samples) { return bytes_of(samples); }, channel.samples)));
  }
  return all;
}

std::vector<ImageChannel> channels_in(const py::handle& list, std::size_t pixels) {
  std::vector<ImageChannel> channels;
  for (const py::handle entry : list) {
    const auto [name, kind, bytes] =
        py::cast<std::tuple<std::string, std::size_t, py::object>>(entry);
    if (kind > 1) refuse_state();
    ImageChannel channel{name, {}};
    if (kind == 0) channel.samples = values_in<float>(bytes, pixels);
    if (kind == 1) channel.samples = values_in<std::uint32_t>(bytes, pixels);
    channels.push_back(std::move(channel));
  }
  return channels;
}

py::tuple picture_state(const Picture& picture) {
  const PictureParts& parts = *picture.parts;
  const Image& image = parts.image;
  py::object noise = py::none(), partial = py::none();
  if (parts.noise) {
    noise = py::make_tuple(parts.noise->half_width, parts.noise->mean_samples, parts.noise->share);
  }
  if (parts.partial)
    partial = py::make_tuple(parts.partial->done, parts.partial->all, parts.partial->what);
  const CropWindow& crop = parts.crop;
  return py::make_tuple("picture", image.width, image.height, bytes_of(image.pixels),
                        bytes_of(image.alpha), state_of(parts.channels), state_of(parts.header),
                        py::make_tuple(crop.frame_width, crop.frame_height, crop.x, crop.y),
                        state_of(parts.statistics), parts.notes, parts.spp, parts.scene_hash,
                        tuple_of(parts.origin), noise, partial);
}

Picture picture_in(const py::tuple& state) {
  if (state.size() != 15) refuse_state();
  auto parts = std::make_shared<PictureParts>();
  parts->image = image_in(state);
  const std::size_t pixels = parts->image.pixels.size();
  parts->image.alpha = values_in<float>(state[4]);
  if (!parts->image.alpha.empty() && parts->image.alpha.size() != pixels) refuse_state();
  parts->channels = channels_in(state[5], pixels);
  parts->header = header_in(state[6]);
  const auto [width, height, x, y] = py::cast<std::tuple<int, int, int, int>>(state[7]);
  parts->crop = {width, height, x, y};
  parts->statistics = statistics_in(state[8]);
  parts->notes = py::cast<std::vector<std::string>>(state[9]);
  parts->spp = py::cast<int>(state[10]);
  parts->scene_hash = py::cast<std::uint64_t>(state[11]);
  parts->origin = vector_in(state[12]);
  if (!state[13].is_none()) {
    const auto [half, mean, share] = py::cast<std::tuple<double, double, double>>(state[13]);
    parts->noise = NoiseReached{half, mean, share};
  }
  if (!state[14].is_none()) {
    const auto [done, all, what] =
        py::cast<std::tuple<std::uint64_t, std::uint64_t, std::string>>(state[14]);
    parts->partial = PartialSamples{done, all, what == "pixels" ? "pixels" : "samples"};
  }
  return {parts};
}

/// What a wrong state makes pybind11 throw is one Error.
template <class Made>
auto checked(Made (*make)(const py::tuple&)) {
  return [make](const py::tuple& state) {
    try {
      return make(state);
    } catch (const py::cast_error&) {
      refuse_state();
    }
  };
}

}  // namespace

void bind_pickling(py::module_& module) {
  module.def("data_state", &data_state, inside(), py::arg("data"));
  module.def("data_in", checked(&data_in), inside(), py::arg("state"));
  module.def("picture_state", &picture_state, inside(), py::arg("picture"));
  module.def("picture_in", checked(&picture_in), inside(), py::arg("state"));
}

}  // namespace boule::python
