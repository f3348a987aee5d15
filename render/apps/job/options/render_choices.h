#pragma once

#include <string>
#include <tuple>
#include <utility>

#include "render/apps/job/options/choice.h"
#include "render/apps/job/options/look_values.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/job/render_job.h"

namespace boule {

namespace heading {

inline constexpr const char* picture = "Picture";
inline constexpr const char* light = "Camera and light";
inline constexpr const char* work = "Work";
inline constexpr const char* machine = "Machine";

}  // namespace heading

/// The options of a SceneJob, but for those of its look.
inline auto scene_choices() {
  using J = SceneJob;
  using O = RenderOptions;
  using detail::choice;
  return std::tuple{
      choice<J>(heading::picture, "polygons", &J::polygons, NameRule{}, "",
                "What an NFF polygon becomes (plane)"),
      choice<J>(heading::work, "trust", &J::trust, FlagRule{}, "",
                "Open a packed scene without checking it: for files of one's own only"),
      choice<J>(heading::machine, "isa", &J::isa,
                TextRule{parse_words, "the name of an instruction set"}, "NAME",
                "Instruction set; boule isa lists them (auto)", &O::isa),
      choice<J>(heading::machine, "solver", &J::solver, NameRule{}, "",
                "How hits are found (robust)", &O::solver),
      choice<J>(heading::machine, "threads", &J::threads, WholeRule{.low = 0, .high = max_threads},
                "N", "Threads, 0: all (0)", &O::threads),
  };
}

namespace detail {

inline auto size_choices() {
  using J = RenderJob;
  using namespace heading;
  return std::tuple{
      choice<J>(
          picture, "size", &J::size,
          TextRule{parse_size, "WIDTHxHEIGHT in pixels, each 1 to 65535, such as 1280x720", 'x'},
          "WxH", "Pixels of the picture"),
      choice<J>(picture, "width", &J::width,
                TextRule{parse_length, "a width in print, such as 85mm, 8.5cm, 3.3in or 240pt"},
                "LENGTH",
                "Width of the printed picture, such as 85mm: pixels by --dpi, --size is the shape"),
      choice<J>(picture, "dpi", &J::dpi, rule::from_to(1, 10000), "N",
                "Pixels per inch, which the picture's file tells (300 with --width)"),
  };
}

inline auto sample_choices() {
  using J = RenderJob;
  using O = RenderOptions;
  using namespace heading;
  return std::tuple{
      choice<J>(picture, "spp", &J::spp, rule::samples, "N", "Samples per pixel"),
      choice<J>(
          picture, "noise", &J::noise, rule::noise, "X",
          "Samples until each pixel is right to X of 0..1 as it is shown (95 %), --spp at most "
          "(4096); 0.004 is a step of 8 bits; 0: --spp for all"),
      choice<J>(picture, "min_spp", &J::min_spp, rule::least_samples, "N",
                "With --noise: the fewest samples of a pixel (32)", &O::min_spp),
      choice<J>(picture, "aa", &J::aa, rule::aa, "X",
                "Adaptive antialiasing for method whitted: more than one sample only where pixels "
                "differ by more than X of 255, such as 8, --spp at most (64); 0: --spp for all"),
      choice<J>(picture, "filter", &J::filter, NameRule{}, "",
                "How a pixel is made of samples: the pixel alone, or with its surroundings",
                &O::filter),
  };
}

inline auto picture_choices() {
  using J = RenderJob;
  using O = RenderOptions;
  using namespace heading;
  return std::tuple{
      choice<J>(picture, "background", &J::background,
                TextRule{parse_background, "a colour such as #ffffff or white, or transparent", ',',
                         hint_background},
                "COLOR",
                "What shows where nothing is: a colour such as #rrggbb or white, or transparent "
                "(EXR, PNG)"),
      choice<J>(picture, "outline", &J::outline,
                TextRule{parse_outline, "0 to 100 pixels, or points such as 0.5pt"}, "W",
                "Dark lines where what is seen changes, W pixels wide, or points as in 0.5pt (0; "
                "printed at least 0.35pt where the scene has some)"),
      choice<J>(picture, "fog", &J::fog, rule::fog, "X",
                "Blend to the background with the depth, from 0 at what is nearest to X of 0..1 at "
                "what is farthest, such as 0.3 (0)",
                &O::fog),
      choice<J>(picture, "overlay", &J::overlay,
                TextRule{parse_overlay, "none, or some of " + list_overlay_parts() + ", each once",
                         ',', hint_overlay},
                "PARTS",
                "Drawn on the picture, of 8 bits, or as vectors in PDF and SVG: any of " +
                    list_overlay_parts() + ", or none"),
      choice<J>(picture, "seed", &J::seed,
                TextRule{parse_seed, "a whole number from 0 to 18446744073709551615"}, "N",
                "Seed of the random numbers (0)", &O::seed),
      choice<J>(
          picture, "crop", &J::crop,
          TextRule{parse_crop,
                   "X0,Y0,X1,Y1 in pixels from the upper left corner, 0 <= X0 < X1 and 0 <= Y0 "
                   "< Y1"},
          "X0,Y0,X1,Y1", "Render these pixels of the frame only", &O::crop),
      choice<J>(
          picture, "aov", &J::aovs, TextRule{parse_aovs, "some of " + list_aovs() + ", each once"},
          "NAMES",
          "More channels in an EXR picture, each pixel's centre, unfiltered: any of " + list_aovs(),
          &O::aovs),
  };
}

inline auto light_and_work_choices() {
  using J = RenderJob;
  using O = RenderOptions;
  using namespace heading;
  return std::tuple{
      choice<J>(light, "method", &J::method, NameRule{}, "", "How light is followed", &O::method),
      choice<J>(light, "max_depth", &J::max_depth, rule::bounces, "N",
                "Bounces after the first hit", &O::max_depth),
      choice<J>(light, "least_weight", &J::least_weight, rule::weight, "W",
                "Leave out mirrored and refracted rays whose weights in a sample add up to at most "
                "W of 0..1, such as 0.001 (0)",
                &O::least_weight),
      choice<J>(
          light, "shadow_epsilon", &J::shadow_epsilon,
          TextRule{parse_shadow_epsilon, "none, or a length of 0 or more"}, "X|none",
          "For teaching: shadow rays start X from a surface, as in lectures, or with no remedy "
          "against false shadows at all (Boule's own way, which needs no epsilon)",
          &O::shadow_epsilon),
      choice<J>(light, "exposure", &J::exposure_stops, rule::from_to(-100, 100), "STOPS",
                "Brighten 8-bit pictures by 2^STOPS (0)", &O::exposure_stops),
      choice<J>(work, "order", &J::order, NameRule{}, "",
                "Order of the pixels; never shows in a finished picture (tiles; with --partial: "
                "progressive)"),
      choice<J>(work, "tile", &J::tile, WholeRule{.low = 1, .high = max_tile}, "N",
                "Side of a tile in pixels (16 to 256, as fits)", &O::tile),
  };
}

}  // namespace detail

/// The other options of a RenderJob, in the order of the help.
inline auto render_choices() {
  return std::tuple_cat(detail::size_choices(), detail::sample_choices(), detail::picture_choices(),
                        detail::light_and_work_choices());
}

}  // namespace boule
