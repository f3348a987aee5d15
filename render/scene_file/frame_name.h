#pragma once

#include <string>

namespace boule {

/// True if the name has a place for the frame number: a '#'.
inline bool has_frame_place(const std::string& name) { return name.find('#') != std::string::npos; }

/// True if that place is for more than one digit: two '#' in a row are hardly part of a name that
/// is meant as it stands.
inline bool has_wide_frame_place(const std::string& name) {
  return name.find("##") != std::string::npos;
}

/// The name with every run of '#' replaced by the frame number, with zeros in front to as many
/// digits as the run has: "ball.####.npy" is "ball.0007.npy" in frame 7.
std::string frame_name(const std::string& name, int frame);

}  // namespace boule
