#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/math/srgb.h"

namespace boule {

/// What is given for the particles of one kind: of a species, or of a text or a number that tells
/// particles apart.
template <class Value>
struct OfKind {
  std::string kind;
  Value value{};

  friend bool operator==(const OfKind&, const OfKind&) = default;
};
using KindColor = OfKind<SrgbColor>;
using KindRadius = OfKind<double>;

/// Whether both are one element: "Na+" and "na" are.
bool are_one_element(std::string_view a, std::string_view b);

/// What is given for a kind, or null. For a species, what is given for its element counts where
/// nothing is given for its own name.
template <class Value>
const Value* find_given(const std::vector<OfKind<Value>>& given, std::string_view kind,
                        bool is_species) {
  for (const OfKind<Value>& one : given) {
    if (one.kind == kind) return &one.value;
  }
  for (const OfKind<Value>& one : given) {
    if (is_species && are_one_element(one.kind, kind)) return &one.value;
  }
  return nullptr;
}

/// Puts the colours that are given for kinds in place of their others; those without a name, which
/// have no text, get `nan_color`.
void use_given(const std::vector<KindColor>& given, const SrgbColor& nan_color,
               const std::vector<std::string>& kinds, bool are_species,
               std::vector<SrgbColor>& colors);

/// An error, about `key`, if there is no kind of this name, with the one that was meant. Elements
/// may be absent: what is given for them serves many files.
Status check_kind(std::string_view name, const std::vector<std::string>& kinds, bool are_species,
                  const std::string& key);

/// The same for all that is given.
template <class Value>
Status check_kinds(const std::vector<OfKind<Value>>& given, const std::vector<std::string>& kinds,
                   bool are_species, const std::string& key) {
  for (const OfKind<Value>& one : given) {
    if (auto done = check_kind(one.kind, kinds, are_species, key); !done) return done;
  }
  return {};
}

}  // namespace boule
