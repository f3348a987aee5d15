#include <algorithm>
#include <utility>

#include "render/files/particle_file/hdf5/hdf5_layout.h"

namespace boule {
namespace {

constexpr std::array snapshot_kinds{"gas",   "halo",        "disk",     "bulge",
                                    "stars", "black holes", "neutrinos"};

/// A type of particles.
struct SnapshotType {
  std::size_t number;
  std::string group{};
  std::uint64_t count = 0;
};

std::string group_of_type(std::size_t type) { return "PartType" + std::to_string(type); }

class Snapshot final : public Hdf5Family {
 public:
  Snapshot(const Hdf5File& file, std::vector<SnapshotType> types)
      : Hdf5Family(file), types_(std::move(types)) {}

  [[nodiscard]] std::size_t frames() const override { return 1; }
  Result<Hdf5Layout> layout(std::size_t frame, const ParticleFileOptions& options) const override;

 private:
  void add_header(Hdf5Layout& layout) const;
  void add_field(const std::string& name, const ParticleFileOptions& options,
                 Hdf5Layout& layout) const;

  std::vector<SnapshotType> types_;
};

void Snapshot::add_header(Hdf5Layout& layout) const {
  auto box = file_.numbers_of("Header", "BoxSize");
  if (box.size() == 1) box.assign(3, box.front());
  if (box.size() == 3) {
    set_cell({Vec3d{box[0], 0, 0}, Vec3d{0, box[1], 0}, Vec3d{0, 0, box[2]}}, {true, true, true},
             layout.facts);
  }
  if (const auto time = file_.numbers_of("Header", "Time"); !time.empty())
    layout.facts.time = time.front();
  const auto files = file_.numbers_of("Header", "NumFilesPerSnapshot");
  if (files.empty() || !(files.front() > 1) || !(files.front() < 1e9)) return;
  layout.facts.notes.push_back("this file is one of " +
                               std::to_string(static_cast<long>(files.front())) +
                               " of its snapshot");
}

/// Types that lack a field have no number there.
void Snapshot::add_field(const std::string& name, const ParticleFileOptions& options,
                         Hdf5Layout& layout) const {
  const std::string column = name == "ParticleIDs" ? "id" : name == "Masses" ? "mass" : name;
  Hdf5Array array;
  std::uint32_t axes = 0;
  std::uint64_t width = 1;
  for (const SnapshotType& type : types_) {
    const std::string path = type.group + "/" + name;
    const Hdf5Object field = file_.look(path);
    Hdf5Numbers& part = array.parts.emplace_back();
    if (field.kind == Hdf5Kind::refused)
      return leave_out(column, file_.refusal(path).message, layout);
    const bool is_column = field.axes == 1 || field.axes == 2;
    if (!are_numbers(field) || !is_column || field.extent[0] != type.count) continue;
    const std::uint64_t its = field.axes == 2 ? field.extent[1] : 1;
    if (axes == 0) {
      axes = field.axes;
      width = its;
    }
    if (axes == field.axes && width == its) {
      part.path = path;
      part.has_rows = axes == 2;
    }
  }
  if (axes == 0) return;
  array.names = hdf5_column_names(column, width);
  add_array(std::move(array), options, layout);
}

Result<Hdf5Layout> Snapshot::layout(std::size_t, const ParticleFileOptions& options) const {
  Hdf5Layout layout;
  layout.species_name = "type";
  std::vector<std::string> fields;
  for (const SnapshotType& type : types_) {
    Hdf5Places places;
    places.axes = {{.path = type.group + "/Coordinates", .has_rows = true}};
    layout.parts.push_back({snapshot_kinds.at(type.number), type.count, std::move(places)});
    const auto names = file_.list(type.group);
    if (!names) return names.error();
    for (const std::string& name : names.value()) {
      if (name != "Coordinates" && std::find(fields.begin(), fields.end(), name) == fields.end())
        fields.push_back(name);
    }
  }
  add_header(layout);
  for (const std::string& field : fields) add_field(field, options, layout);
  return layout;
}

}  // namespace

Hdf5Opened open_snapshot(const Hdf5File& file) {
  std::vector<SnapshotType> types;
  bool is_snapshot = false;
  for (std::size_t i = 0; i < snapshot_kinds.size(); ++i) {
    const std::string group = group_of_type(i), path = group + "/Coordinates";
    if (!file.has_group(group)) continue;
    is_snapshot = true;
    const Hdf5Object places = file.look(path);
    if (places.kind == Hdf5Kind::none) continue;
    if (places.kind == Hdf5Kind::refused) return file.refusal(path);
    if (!are_numbers(places) || places.axes != 2 || places.extent[1] != 3)
      return Diagnostic::of(quote(path) + ": expected three numbers a particle");
    types.push_back({i, group, places.extent[0]});
  }
  if (!is_snapshot) return Hdf5Opened(std::unique_ptr<Hdf5Family>());
  if (types.empty()) return Diagnostic::of("no PartType of it has Coordinates");
  return Hdf5Opened(std::make_unique<Snapshot>(file, std::move(types)));
}

}  // namespace boule
