#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace boule::bench {

/// A picture of 4 : 3 with a camera and one point light, to look for false shadows in.
struct EpsilonScene {
  std::string experiment;  ///< "scale", "distance", "ground"
  double x;                ///< what it varies
  Scene scene;
};

/// Balls resting on a floor and on each other before a wall, all lengths times `factor`: those of
/// the balls are 1/4 to 2, the camera is 9 away.
EpsilonScene scene_of_scale(double factor);

/// A ball of radius 1 in the middle of the world with a smaller one upon it, seen from
/// `distance` away through a lens that makes it fill the picture.
EpsilonScene scene_at_distance(double distance);

/// Balls of radius 1 resting on a ground sphere whose top is in the middle of the world, seen from
/// 2 above the ground.
EpsilonScene scene_on_ground(double radius);

/// All scenes that are measured: scales 10^-4 .. 10^6, distances 10^0.5 .. 10^6 in half powers,
/// grounds 10^1 .. 10^6.
std::vector<EpsilonScene> epsilon_scenes();

}  // namespace boule::bench
