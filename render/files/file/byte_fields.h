#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/scene.h"

/// Values as bytes, exactly, and back: in packed scenes, film files, and letters between ranks. A
/// struct has its fields by their keys (each_field()), so that a file can still be read when the
/// struct has got more of them; enums, and variants of such structs, have names. What a file of
/// bytes holds may be anything: the reader says whether it was such a value.
namespace boule {

/// Types that are their own bytes.
template <class T>
concept PlainBytes = std::is_arithmetic_v<T> || std::is_same_v<T, Vec3f> ||
    std::is_same_v<T, Vec3d> || std::is_same_v<T, Color> || std::is_same_v<T, MaterialRef>;

template <class... Kinds>
inline constexpr bool have_names = (HasFields<Kinds> && ...);

class ByteWriter {
 public:
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

  /// Adds them one after the other.
  template <class... Values>
  ByteWriter& put(const Values&... values) {
    (add(values), ...);
    return *this;
  }

  template <PlainBytes T>
  void add(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    bytes_ += text;
  }
  void add(const std::string& text) { add(std::string_view(text)); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Enum value) { add(name_of(value)); }
  template <class T>
  void add(const Both<const T>& both) {
    add(both.first);
    add(both.second);
  }
  template <class T>
  void add(const std::optional<T>& some) {
    add(some.has_value());
    if (some) add(*some);
  }
  template <class... Kinds>
  void add(const std::variant<Kinds...>& one_of) {
    if constexpr (!have_names<Kinds...>) add(static_cast<std::uint32_t>(one_of.index()));
    std::visit(
        [this](const auto& value) {
          if constexpr (have_names<Kinds...>)
            this->add(fields<std::remove_cvref_t<decltype(value)>>.type);
          this->add(value);
        },
        one_of);
  }
  template <class A, class B>
  void add(const std::pair<A, B>& both) {
    put(both.first, both.second);
  }
  template <PlainBytes T, std::size_t n>
  void add(const std::array<T, n>& list) {
    for (const T& one : list) add(one);
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(std::uint64_t{list.size()});
    if constexpr (PlainBytes<T>) {
      bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    } else {
      for (const T& one : list) add(one);
    }
  }
  template <HasFields T>
  void add(const T& value) {
    std::uint32_t count = 0;
    each_field(value, [&count](const auto& field, const auto& member) {
      count += says(field.key, member) ? 1 : 0;
    });
    add(count);
    each_field(value, [this](const auto& field, const auto& member) {
      if (!says(field.key, member)) return;
      ByteWriter own;
      own.add(member);
      this->add(field.key);
      this->add(std::string_view(own.bytes()));
    });
  }
  /// What stands elsewhere.
  void add(const std::shared_ptr<const PackedSpheres>&) {}

 private:
  /// Without capsules or clips a scene has the bytes that versions without them give it and read.
  /// The same without groups of outlines, and without fog.
  static bool says(std::string_view, const std::vector<Capsule>& capsules) {
    return !capsules.empty();
  }
  static bool says(std::string_view, const std::vector<Clip>& clips) { return !clips.empty(); }
  static bool says(std::string_view, const OutlineGroups& groups) { return !groups.empty(); }
  static bool says(std::string_view key, float number) { return key != "fog" || number != 0; }
  static bool says(std::string_view key, const std::optional<float>& number) {
    return !key.starts_with("fog") || number.has_value();
  }
  template <class T>
  static bool says(std::string_view, const T&) {
    return true;
  }

  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  /// Whether all values were there, with nothing behind them.
  [[nodiscard]] bool finished() const { return good_ && rest_.empty(); }
  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// A key that no struct here has: a newer version of the program has written it.
  [[nodiscard]] const std::string& unknown() const { return unknown_; }

