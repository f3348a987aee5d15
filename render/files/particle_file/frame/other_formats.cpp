#include "render/files/particle_file/frame/other_formats.h"

#include <algorithm>
#include <array>

#include "core/base/text.h"

namespace boule {
namespace {

/// Formats of other programs and what helps with them.
struct OtherFormats {
  std::string_view endings;  ///< each between blanks
  std::string_view advice;
};

constexpr std::string_view by_ase =
    "--input-format library has ASE look at it, boule.from_ase of Python shows what ASE reads";
constexpr std::array others{
    OtherFormats{" tng mmtf ", "MDAnalysis or OVITO makes a .pdb, .gro or .dump of it"},
    OtherFormats{" txyz arc ",
                 "Open Babel makes a .xyz of it: obabel -i txyz FILE -o xyz -O NEW.xyz"},
    OtherFormats{" las laz e57 pcd pts ", "CloudCompare makes a .ply of it"},
    OtherFormats{" vti vts vtr pvd pvtu pvtp ", "ParaView makes a .csv of it"},
    OtherFormats{" fits parquet feather xlsx json vot ",
                 "boule.from_particles of Python takes arrays that are read from it"},
};

}  // namespace

std::string advice_for(std::string_view path) {
  const std::string name = ascii_lower(path.substr(path.rfind('/') + 1));  // npos + 1 is 0
  const std::string ending = name.substr(name.rfind('.') + 1);
  for (const OtherFormats& formats : others) {
    if (formats.endings.find(" " + ending + " ") == std::string_view::npos) continue;
    return "; " + std::string(formats.advice);
  }
  return "; " + std::string(by_ase) + ", boule.from_particles takes arrays";
}

}  // namespace boule
