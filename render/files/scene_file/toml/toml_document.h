#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "render/files/scene_file/loaded/text_place.h"

namespace boule {

struct TomlValue;
struct TomlMember;

/// A date, a time or both: legal TOML that no scene key takes.
struct TomlDate {};
using TomlArray = std::vector<TomlValue>;
/// The members of a table, in the order of their keys in the file.
using TomlMembers = std::vector<TomlMember>;

/// One value of a TOML file and where it begins; a table's place is that of its [header].
struct TomlValue {
  TextPlace place;
  std::variant<TomlDate, bool, std::int64_t, double, std::string, TomlArray, TomlMembers> data;
};

/// One "key = value"; `place` is the key's.
struct TomlMember {
  std::string key;
  TextPlace place;
  TomlValue value;
};

/// Parses TOML 1.0 text into its root table. This is the only place that sees toml++ (seconds per
/// translation unit). Errors carry line, column and, where the line shows one, the key.
Result<TomlValue> parse_toml(std::string_view text, const std::string& file);

}  // namespace boule
