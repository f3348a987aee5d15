#include "render/scene_file/toml_camera_keys.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/math/monotone_cubic.h"
#include "core/math/vec.h"
#include "render/scene_file/toml_table.h"

namespace boule {
namespace {

/// One quantity over time: three components, or one.
struct Track {
  std::string_view key;
  std::size_t components;
  std::array<std::vector<TimedValue>, 3> values{};
  std::vector<TextPlace> places{};  ///< of each key that names it

  void add(double frame, const Vec3f& value, TextPlace place) {
    const Vec3d v = vec_cast<double>(value);
    values[0].push_back({frame, v.x});
    values[1].push_back({frame, v.y});
    values[2].push_back({frame, v.z});
    places.push_back(place);
  }
};

TomlMember* find_member(TomlMembers& members, std::string_view key) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const TomlMember& member) { return member.key == key; });
  return found == members.end() ? nullptr : &*found;
}

/// Reads the keys in order; their frames.
class CameraKeys {
 public:
  explicit CameraKeys(TomlTable camera) : camera_(std::move(camera)) {}

  void read() {
    for (TomlTable& table : camera_.tables("key")) read(table);
    if (frames_.empty()) camera_.report("key", "expected at least one table [[camera.key]]");
    for (const Track& track : tracks_) {
      if (track.places.empty() || !camera_.has(track.key)) continue;
      camera_.report(track.key, "stands in [[camera.key]] too, expected it in one of them");
    }
  }
  [[nodiscard]] int first_frame() const { return frames_.front(); }
  [[nodiscard]] const std::array<Track, 3>& tracks() const { return tracks_; }

 private:
  void read(TomlTable& table) {
    int frame = 0;
    table.read("frame", frame);
    if (frame < 0) table.report("frame", "must be 0 or above, is " + std::to_string(frame));
    if (!frames_.empty() && frame <= frames_.back()) {
      table.report("frame", "must be above " + std::to_string(frames_.back()) +
                                ", the frame of the key before, is " + std::to_string(frame));
    }
    frames_.push_back(frame);
    bool any = false;
    for (Track& track : tracks_) {
      if (!table.has(track.key)) continue;
      any = true;
      Vec3f value;
      track.components == 3 ? table.read(track.key, value) : table.read(track.key, value.x);
      track.add(frame, value, table.place_of(track.key));
    }
    table.finish({"frame"});
    if (!any) table.report("eye", "missing key 'eye', 'look_at' or 'fov'");
  }

  TomlTable camera_;
  std::vector<int> frames_;
  std::array<Track, 3> tracks_{Track{"eye", 3}, Track{"look_at", 3}, Track{"fov", 1}};
};

/// What a track has at a frame, as if it stood in [camera]; its place is that of the key before.
TomlMember member_of(const Track& track, double frame) {
  const std::vector<TimedValue>& times = track.values[0];
  std::size_t before = 0;
  while (before + 1 < times.size() && times[before + 1].time <= frame) ++before;
  const TextPlace place = track.places[before];
  TomlArray numbers;
  for (std::size_t i = 0; i < track.components; ++i) {
    numbers.push_back({place, monotone_cubic(track.values[i], frame)});
  }
  const bool single = track.components == 1;
  TomlValue value = single ? numbers.front() : TomlValue{place, std::move(numbers)};
  return {std::string(track.key), place, std::move(value)};
}

}  // namespace

void apply_camera_keys(TomlMembers& root, std::optional<int> frame, FirstError& error) {
  TomlMember* const camera = find_member(root, "camera");
  if (camera == nullptr) return;
  auto* const members = std::get_if<TomlMembers>(&camera->value.data);
  if (members == nullptr || find_member(*members, "key") == nullptr) return;
  CameraKeys keys(TomlTable(*members, camera->value.place, "camera", error));
  keys.read();
  if (error.status()) return;
  const int now = frame.value_or(keys.first_frame());
  std::erase_if(*members, [](const TomlMember& member) { return member.key == "key"; });
  for (const Track& track : keys.tracks()) {
    if (!track.places.empty()) members->push_back(member_of(track, now));
  }
}

}  // namespace boule
