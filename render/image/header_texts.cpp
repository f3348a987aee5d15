#include "render/image/header_texts.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace boule {
namespace {

using HeaderEntry = Metadata::value_type;

const std::string* text_of(const HeaderEntry& entry) {
  return std::get_if<std::string>(&entry.second);
}

/// The most bytes that an entry's text takes in a file. A file may keep the text with its name, its
/// length and its offset, or as a list of parts between semicolons, each with its own length
/// (IPTC).
std::size_t room_of(const HeaderEntry& entry) {
  constexpr std::size_t numbers = 32, numbers_of_part = 8;
  const std::string* const text = text_of(entry);
  if (text == nullptr) return 0;
  const auto parts = static_cast<std::size_t>(std::count(text->begin(), text->end(), ';'));
  return numbers + entry.first.size() + text->size() + parts * numbers_of_part;
}

void end_at_nul(std::string& text) { text.resize(std::min(text.find('\0'), text.size())); }

void end_texts_at_nul(Metadata& metadata) {
  for (auto& [name, value] : metadata) {
    end_at_nul(name);
    if (auto* const text = std::get_if<std::string>(&value)) end_at_nul(*text);
  }
}

/// Leaves one entry of each name, in the place of the first and with what the last one says.
void keep_last(Metadata& metadata) {
  Metadata kept;
  for (HeaderEntry& entry : metadata) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const HeaderEntry& before) {
      return before.first == entry.first;
    });
    if (same == kept.end()) {
      kept.push_back(std::move(entry));
    } else {
      same->second = std::move(entry.second);
    }
  }
  metadata = std::move(kept);
}

void leave_out_empty(Metadata& metadata) {
  std::erase_if(metadata, [](const HeaderEntry& entry) {
    const std::string* const text = text_of(entry);
    return entry.first.empty() || (text != nullptr && text->empty());
  });
}

/// What is wrong with an entry's name, or an empty text. Formats keep the bytes of an ICC profile
/// under "ICCProfile". libpng complains on standard error about names with control bytes.
std::string name_problem(const std::string& name) {
  constexpr std::size_t longest = 255;  // OpenEXR's
  const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
  if (name.size() > longest) return "has a name longer than 255 bytes";
  if (std::any_of(name.begin(), name.end(), is_control)) return "has control bytes in its name";
  constexpr std::string_view profile = "iccprofile";
  const bool is_profile = std::equal(name.begin(), name.end(), profile.begin(), profile.end(),
                                     [](char a, char b) { return (a | ' ') == b; });
  return is_profile ? "is neither a text nor a number" : "";
}

}  // namespace

std::string prepare_header_texts(Metadata& metadata, const ImageFormat& format) {
  end_texts_at_nul(metadata);
  keep_last(metadata);
  leave_out_empty(metadata);
  const auto room = static_cast<std::size_t>(format.text_room);
  std::size_t taken = 0, largest = 0;
  for (const HeaderEntry& entry : metadata) {
    const std::string problem = name_problem(entry.first);
    if (!problem.empty()) return "metadata " + quote(entry.first) + " " + problem;
    taken += room_of(entry);
    largest = std::max(largest, room_of(entry));
  }
  if (taken <= room) return {};
  const auto longest =
      std::find_if(metadata.begin(), metadata.end(),
                   [&](const HeaderEntry& entry) { return room_of(entry) == largest; });
  return "metadata " + quote(longest->first) + " has " + std::to_string(text_of(*longest)->size()) +
         " bytes of text, a ." + format.extension + " file has room for " + std::to_string(room) +
         " in all";
}

}  // namespace boule
