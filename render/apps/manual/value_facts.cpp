#include "render/apps/manual/value_facts.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "core/base/text.h"
#include "core/math/color_names.h"
#include "render/apps/cli/report/movie.h"
#include "render/apps/job/options/look_values.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/job/overlay/overlay_facts.h"
#include "render/files/file/unpack.h"
#include "render/files/particle_file/particle_file.h"
#include "render/image/image_format.h"
#include "simd/dispatch/dispatch.h"

namespace boule::manual {
namespace {

using Words = std::vector<std::string>;

constexpr std::string_view film_ending = ".film";

bool is_word(std::string_view text) {
  const auto is_inner = [](unsigned char letter) {
    return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '_' || letter == '-';
  };
  return !text.empty() && text[0] != '-' && std::all_of(text.begin(), text.end(), is_inner);
}

/// The parts of `text` between any of the separators, none of them empty.
Words parts_of(std::string_view text, std::string_view separators) {
  const auto parts = boule::words_of(text, separators);
  return {parts.begin(), parts.end()};
}

/// "text", "json" of "text|json[:FILE]": the alternatives that are names.
Words alternatives(const std::string& value) {
  Words names;
  if (value.find('|') == std::string::npos) return names;
  for (const std::string& part : parts_of(value, "|")) {
    const std::string name = part.substr(0, part.find('['));
    if (is_word(name)) names.push_back(name);
  }
  return names;
}

/// Every ".toml" that a text names.
Words endings_in(const std::string& text) {
  Words endings;
  for (const std::string& word : parts_of(text, " ,;:()")) {
    if (word.size() > 1 && word[0] == '.' && is_word(word.substr(1))) endings.push_back(word);
  }
  return endings;
}

Words isa_names() {
  Words names{"auto"};
  for (const IsaInfo& isa : list_isas()) names.emplace_back(isa.name);
  return names;
}

Words format_names() {
  Words names;
  for (const std::string_view format : particle_formats()) names.emplace_back(format);
  return names;
}

Words colors_of(const std::string& option) {
  Words words;
  if (option == "background") words.emplace_back("transparent");
  for (const std::string_view name : color_names()) words.emplace_back(name);
  return words;
}

/// The names that an option of this name takes, besides what else it may.
Words known_words(const std::string& name) {
  if (name == "aov") return split(list_aovs(), ',');
  if (name == "background" || name == "nan-color") return colors_of(name);
  if (name == "color") return {"element"};
  if (name == "input-format") return format_names();
  if (name == "isa") return isa_names();
  if (name == "map") return parts_of(list_color_maps(), ", ");
  if (name == "overlay") return split(list_overlay_parts(), ',');
  if (name == "radius") return {"vdw", "covalent", "ionic"};
  if (name == "view") return {"principal", "upright", "iso", "x", "-x", "y", "-y", "z", "-z"};
  if (name == "up") return {"x", "-x", "y", "-y", "z", "-z"};
  return {};
}

Words image_endings() {
  Words endings = parts_of(known_image_extensions(), ", ");
  for (std::string& ending : endings) ending.insert(ending.begin(), '.');
  for (const std::string_view movie : cli::movie_endings) endings.emplace_back(movie);
  endings.emplace_back(film_ending);  // shards
  return endings;
}

Words file_endings(const OptionFacts& option) {
  if (option.value == "IMAGE") return image_endings();
  if (option.name == "checkpoint" || option.value == "FILMS") return {std::string(film_ending)};
  const bool is_positional = option.name.empty();
  Words endings = endings_in(option.text);
  if (!is_positional) {
    const std::size_t dot = option.value.find('.');
    return dot == std::string::npos ? Words{} : Words{option.value.substr(dot)};
  }
  if (option.value == "SCENE" || option.value == "FILE") {
    for (const std::string& ending : parts_of(known_particle_endings(), " "))
      endings.push_back(ending);
    for (const std::string_view packed : packed_endings) endings.emplace_back(packed);
  }
  std::sort(endings.begin(), endings.end());
  endings.erase(std::unique(endings.begin(), endings.end()), endings.end());
  return endings;
}

}  // namespace

ValueFacts value_facts(const OptionFacts& option) {
  ValueFacts facts;
  facts.words = alternatives(option.value);
  if (facts.words.empty()) facts.words = known_words(option.name);
  facts.endings = file_endings(option);
  facts.list = option.name == "aov";
  return facts;
}

}  // namespace boule::manual
