#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec.h"
#include "core/scene/camera_fit.h"
#include "core/scene/names.h"
#include "render/files/particles/particle_style.h"

namespace boule {

/// How a picture of particles looks that have no scene: paths of light on white, Whitted's method
/// on white, paths of light on black.
enum class Look { paper, plain, dark };

template <>
inline constexpr std::array<std::string_view, 3> names<Look>{"paper", "plain", "dark"};

/// From where the particles are seen.
struct ViewChoice {
  std::optional<Vec3d> direction{};  ///< in which the camera looks; none: by the pose
  FittedPose pose = FittedPose::upright;

  friend bool operator==(const ViewChoice&, const ViewChoice&) = default;
};

/// What is given for one kind of particles, in the words of the user: a colour or a radius.
struct KindText {
  std::string kind, value;

  friend bool operator==(const KindText&, const KindText&) = default;
};

/// An option as it was given: its name without "--", and its text, which a flag lacks.
struct GivenOption {
  std::string name, text;

  friend bool operator==(const GivenOption&, const GivenOption&) = default;
};

/// A plane that cuts particles: what is on the side of its normal is taken away.
struct ClipChoice {
  Vec3d point, normal;

  friend bool operator==(const ClipChoice&, const ClipChoice&) = default;
};

/// What the command line says about the picture of a particle file. What it leaves out is chosen to
/// fit, most of it by [[particles]] itself.
struct LookOptions {
  Look look = Look::paper;
  bool quick = false;                             ///< a sketch, in place of the look's light
  bool floor = false;                             ///< a plane below the particles
  std::vector<ClipChoice> clip{};                 ///< planes that cut particles and bonds
  std::string outline_by{};                       ///< what lines go around; empty: by the style
  std::string format{};                           ///< of the file; empty: as it seems to be
  std::vector<std::string> columns{};             ///< names for the columns; empty: the file's own
  std::optional<int> frame{};                     ///< of the file; negative: from its end
  bool water = false;                             ///< PDB and mmCIF: with water
  std::string topology{};                         ///< a file with the kinds of particles
  std::string color{};                            ///< "element", "#rrggbb" or a column
  std::string map{};                              ///< a name, or colours "#rrggbb,#rrggbb"
  std::vector<KindText> colors{};                 ///< of kinds
  std::string nan_color{};                        ///< of missing numbers; empty: grey
  std::optional<std::array<double, 2>> range{};   ///< of the map; least < largest
  std::string radius{};                           ///< a number, a RadiusTable or a column
  std::vector<KindText> radii{};                  ///< of species
  std::optional<ParticleShape> style{};           ///< balls, sticks or both
  std::string bonds{};                            ///< a name of BondRule, or a number
  std::optional<double> bond_radius{};            ///< > 0
  std::string bond_color{};                       ///< of all bonds; empty: of their particles
  bool cell_edges = false;                        ///< are drawn
  bool axes = false;                              ///< are drawn
  std::vector<std::string> arrows{};              ///< columns of vectors: three, or their one name
  std::optional<double> arrow_scale{};            ///< times the vectors, > 0
  std::optional<double> scale{};                  ///< of the radii, > 0
  bool wrap = false;                              ///< into the cell
  bool unwrap = false;                            ///< molecules are whole
  bool boundary = false;                          ///< images on the faces of the cell
  std::optional<std::array<int, 3>> replicate{};  ///< images along the cell's edges
  std::string select{};                           ///< which particles
  std::string ghost{};                            ///< which particles are ghosts
  std::optional<double> opacity{};                ///< of ghosts, 0 .. 1
  std::string labels{};                           ///< which particles have a text
  std::vector<std::string> label_text{};          ///< columns of it
  std::optional<ViewChoice> view{};               ///< in which the camera looks
  std::optional<Vec3d> up{};                      ///< upward in the picture
  double roll = 0;                                ///< degrees, counter-clockwise
  bool ortho = false;                             ///< an orthographic camera
  std::optional<double> fov{};                    ///< of a pinhole, degrees
  std::optional<double> margin{};  ///< around the particles, as a share of the picture
  std::string first{};  ///< the first option of these that was given: "--look"; empty: none
  std::vector<GivenOption> given{};  ///< all of these on the command line
};

/// The floor of a scene, in the coordinates of the file: a plane through `point` with the normal
/// `up`.
struct LookFloor {
  Vec3d point, up;
};

/// The name of the floor's material, which the scene has if `floor` is asked for.
inline constexpr const char* floor_material = "floor";

/// The scene in which a particle file is shown, as TOML (docs/scene_format.md). `file` is its name
/// as seen from where the scene is.
std::string look_scene(const std::string& file, const LookOptions& options,
                       const std::optional<LookFloor>& floor = {});

}  // namespace boule
