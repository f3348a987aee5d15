#include "render/files/scene_file/toml/toml_camera_keys.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/math/vec.h"
#include "render/files/file/float32.h"

namespace boule {
namespace {

void add(CameraTrack& track, double frame, const Vec3d& v, TextPlace place) {
  track.values[0].push_back({frame, v.x});
  track.values[1].push_back({frame, v.y});
  track.values[2].push_back({frame, v.z});
  track.places.push_back(place);
}

/// The place of the key that a track comes from at a frame.
TextPlace place_at(const CameraTrack& track, double frame) {
  return track.places[value_before(track.values[0], frame)];
}

TomlMember* find_key(TomlMembers& members, std::string_view key) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const TomlMember& member) { return member.key == key; });
  return found == members.end() ? nullptr : &*found;
}

/// Reads the keys in order.
class CameraKeys {
 public:
  explicit CameraKeys(TomlTable camera) : camera_(std::move(camera)) {}

  CameraMotion read() {
    for (TomlTable& table : camera_.tables("key")) read(table);
    if (motion_.frames.empty()) {
      camera_.report("key", "expected at least one table [[camera.key]]");
    }
    for (const CameraTrack& track : motion_.tracks) {
      if (track.places.empty() || !camera_.has(track.key)) continue;
      camera_.report(track.key, "stands in [[camera.key]] too, expected it in one of them");
    }
    return std::move(motion_);
  }

 private:
  void read(TomlTable& table) {
    int frame = 0;
    table.read("frame", frame);
    bool any = false;
    for (CameraTrack& track : motion_.tracks) {
      if (!table.has(track.key)) continue;
      any = true;
      Vec3d value;
      track.components == 3 ? table.read(track.key, value) : table.read(track.key, value.x);
      add(track, frame, value, table.place_of(track.key));
    }
    table.finish({"frame"});
    if (frame < 0) table.report("frame", "must be 0 or above, is " + std::to_string(frame));
    if (!motion_.frames.empty() && frame <= motion_.frames.back()) {
      table.report("frame", "must be above " + std::to_string(motion_.frames.back()) +
                                ", the frame of the key before, is " + std::to_string(frame));
    }
    motion_.frames.push_back(frame);
    if (!any) table.report("eye", "missing key 'eye', 'look_at', 'fov', 'aperture' or 'focus'");
  }

  TomlTable camera_;
  CameraMotion motion_;
};

/// The value of a track at a frame, as a member of [camera]; its place is that of the key before.
TomlMember member_of(const CameraTrack& track, double frame) {
  const TextPlace place = place_at(track, frame);
  TomlArray numbers;
  for (std::size_t i = 0; i < track.components; ++i) {
    numbers.push_back({place, monotone_cubic(track.values[i], frame)});
  }
  const bool single = track.components == 1;
  TomlValue value = single ? numbers.front() : TomlValue{place, std::move(numbers)};
  return {std::string(track.key), place, std::move(value)};
}

/// `origin` is subtracted from the point.
void move(Vec3f& point, const CameraTrack& track, double frame, const Vec3d& origin) {
  if (track.places.empty()) return;
  const Vec3d at{monotone_cubic(track.values[0], frame), monotone_cubic(track.values[1], frame),
                 monotone_cubic(track.values[2], frame)};
  const Vec3d moved = at - origin;
  point = {float32_or_inf(moved.x), float32_or_inf(moved.y), float32_or_inf(moved.z)};
}

void move(float& number, const CameraTrack& track, double frame) {
  if (track.places.empty()) return;
  number = float32_or_inf(monotone_cubic(track.values[0], frame));
}

/// The first Problem of a camera at a frame; `sharp` is the point that it keeps in focus.
std::optional<Problem> find_problem_at(const CameraMotion& motion, double frame, Camera camera,
                                       const Vec3d& origin, const std::optional<Vec3f>& sharp) {
  const auto move_it = [&](auto& kind) {
    const auto& [eye, look_at, fov, aperture, focus] = motion.tracks;
    move(kind.pose.eye, eye, frame, origin);
    move(kind.pose.look_at, look_at, frame, origin);
    if constexpr (requires { kind.fov; }) move(kind.fov, fov, frame);
    if constexpr (requires { kind.aperture; }) move(kind.aperture, aperture, frame);
    if constexpr (requires { kind.focus; }) {
      if (!focus.places.empty()) move(kind.focus.emplace(), focus, frame);
    }
  };
  std::visit(move_it, camera);
  if (auto bad = find_problem(camera)) return bad;
  const CameraPose& pose = *std::visit([](const auto& kind) { return &kind.pose; }, camera);
  if (!sharp || depth_of(pose, *sharp) > 0) return std::nullopt;
  return Problem{"focus", "must lie in front of the camera"};
}

/// A camera with the same Problems at every frame, but cheap to copy and check: while the focus of
/// a lens stands still, its elements have been checked once and are left out.
Camera without_elements(const Camera& camera, const CameraMotion& motion) {
  const auto* lens = std::get_if<LensCamera>(&camera);
  const bool stands = motion.tracks.back().places.empty();
  return lens != nullptr && stands ? PinholeCamera{lens->pose} : camera;
}

}  // namespace

std::optional<CameraMotion> apply_camera_keys(TomlMembers& root, std::optional<double> frame,
                                              FirstError& error) {
  TomlMember* const camera = find_key(root, "camera");
  if (camera == nullptr) return std::nullopt;
  auto* const members = std::get_if<TomlMembers>(&camera->value.data);
  if (members == nullptr || find_key(*members, "key") == nullptr) return std::nullopt;
  CameraMotion motion =
      CameraKeys(TomlTable(*members, camera->value.place, "camera", error)).read();
  if (!error.status()) return std::nullopt;
  const double now = frame.value_or(motion.frames.front());
  std::erase_if(*members, [](const TomlMember& member) { return member.key == "key"; });
  for (const CameraTrack& track : motion.tracks) {
    if (!track.places.empty()) members->push_back(member_of(track, now));
  }
  return motion;
}

void check_camera_keys(const CameraMotion& motion, const Camera& camera, TomlTable& table) {
  std::optional<Vec3f> sharp;
  if (table.has_array("focus")) table.read_point("focus", sharp.emplace());
  const Camera light = without_elements(camera, motion);
  for (const int frame : motion.frames) {
    const auto problem = find_problem_at(motion, frame, light, table.origin(), sharp);
    if (!problem) continue;
    const std::string_view field = problem->field;
    TextPlace place = table.place_of(field);
    for (const CameraTrack& track : motion.tracks) {
      if (track.key == field && !track.places.empty()) place = place_at(track, frame);
    }
    return table.report_at(place, field,
                           "in frame " + std::to_string(frame) + ": " + problem->message);
  }
}

}  // namespace boule
