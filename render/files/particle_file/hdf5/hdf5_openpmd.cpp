#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "render/files/particle_file/hdf5/hdf5_layout.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

constexpr std::array pmd_axes{"x", "y", "z"};

/// The group of a species and how many particles it has.
struct PmdSpecies {
  std::string name;
  std::string group;
};

class OpenPmd final : public Hdf5Family {
 public:
  /// `steps`: their groups; particles are in `inside` of each.
  OpenPmd(const Hdf5File& file, std::vector<std::string> steps, std::string inside)
      : Hdf5Family(file), steps_(std::move(steps)), inside_(std::move(inside)) {}

  [[nodiscard]] std::size_t frames() const override { return steps_.size(); }
  Result<Hdf5Layout> layout(std::size_t frame, const ParticleFileOptions& options) const override;

 private:
  Result<std::uint64_t> count_of(const std::string& position) const;
  Result<Hdf5Numbers> component(const std::string& path, std::uint64_t count) const;
  Result<Hdf5Layout::Part> part_of(const PmdSpecies& kind) const;
  double unit_of(const std::string& path) const;
  Status add_record(const std::string& name, const std::vector<PmdSpecies>& kinds,
                    const ParticleFileOptions& options, Hdf5Layout& layout) const;
  Status add_component(const std::string& record, const std::string& name,
                       const std::vector<PmdSpecies>& kinds, const ParticleFileOptions& options,
                       Hdf5Layout& layout) const;

  std::vector<std::string> steps_;
  std::string inside_;
};

double OpenPmd::unit_of(const std::string& path) const {
  const auto unit = file_.numbers_of(path, "unitSI");
  return unit.empty() ? 1 : unit.front();
}

Result<std::uint64_t> OpenPmd::count_of(const std::string& position) const {
  for (const char* const axis : pmd_axes) {
    const std::string path = position + "/" + axis;
    const Hdf5Object object = file_.look(path);
    if (object.kind == Hdf5Kind::refused) return file_.refusal(path);
    if (object.axes > 0) return object.extent[0];
    if (object.kind != Hdf5Kind::group) continue;
    const auto shape = file_.numbers_of(path, "shape");
    constexpr double most = 1e15;
    if (shape.empty() || !(shape.front() >= 0) || !(shape.front() < most))
      return Diagnostic::of(quote(path, 200) + ": expected a dataset, or 'value' and 'shape'");
    return static_cast<std::uint64_t>(shape.front());
  }
  return Diagnostic::of(quote(position, 200) + ": expected x, y or z");
}

/// A component of a record: a dataset, or a group with one number for all; else no number.
Result<Hdf5Numbers> OpenPmd::component(const std::string& path, std::uint64_t count) const {
  Hdf5Numbers numbers;
  const Hdf5Object object = file_.look(path);
  if (object.kind == Hdf5Kind::refused) return file_.refusal(path);
  if (object.kind == Hdf5Kind::group) {
    const auto value = file_.numbers_of(path, "value");
    if (!value.empty()) numbers.value = value.front();
  } else if (are_numbers(object) && object.axes == 1 && object.extent[0] == count) {
    numbers.path = path;
  }
  return numbers;
}

Result<Hdf5Layout::Part> OpenPmd::part_of(const PmdSpecies& kind) const {
  const std::string position = kind.group + "/position", offset = kind.group + "/positionOffset";
  const auto count = count_of(position);
  if (!count) return count.error();
  Hdf5Layout::Part part{kind.name, count.value(), {}};
  Hdf5Places& places = part.places;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string its = position + "/" + pmd_axes[i], moved = offset + "/" + pmd_axes[i];
    const bool is_there = file_.look(its).kind != Hdf5Kind::none;
    const bool is_moved = is_there && file_.look(moved).kind != Hdf5Kind::none;
    const Hdf5Numbers zero{.value = 0};
    auto numbers = is_there ? component(its, part.count) : zero;
    if (!numbers) return numbers.error();
    auto offsets = is_moved ? component(moved, part.count) : zero;
    if (!offsets) return offsets.error();
    places.axes.push_back(std::move(numbers).value());
    places.offsets.push_back(std::move(offsets).value());
    places.factors[i] = unit_of(moved) / unit_of(its);
  }
  return part;
}