  template <PlainBytes T>
  void read(T& value) {
    if (!take(sizeof value)) return;
    if constexpr (std::is_same_v<T, bool>) {
      value = taken_[0] != 0;
    } else {
      std::memcpy(static_cast<void*>(&value), taken_.data(), sizeof value);
    }
  }
  /// The next value; where there is none, one of the default, and the reader is not good().
  template <class T>
  T get() {
    T value{};
    read(value);
    return value;
  }
  void read(std::string& text) { text = read_text(); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void read(Enum& value) {
    const std::string_view name = read_text();
    for (std::size_t i = 0; i < names<Enum>.size(); ++i) {
      if (names<Enum>[i] == name) return void(value = static_cast<Enum>(i));
    }
    good_ = false;
  }
  template <class T>
  void read(const Both<T>& both) {
    read(both.first);
    read(both.second);
  }
  template <class T>
  void read(std::optional<T>& some) {
    bool has = false;
    read(has);
    if (has && good_) read(some.emplace());
  }
  template <class... Kinds>
  void read(std::variant<Kinds...>& one_of) {
    if constexpr (have_names<Kinds...>) {
      const std::string_view name = read_text();
      if (!(read_kind<Kinds>(name, one_of) || ...)) good_ = false;
    } else {
      const auto wanted = get<std::uint32_t>();
      std::uint32_t index = 0;
      const bool found =
          ((index++ == wanted && (read(one_of.template emplace<Kinds>()), true)) || ...);
      if (!found) good_ = false;
    }
  }
  template <class A, class B>
  void read(std::pair<A, B>& both) {
    read(both.first);
    read(both.second);
  }
  template <PlainBytes T, std::size_t n>
  void read(std::array<T, n>& list) {
    for (T& one : list) read(one);
  }
  template <class T>
  void read(std::vector<T>& list) {
    std::uint64_t size = 0;
    read(size);
    if constexpr (PlainBytes<T>) {
      if (size > rest_.size() / sizeof(T)) good_ = false;
      if (!good_) return;
      list.resize(static_cast<std::size_t>(size));
      if (take(list.size() * sizeof(T)) && !list.empty())
        std::memcpy(static_cast<void*>(list.data()), taken_.data(), taken_.size());
    } else {
      for (; size > 0 && good_; --size) read(list.emplace_back());
    }
  }
  template <HasFields T>
  void read(T& value) {
    Entries entries = read_entries();
    each_field(value, [&](const auto& field, auto&& member) {
      const auto found = std::find_if(entries.begin(), entries.end(),
                                      [&](const auto& entry) { return entry.first == field.key; });
      if (found == entries.end()) return;  // it was written before there was this field
      ByteReader own(found->second);
      own.read(member);
      if (!own.finished()) good_ = false;
      if (unknown_.empty()) unknown_ = own.unknown_;
      entries.erase(found);
    });
    if (!entries.empty() && unknown_.empty()) unknown_ = entries.front().first;
  }
  void read(std::shared_ptr<const PackedSpheres>&) {}

 private:
  using Entries = std::vector<std::pair<std::string_view, std::string_view>>;

  bool take(std::size_t size) {
    if (size > rest_.size()) good_ = false;
    if (!good_) return false;
    taken_ = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }
  std::string_view read_text() {
    std::uint64_t size = 0;
    read(size);
    if (size > rest_.size()) good_ = false;
    return take(static_cast<std::size_t>(size)) ? taken_ : std::string_view();
  }
  Entries read_entries() {
    std::uint32_t count = 0;
    read(count);
    Entries entries;
    for (; count > 0 && good_; --count) {
      const std::string_view key = read_text();
      entries.emplace_back(key, read_text());
    }
    return entries;
  }
  template <class Kind, class Variant>
  bool read_kind(std::string_view name, Variant& one_of) {
    if (name != fields<Kind>.type) return false;
    read(one_of.template emplace<Kind>());
    return true;
  }

  std::string_view rest_, taken_;
  bool good_ = true;
  std::string unknown_;
};

}  // namespace boule
