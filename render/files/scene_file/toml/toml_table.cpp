#include "render/files/scene_file/toml/toml_table.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "core/math/color_names.h"
#include "render/files/file/float32.h"
#include "render/files/file/nearest_name.h"
#include "render/files/file/npz_member.h"
#include "render/files/scene_file/loaded/frame_name.h"

namespace boule {
namespace {

/// What a value is called in messages; in the order of TomlValue's alternatives.
const char* type_name(const TomlValue& value) {
  constexpr const char* names[] = {"a date or time", "a boolean", "an integer", "a number",
                                   "a string",       "an array",  "a table"};
  static_assert(std::size(names) == std::variant_size_v<decltype(TomlValue::data)>);
  return names[value.data.index()];
}

const TomlValue* find_member(const TomlMembers& members, std::string_view key) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const TomlMember& member) { return member.key == key; });
  return found == members.end() ? nullptr : &found->value;
}

/// Three numbers as codes of 8 bits, if they look like that: whole ones up to 255, one above 1.
std::optional<SrgbColor> codes_like(const Vec3f& rgb) {
  std::array<std::uint8_t, 3> codes{};
  const std::array components{rgb.x, rgb.y, rgb.z};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(components[i] >= 0 && components[i] <= 255)) return std::nullopt;
    codes[i] = static_cast<std::uint8_t>(components[i]);
    if (static_cast<float>(codes[i]) != components[i]) return std::nullopt;
  }
  if (*std::max_element(codes.begin(), codes.end()) <= 1) return std::nullopt;
  return SrgbColor{codes[0], codes[1], codes[2]};
}

}  // namespace

TomlTable::TomlTable(const TomlMembers& members, TextPlace place, std::string path,
                     FirstError& error)
    : members_(&members), place_(place), path_(std::move(path)), error_(&error) {}

std::string TomlTable::beside_scene(const std::string& name) const {
  return (std::filesystem::path(error_->file()).parent_path() / name).string();
}

std::string TomlTable::file_path(const std::string& name) {
  std::string path = beside_scene(name);
  const auto in_archive = npz_name(path);
  error_->add_data_file(in_archive ? in_archive->file : path);
  return path;
}

void TomlTable::read_file_name(std::string_view key, std::string& name) {
  read(key, name);
  if (const auto frame = error_->frame()) {
    name = frame_name(name, *frame);
    return;
  }
  std::error_code ignored;
  if (!has_wide_frame_slot(name) || std::filesystem::exists(beside_scene(name), ignored)) return;
  report(key,
         quote(name) + " is not there, but has a place for a frame's number: --frames is missing");
}

const TomlValue* TomlTable::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return find_member(*members_, key);
}

/// The dotted path of a key of this table.
std::string TomlTable::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void TomlTable::report_at(TextPlace place, std::string_view key, std::string message) {
  error_->report(place, path_of(safe_name(key)), std::move(message));
}

TextPlace TomlTable::place_of(std::string_view key) const {
  const TomlValue* value = find_member(*members_, key);
  return value != nullptr ? value->place : place_;
}

void TomlTable::report(std::string_view key, std::string message) {
  report_at(place_of(key), key, std::move(message));
}

void TomlTable::report_type(const TomlValue& value, std::string_view key,
                            const std::string& expected) {
  report_at(value.place, key, "expected " + expected + ", got " + type_name(value));
}

void TomlTable::check(const std::optional<Problem>& problem) {
  if (problem) report(problem->field, problem->message);
}

void TomlTable::convert(const TomlValue& value, std::string_view key, float& out) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
    out = static_cast<float>(*integer);
    return;
  }
  const auto* number = std::get_if<double>(&value.data);
  if (number == nullptr) return report_type(value, key, "a number");
  const std::optional<float> rounded = to_float32(*number);
  if (!rounded) return report_at(value.place, key, "is too large for a 32-bit float");
  out = *rounded;
}

void TomlTable::convert(const TomlValue& value, std::string_view key, double& out) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.data)) {
    out = static_cast<double>(*integer);
    return;
  }
  const auto* number = std::get_if<double>(&value.data);
  if (number == nullptr) return report_type(value, key, "a number");
  out = *number;
}