/// Species that lack it have no number there.
Status OpenPmd::add_component(const std::string& record, const std::string& name,
                              const std::vector<PmdSpecies>& kinds,
                              const ParticleFileOptions& options, Hdf5Layout& layout) const {
  Hdf5Array array{{name}, {}};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const std::string path = kinds[i].group + "/" + record;
    auto numbers = component(path, layout.parts[i].count);
    if (!numbers) {
      leave_out(name, numbers.error().message, layout);
      return {};
    }
    array.parts.push_back(std::move(numbers).value());
  }
  add_array(std::move(array), options, layout);
  return {};
}

Status OpenPmd::add_record(const std::string& name, const std::vector<PmdSpecies>& kinds,
                           const ParticleFileOptions& options, Hdf5Layout& layout) const {
  bool has_axes = false;
  for (const char* const axis : pmd_axes) {
    const std::string component = name + "/" + axis;
    if (std::none_of(kinds.begin(), kinds.end(), [&](const PmdSpecies& kind) {
          return file_.look(kind.group + "/" + component).kind != Hdf5Kind::none;
        })) {
      continue;
    }
    has_axes = true;
    if (auto done = add_component(component, name + "_" + axis, kinds, options, layout); !done)
      return done;
  }
  return has_axes ? Status() : add_component(name, name, kinds, options, layout);
}

Result<Hdf5Layout> OpenPmd::layout(std::size_t frame, const ParticleFileOptions& options) const {
  Hdf5Layout layout;
  layout.species_name = "species";
  const std::string& step = steps_[frame];
  const std::string particles = step + "/" + inside_;
  const auto all = file_.list(particles);
  if (!all) return all.error();
  std::vector<PmdSpecies> kinds;
  std::vector<std::string> records;
  for (const std::string& name : all.value()) {
    const std::string group = particles + "/" + name;
    if (file_.look(group + "/position").kind == Hdf5Kind::none) continue;
    kinds.push_back({name, group});
    auto part = part_of(kinds.back());
    if (!part) return part.error();
    layout.parts.push_back(std::move(part).value());
    const auto names = file_.list(group);
    if (!names) return names.error();
    for (const std::string& record : names.value()) {
      const bool is_known = std::find(records.begin(), records.end(), record) != records.end();
      if (!is_known && !record.starts_with("position") && !record.starts_with("particlePatches"))
        records.push_back(record);
    }
  }
  const auto time = file_.numbers_of(step, "time"), unit = file_.numbers_of(step, "timeUnitSI");
  if (!time.empty()) layout.facts.time = time.front() * (unit.empty() ? 1 : unit.front());
  for (const std::string& record : records) {
    if (auto done = add_record(record, kinds, options, layout); !done) return done.error();
  }
  return layout;
}

}  // namespace

Hdf5Opened open_openpmd(const Hdf5File& file) {
  if (file.texts_of("/", "openPMD").empty()) return Hdf5Opened(std::unique_ptr<Hdf5Family>());
  const auto path = file.texts_of("/", "particlesPath");
  std::string inside = path.empty() ? "particles" : path.front();
  while (inside.ends_with('/')) inside.pop_back();
  while (inside.starts_with('/')) inside.erase(0, 1);
  const auto names = file.list("data");
  if (!names) return names.error();
  std::vector<std::pair<std::uint64_t, std::string>> steps;
  for (const std::string& name : names.value()) {
    const auto number = count_in(name);
    const std::string step = "data/" + name;
    if (number && file.has_group(step + "/" + inside)) steps.emplace_back(*number, step);
  }
  if (steps.empty()) return Diagnostic::of("it has no particles of openPMD");
  std::sort(steps.begin(), steps.end());
  std::vector<std::string> groups;
  for (auto& [number, group] : steps) groups.push_back(std::move(group));
  return Hdf5Opened(std::make_unique<OpenPmd>(file, std::move(groups), std::move(inside)));
}

}  // namespace boule
