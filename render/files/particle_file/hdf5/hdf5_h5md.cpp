#include <algorithm>
#include <utility>

#include "core/math/geometry.h"
#include "render/files/particle_file/hdf5/hdf5_layout.h"

namespace boule {
namespace {

std::string hdf5_shape(const Hdf5Object& object) {
  std::string text;
  for (std::uint32_t i = 0; i < object.axes; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(object.extent[i]);
  return "(" + text + ")";
}

/// Numbers or texts of particles, or the edges of their box: at every step, or fixed.
struct H5mdElement {
  std::string path{};
  Hdf5Object object{};
  bool moves = false;

  /// The extent along an axis behind that of steps; 1 beyond the last.
  [[nodiscard]] std::uint64_t extent(std::uint32_t axis) const {
    const std::uint32_t i = axis + (moves ? 1 : 0);
    return i < object.axes ? object.extent[i] : 1;
  }
  [[nodiscard]] std::uint32_t axes() const {
    const std::uint32_t steps = moves ? 1 : 0;
    return object.axes < steps ? 0 : object.axes - steps;
  }
  [[nodiscard]] std::uint64_t steps() const {
    return moves && object.axes > 0 ? object.extent[0] : 1;
  }
};

class H5md final : public Hdf5Family {
 public:
  H5md(const Hdf5File& file, std::string group, H5mdElement position, std::string note)
      : Hdf5Family(file),
        group_(std::move(group)),
        position_(std::move(position)),
        note_(std::move(note)) {}

  [[nodiscard]] std::size_t frames() const override {
    return static_cast<std::size_t>(position_.steps());
  }
  Result<Hdf5Layout> layout(std::size_t frame, const ParticleFileOptions& options) const override;

  static H5mdElement element(const Hdf5File& file, const std::string& path);

 private:
  void add_time(std::size_t frame, Hdf5Layout& layout) const;
  Status add_cell(std::size_t frame, Hdf5Layout& layout) const;
  void add(const std::string& name, std::size_t frame, const ParticleFileOptions& options,
           Hdf5Layout& layout) const;
  Status read(const H5mdElement& element, std::uint64_t frame, double* to) const;

  std::string group_;
  H5mdElement position_;
  std::string note_;
};

H5mdElement H5md::element(const Hdf5File& file, const std::string& path) {
  H5mdElement found{path, file.look(path), false};
  if (found.object.kind == Hdf5Kind::group) {
    found.path += "/value";
    found.object = file.look(found.path);
    found.moves = true;
  }
  return found;
}

/// All numbers of an element at one step; few.
Status H5md::read(const H5mdElement& element, std::uint64_t frame, double* to) const {
  Hdf5Extent start{}, count{};
  for (std::uint32_t i = 0; i < element.object.axes; ++i) count[i] = element.object.extent[i];
  if (element.moves) {
    start[0] = frame;
    count[0] = 1;
  }
  return file_.read(element.path, start, count, to);
}

void H5md::add_time(std::size_t frame, Hdf5Layout& layout) const {
  const H5mdElement times{group_ + "/position/time", file_.look(group_ + "/position/time"), true};
  if (!position_.moves || !are_numbers(times.object) || times.object.axes != 1) return;
  double time = 0;
  if (frame < times.steps() && read(times, frame, &time)) layout.facts.time = time;
}

Status H5md::add_cell(std::size_t frame, Hdf5Layout& layout) const {
  const std::string box = group_ + "/box";
  if (file_.look(box + "/edges").kind == Hdf5Kind::none) return {};
  const H5mdElement edges = element(file_, box + "/edges");
  const std::uint32_t axes = edges.axes();
  if (!are_numbers(edges.object) || axes < 1 || axes > 2 || edges.extent(0) != 3 ||
      edges.extent(axes - 1) != 3 || (edges.moves && edges.object.extent[0] <= frame)) {
    layout.facts.notes.emplace_back("the edges of its box are not those of a cell");
    return {};
  }
  std::array<double, 9> n{};
  if (auto done = read(edges, frame, n.data()); !done) return done;
  if (axes == 1) n = {n[0], 0, 0, 0, n[1], 0, 0, 0, n[2]};
  std::array<bool, 3> periodic{true, true, true};
  const auto boundary = file_.texts_of(box, "boundary");
  for (std::size_t i = 0; i < boundary.size() && i < 3; ++i)
    periodic[i] = boundary[i] == "periodic";
  const Vec3d a{n[0], n[1], n[2]}, b{n[3], n[4], n[5]}, c{n[6], n[7], n[8]};
  set_cell({a, b, c}, periodic, layout.facts);
  return {};
}

/// Adds what the group has under this name; skips what is not one value, or one row, a particle.
void H5md::add(const std::string& name, std::size_t frame, const ParticleFileOptions& options,
               Hdf5Layout& layout) const {
  const H5mdElement found = element(file_, group_ + "/" + name);
  const Hdf5Kind kind = found.object.kind;
  if (kind == Hdf5Kind::refused) return leave_out(name, file_.refusal(found.path).message, layout);
  const std::uint32_t axes = found.axes();
  const bool are_texts = kind == Hdf5Kind::texts;
  if ((!are_texts && !are_numbers(found.object)) || axes < 1 || axes > 2 ||
      found.extent(0) != layout.parts.front().count) {
    return;
  }
  if (found.moves && position_.moves && found.steps() != position_.steps())
    return leave_out(name, "it has other steps than the positions", layout);
  const auto step = found.moves ? std::optional<std::uint64_t>(frame) : std::nullopt;
  const bool have_texts = are_texts || kind == Hdf5Kind::codes;
  const bool are_species = name == "species" && kind != Hdf5Kind::floats;
  if (axes == 1 && (have_texts || are_species)) {
    Hdf5Texts texts{name, found.path, step, kind};
    if (name == "species") {
      layout.species = std::move(texts);
    } else {
      layout.texts.push_back(std::move(texts));
    }
  } else if (!are_texts) {
    const Hdf5Numbers numbers{.path = found.path, .frame = step, .has_rows = axes == 2};
    add_array({hdf5_column_names(name, found.extent(1)), {numbers}}, options, layout);
  }
}

Result<Hdf5Layout> H5md::layout(std::size_t frame, const ParticleFileOptions& options) const {
  if (position_.axes() != 2 || position_.extent(1) != 3 || !are_numbers(position_.object)) {
    return Diagnostic::of("positions of shape " + hdf5_shape(position_.object) +
                          ", expected three numbers each");
  }
  Hdf5Layout layout;
  if (!note_.empty()) layout.facts.notes.push_back(note_);
  const auto step = position_.moves ? std::optional<std::uint64_t>(frame) : std::nullopt;
  Hdf5Places places;
  places.axes = {{.path = position_.path, .frame = step, .has_rows = true}};
  layout.parts = {{"", position_.extent(0), std::move(places)}};
  const auto unit = file_.texts_of(position_.path, "unit");
  if (!unit.empty() && unit.front() == "nm") layout.facts.length_in_angstrom = 10;
  if (!unit.empty() && unit.front() == "pm") layout.facts.length_in_angstrom = 0.01;
  add_time(frame, layout);
  if (auto done = add_cell(frame, layout); !done) return done.error();
  const auto names = file_.list(group_);
  if (!names) return names.error();
  for (const std::string& name : names.value()) {
    if (name != "position" && name != "box") add(name, frame, options, layout);
  }
  return layout;
}

}  // namespace

Hdf5Opened open_h5md(const Hdf5File& file) {
  const auto names = file.list("particles");
  if (!names) return names.error();
  std::vector<std::string> groups;
  for (const std::string& name : names.value()) {
    if (file.look("particles/" + name + "/position").kind != Hdf5Kind::none) groups.push_back(name);
  }
  if (groups.empty()) {
    return Diagnostic::of(
        "it lacks the groups of H5MD (particles/NAME/position), GADGET and openPMD");
  }
  std::string note;
  if (groups.size() > 1) {
    note = printable(groups.front(), 40) + " is shown, the first of " +
           std::to_string(groups.size()) + " groups of particles";
  }
  const std::string group = "particles/" + groups.front();
  auto position = H5md::element(file, group + "/position");
  if (position.object.kind == Hdf5Kind::refused) return file.refusal(position.path);
  return Hdf5Opened(std::make_unique<H5md>(file, group, std::move(position), std::move(note)));
}

}  // namespace boule
