#include "render/files/scene_file/loaded/frame_name.h"

#include <algorithm>
#include <cstddef>

namespace boule {

std::string frame_name(const std::string& name, int frame) {
  const std::string number = std::to_string(frame);
  std::string result;
  for (std::size_t i = 0; i < name.size();) {
    if (name[i] != '#') {
      result += name[i++];
      continue;
    }
    const std::size_t end = std::min(name.find_first_not_of('#', i), name.size());
    if (number.size() < end - i) result.append(end - i - number.size(), '0');
    result += number;
    i = end;
  }
  return result;
}

}  // namespace boule
