#include "bench/peers/frames/frame_programs.h"

#include <fmt/format.h>

#include "bench/peers/frames/child_process.h"
#include "bench/peers/frames/frame_scene.h"
#include "bench/peers/frames/text_file.h"

namespace boule::bench {
namespace {

using std::filesystem::path;

std::string square(int side, const char* form) { return fmt::format(fmt::runtime(form), side); }

FrameProgram boule_program(const std::string& isa, const path& scene) {
  FrameProgram program;
  program.name = "boule-" + isa;
  program.binary = program.path = BOULE_PROGRAM;
  program.ours = true;
  program.curve = Curve::srgb;
  program.command = [isa, scene](int side, unsigned threads, const std::string& picture) {
    return std::vector<std::string>{BOULE_PROGRAM,
                                    "render",
                                    scene.string(),
                                    "-o",
                                    picture,
                                    "--size",
                                    square(side, "{0}x{0}"),
                                    "--isa",
                                    isa,
                                    "-q",
                                    "--max-depth",
                                    std::to_string(frame_bounces),
                                    "-t",
                                    std::to_string(threads)};
  };
  return program;
}

FrameProgram tachyon_program(const char* name, const path& scene) {
  FrameProgram program;
  program.name = name;
  program.binary = "tachyon";
  program.path = find_program(program.binary);
  program.tolerance = tachyon_tolerance;
  program.habit = beyond_tachyons_last_mirror();
  program.command = [program, scene](int side, unsigned threads, const std::string& picture) {
    const std::string pixels = std::to_string(side);
    return std::vector<std::string>{program.path,  scene.string(),
                                    "-res",        pixels,
                                    pixels,        "-o",
                                    picture,       "-format",
                                    "PPM",         "-shade_phong",
                                    "-raydepth",   std::to_string(frame_bounces + 1),
                                    "-numthreads", std::to_string(threads)};
  };
  return program;
}

FrameProgram pov_program(const path& scene) {
  FrameProgram program;
  program.name = program.binary = "povray";
  program.path = find_program(program.binary);
  program.tolerance = pov_tolerance;
  program.command = [program, scene](int side, unsigned threads, const std::string& picture) {
    return std::vector<std::string>{program.path,
                                    scene.string(),
                                    square(side, "+W{}"),
                                    square(side, "+H{}"),
                                    fmt::format("+WT{}", threads),
                                    "-A",
                                    "-D",
                                    "-V",
                                    "-GA",
                                    "+FP8",
                                    "File_Gamma=1.0",
                                    "+O" + picture};
  };
  return program;
}

}  // namespace

Result<std::vector<FrameProgram>> make_frame_programs(const BenchScene& flake,
                                                      const std::vector<std::string>& isas,
                                                      int side, const path& folder) {
  const path nff = folder / "scene.nff", pov = folder / "scene.pov";
  const path with_plane = folder / "plane.dat", with_square = folder / "square.dat";
  const auto tachyon = [&](Floor floor) {
    return as_tachyon(flake, floor, side, frame_bounces + 1);
  };
  if (auto done = write_text(nff, as_nff(flake)); !done) return done.error();
  if (auto done = write_text(pov, as_pov(flake, frame_bounces + 1)); !done) return done.error();
  if (auto done = write_text(with_plane, tachyon(Floor::plane)); !done) return done.error();
  if (auto done = write_text(with_square, tachyon(Floor::square)); !done) return done.error();
  std::vector<FrameProgram> programs;
  programs.reserve(isas.size() + 3);
  for (const std::string& isa : isas) programs.push_back(boule_program(isa, nff));
  programs.push_back(pov_program(pov));
  programs.push_back(tachyon_program("tachyon-plane", with_plane));
  programs.push_back(tachyon_program("tachyon-square", with_square));
  return programs;
}

}  // namespace boule::bench
