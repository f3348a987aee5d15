#include "render/files/scene_file/nff/nff_camera.h"

#include <algorithm>
#include <string>

namespace boule {
namespace {

struct Member {
  std::string_view name;
  const char* key;
  std::string_view scene_key;  ///< what core/scene calls it, or nothing
  bool is_required;
};

constexpr Member members[] = {
    {"from", "v.from", "camera.eye", true},
    {"at", "v.at", "camera.look_at", true},
    {"up", "v.up", "camera.up", true},
    {"angle", "v.angle", "camera.fov", true},
    {"resolution", "v.resolution", "image.size", true},
    {"hither", "v.hither", "", false},
};

}  // namespace

bool NffCamera::begin(TextPlace place) {
  if (state_ != State::absent) return false;
  state_ = State::open;
  start_ = place;
  return true;
}

bool NffCamera::read_member(std::string_view name, NffCursor& line, FirstError& error) {
  static_assert(std::size(members) == member_count);
  const Member* member = std::find_if(std::begin(members), std::end(members),
                                      [&](const Member& one) { return one.name == name; });
  if (member == std::end(members)) return false;
  TextPlace& place = places_[member - std::begin(members)];
  if (place.line > 0) {
    error.report(line.place(), member->key,
                 "is given twice, first on line " + std::to_string(place.line));
  }
  place = line.place(1);
  if (name == "from") line.take_point(member->key, camera_.pose.eye);
  if (name == "at") line.take_point(member->key, camera_.pose.look_at);
  if (name == "up") line.take(member->key, camera_.pose.up);
  if (name == "angle") line.take(member->key, camera_.fov);
  if (name == "hither") line.take(member->key, hither_);
  if (name == "resolution" && line.take(member->key, width_)) line.take(member->key, height_);
  line.take_line_end(member->key);
  return true;
}

void NffCamera::end(Scene& scene, FirstError& error) {
  state_ = State::closed;
  for (int i = 0; i < member_count; ++i) {
    if (!members[i].is_required || places_[i].line > 0) continue;
    error.report(start_, members[i].key, "the v block lacks its line " + quote(members[i].name));
  }
  Scene alone;
  alone.camera = camera_;
  alone.image.width = width_;
  alone.image.height = height_;
  if (const auto done = validate(alone); !done) {
    const Member* member =
        std::find_if(std::begin(members), std::end(members),
                     [&](const Member& m) { return m.scene_key == done.error().key; });
    error.report(places_[member - std::begin(members)], member->key, done.error().message);
  }
  scene.camera = alone.camera;
  scene.image = alone.image;
}

}  // namespace boule
