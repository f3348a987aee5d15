#pragma once

#include <string>

namespace boule {

/// True if the name has a slot for the frame number: a '#'.
inline bool has_frame_slot(const std::string& name) { return name.find('#') != std::string::npos; }

/// True if the slot has two '#' or more. Such a name is hardly meant as it stands, while one '#'
/// may be an ordinary part of a name.
inline bool has_wide_frame_slot(const std::string& name) {
  return name.find("##") != std::string::npos;
}

/// The name with every run of '#' replaced by the frame number, with zeros in front to as many
/// digits as the run has: "ball.####.npy" is "ball.0007.npy" in frame 7.
std::string frame_name(const std::string& name, int frame);

}  // namespace boule