void TomlTable::convert(const TomlValue& value, std::string_view key, int& out) {
  const auto* integer = std::get_if<std::int64_t>(&value.data);
  if (integer == nullptr) return report_type(value, key, "an integer");
  constexpr int least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
  if (*integer < least || *integer > most) {
    return report_at(value.place, key,
                     "must be an integer of 32 bits, is " + std::to_string(*integer));
  }
  out = static_cast<int>(*integer);
}

const TomlArray* TomlTable::find_array(std::string_view key, std::size_t count,
                                       const char* of_what) {
  const TomlValue* value = find(key);
  if (value == nullptr) return nullptr;
  const std::string expected = "an array of " + std::to_string(count) + " " + of_what;
  const auto* array = std::get_if<TomlArray>(&value->data);
  if (array == nullptr) {
    report_type(*value, key, expected);
  } else if (array->size() != count) {
    report_at(value->place, key, "expected " + expected + ", got " + std::to_string(array->size()));
    return nullptr;
  }
  return array;
}

void TomlTable::read(std::string_view key, float& out) {
  if (const TomlValue* value = find(key)) convert(*value, key, out);
}

void TomlTable::read(std::string_view key, double& out) {
  if (const TomlValue* value = find(key)) convert(*value, key, out);
}

void TomlTable::read(std::string_view key, bool& out) {
  const TomlValue* value = find(key);
  if (value == nullptr) return;
  const auto* boolean = std::get_if<bool>(&value->data);
  if (boolean == nullptr) return report_type(*value, key, "true or false");
  out = *boolean;
}

void TomlTable::read(std::string_view key, int& out) {
  if (const TomlValue* value = find(key)) convert(*value, key, out);
}

template <class Number>
void TomlTable::read_array(std::string_view key, const char* of_what,
                           std::initializer_list<Number*> out) {
  const TomlArray* array = find_array(key, out.size(), of_what);
  if (array == nullptr) return;
  auto value = array->begin();
  for (Number* const one : out) convert(*value++, key, *one);
}

void TomlTable::read(std::string_view key, int& first, int& second) {
  read_array(key, "integers", {&first, &second});
}

void TomlTable::read(std::string_view key, std::array<int, 3>& out) {
  read_array(key, "integers", {&out[0], &out[1], &out[2]});
}

void TomlTable::read(std::string_view key, std::array<double, 2>& out) {
  read_array(key, "numbers", {&out[0], &out[1]});
}

void TomlTable::read(std::string_view key, Vec3f& out) {
  read_array(key, "numbers", {&out.x, &out.y, &out.z});
}

void TomlTable::read(std::string_view key, Vec3d& out) {
  read_array(key, "numbers", {&out.x, &out.y, &out.z});
}

void TomlTable::read_point(std::string_view key, Vec3f& out) {
  if (origin() == Vec3d{}) return read(key, out);
  Vec3d point = vec_cast<double>(out);
  read(key, point);
  point = point - origin();
  const auto x = to_float32(point.x), y = to_float32(point.y), z = to_float32(point.z);
  if (!x || !y || !z) return report(key, "is too large for a 32-bit float");
  out = {*x, *y, *z};
}

void TomlTable::read(std::string_view key, Color& out) {
  const TomlValue* value = find(key);
  if (value == nullptr) return;
  if (const auto* text = std::get_if<std::string>(&value->data)) {
    const auto color = parse_color(*text);
    if (!color) return report(key, no_color(*text));
    out = linear_of(*color);
    return;
  }
  Vec3f rgb{out.r, out.g, out.b};
  read(key, rgb);
  out = {rgb.x, rgb.y, rgb.z};
  const auto codes = key == "color" ? codes_like(rgb) : std::nullopt;
  if (!codes) return;
  note(key, "colours are linear and 1 is white; codes up to 255 are written \"" + hex_text(*codes) +
                "\"");
}

void TomlTable::note(std::string_view key, const std::string& text) {
  error_->add_note(printable(path_of(key)) + ": " + text);
}

