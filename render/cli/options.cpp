#include "render/cli/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <map>
#include <vector>

#include "core/scene/scene.h"

namespace boule::cli {
namespace {

constexpr const char* description =
    "Boule renders scenes of spheres and planes: exact hits, the same bits on every machine.";

/// The whole numbers of `text`, separated by `separator`; nothing if it is not just that.
std::optional<std::vector<int>> split_numbers(const std::string& text, char separator) {
  std::vector<int> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    int number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{}) return std::nullopt;
    numbers.push_back(number);
    if (next == end) return numbers;
    if (*next != separator) return std::nullopt;
    at = next + 1;
  }
}

CLI::ValidationError refuse(const std::string& option, const std::string& text,
                            const std::string& expected) {
  return CLI::ValidationError(option, quote(text) + " is not understood, expected " + expected);
}

Size parse_size(const std::string& text) {
  const auto numbers = split_numbers(text, 'x');
  const auto fits = [](int side) { return side >= 1 && side <= max_image_side; };
  if (!numbers || numbers->size() != 2 || !fits((*numbers)[0]) || !fits((*numbers)[1])) {
    throw refuse("--size", text, "WIDTHxHEIGHT in pixels, each 1 to 65535, such as 1280x720");
  }
  return {(*numbers)[0], (*numbers)[1]};
}

PixelRect parse_crop(const std::string& text) {
  const auto numbers = split_numbers(text, ',');
  if (!numbers || numbers->size() != 4) {
    throw refuse("--crop", text, "X0,Y0,X1,Y1 in pixels from the upper left corner");
  }
  const PixelRect rect{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
  if (rect.empty() || rect.x0 < 0 || rect.y0 < 0) {
    throw refuse("--crop", text, "0 <= X0 < X1 and 0 <= Y0 < Y1");
  }
  return rect;
}

template <class T>
struct Choice {
  const char* name;
  T value;
};

/// An option that takes one of a few names.
template <class T, std::size_t n>
void add_choice(CLI::App& app, const std::string& name, T& target,
                const std::array<Choice<T>, n>& choices, const std::string& help) {
  std::string names;
  for (const Choice<T>& choice : choices)
    names += (names.empty() ? "" : "|") + std::string(choice.name);
  const auto parse = [&target, name, choices, names](const std::string& text) {
    for (const Choice<T>& choice : choices) {
      if (text == choice.name) return void(target = choice.value);
    }
    throw refuse(name, text, "one of " + names);
  };
  app.add_option_function<std::string>(name, parse, help)->type_name(names);
}

void add_picture_options(CLI::App& app, RenderCommand& command) {
  app.add_option("scene", command.scene, "Scene file, .toml or .nff")->required();
  app.add_option("-o,--output", command.output, "Picture to write; its extension names the format")
      ->required()
      ->type_name("IMAGE");
  app.add_option_function<std::string>(
         "--size", [&](const std::string& text) { command.size = parse_size(text); },
         "Pixels of the picture")
      ->type_name("WxH");
  app.add_option("--spp", command.spp, "Samples per pixel")->check(CLI::Range(1, max_count));
  app.add_option("--seed", command.seed, "Seed of the sample positions");
  app.add_option("--max-depth", command.max_depth, "Bounces after the first hit")
      ->check(CLI::Range(0, max_count));
  app.add_option_function<std::string>(
         "--crop", [&](const std::string& text) { command.crop = parse_crop(text); },
         "Render these pixels of the frame only")
      ->type_name("X0,Y0,X1,Y1");
  app.add_option("--exposure", command.exposure_stops, "Brighten 8-bit pictures by 2^STOPS")
      ->check(CLI::Range(-100.0F, 100.0F))
      ->type_name("STOPS");
  add_choice(app, "--compression", command.compression,
             std::array{Choice{"none", Compression::none}, Choice{"rle", Compression::rle},
                        Choice{"zip", Compression::zip}},
             "Packing of EXR pictures (zip)");
  add_choice(app, "--polygons", command.polygons,
             std::array{Choice{"plane", PolygonPolicy::plane}, Choice{"skip", PolygonPolicy::skip},
                        Choice{"error", PolygonPolicy::error}},
             "What an NFF polygon becomes (plane)");
}

void add_machine_options(CLI::App& app, RenderCommand& command) {
  app.add_option("--isa", command.isa, "Instruction set; boule isa lists them (auto)")
      ->type_name("NAME");
  add_choice(app, "--solver", command.solver,
             std::array{Choice{"fast", Solver::fast}, Choice{"robust", Solver::robust},
                        Choice{"reference", Solver::reference}},
             "How hits are found (robust)");
  app.add_option("-t,--threads", command.threads, "Threads, 0: all (0)")
      ->check(CLI::Range(0, 1024));
  app.add_option("--tile", command.tile, "Side of a tile in pixels (16)")
      ->check(CLI::Range(1, max_tile));
  add_choice(app, "--order", command.order,
             std::array{Choice{"rows", PixelOrder::rows}, Choice{"tiles", PixelOrder::tiles},
                        Choice{"progressive", PixelOrder::progressive},
                        Choice{"frameless", PixelOrder::frameless}},
             "Order of the pixels; never shows in the picture (tiles)");
  app.add_flag("-q,--quiet", command.quiet, "No notes, only errors");
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  RenderCommand render;
  IsaCommand isa;
  CLI::App app(description, "boule");
  app.set_version_flag("--version", "boule " BOULE_VERSION);
  app.require_subcommand(1);
  CLI::App* const render_app = app.add_subcommand("render", "Render a scene to a picture");
  add_picture_options(*render_app, render);
  add_machine_options(*render_app, render);
  CLI::App* const isa_app = app.add_subcommand("isa", "List the instruction sets");
  isa_app->add_flag("--json", isa.json, "As JSON, for programs");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    return TextCommand{chosen.empty() ? app.help() : chosen.front()->help()};
  } catch (const CLI::CallForVersion& version) {
    return TextCommand{std::string(version.what()) + "\n"};
  } catch (const CLI::ParseError& error) {
    return UsageError{error.what()};
  }
  if (render_app->parsed()) return render;
  return isa;
}

}  // namespace boule::cli