void TomlTable::read(std::string_view key, std::string& out) {
  const TomlValue* value = find(key);
  if (value == nullptr) return;
  const auto* text = std::get_if<std::string>(&value->data);
  if (text == nullptr) return report_type(*value, key, "a string");
  out = *text;
}

void TomlTable::read(std::string_view key, std::vector<std::string>& out) {
  const TomlValue* value = find(key);
  if (value == nullptr) return;
  const auto* array = std::get_if<TomlArray>(&value->data);
  if (array == nullptr) return report_type(*value, key, "an array of strings");
  out.clear();
  for (const TomlValue& element : *array) {
    const auto* text = std::get_if<std::string>(&element.data);
    if (text == nullptr) return report_type(element, key, "a string");
    out.push_back(*text);
  }
}

std::size_t TomlTable::choose(std::string_view key, std::span<const std::string_view> names) {
  std::string name{names[0]};
  read(key, name);
  return index_of(key, name, names);
}

std::vector<std::size_t> TomlTable::choose_some(std::string_view key,
                                                std::span<const std::string_view> names) {
  std::vector<std::string> some;
  read(key, some);
  std::vector<std::size_t> indices;
  for (const std::string& name : some) indices.push_back(index_of(key, name, names));
  return indices;
}

std::size_t TomlTable::index_of(std::string_view key, const std::string& name,
                                std::span<const std::string_view> names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::vector<std::string_view> known(names.begin(), names.end());
  report(key,
         "unknown " + quote(name) + ", expected " + list_names(known) + did_you_mean(name, known));
  return 0;
}

TomlTable TomlTable::inner(const TomlMembers& members, TextPlace place, std::string path) const {
  TomlTable table(members, place, std::move(path), *error_);
  table.origin_ = origin_;
  return table;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const TomlValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  const auto* members = std::get_if<TomlMembers>(&value->data);
  if (members != nullptr) return inner(*members, value->place, path_of(key));
  report_type(*value, key, "a table");
  return std::nullopt;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  std::vector<TomlTable> list;
  const TomlValue* value = find(key);
  if (value == nullptr) return list;
  const std::string expected = "tables, each under a header [[" + path_of(key) + "]]";
  const auto* array = std::get_if<TomlArray>(&value->data);
  if (array == nullptr) {
    report_type(*value, key, expected);
    return list;
  }
  for (const TomlValue& element : *array) {
    const auto* members = std::get_if<TomlMembers>(&element.data);
    const std::string name = std::string(key) + "[" + std::to_string(list.size()) + "]";
    if (members == nullptr) {
      report_type(element, name, expected);
      return list;
    }
    list.push_back(inner(*members, element.place, path_of(name)));
  }
  return list;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> keys;
  keys.reserve(members_->size());
  for (const TomlMember& member : *members_) keys.push_back(member.key);
  return keys;
}

std::vector<TomlTable> TomlTable::named_tables(std::string_view key) {
  std::vector<TomlTable> list;
  const std::optional<TomlTable> outer = table(key);
  if (!outer) return list;
  for (const TomlMember& member : *outer->members_) {
    const auto* members = std::get_if<TomlMembers>(&member.value.data);
    const std::string path = std::string(key) + "." + safe_name(member.key);
    if (members == nullptr) {
      error_->report(member.value.place, path,
                     std::string("expected a table, got ") + type_name(member.value));
      return list;
    }
    list.push_back(inner(*members, member.value.place, path));
    list.back().name_ = member.key;
  }
  return list;
}

void TomlTable::finish(std::initializer_list<std::string_view> required) {
  for (const TomlMember& member : *members_) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
    std::string advice = did_you_mean(member.key, known_);
    if (advice.empty()) advice = ", expected " + list_names(known_);
    return report_at(member.place, member.key, "unknown key " + quote(member.key) + advice);
  }
  for (const std::string_view key : required) {
    if (find_member(*members_, key) == nullptr) {
      return report_at(place_, key, "missing key " + quote(key));
    }
  }
}

}  // namespace boule
