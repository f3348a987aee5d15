#pragma once

#include <string>
#include <string_view>

#include "core/base/error.h"
#include "render/files/scene_file/loaded/text_place.h"

namespace boule {

/// What the parser does not do itself: bounds on its input, and the keys and places of its errors.

/// Refuses text that toml++ 3.3 cannot be trusted with:
/// - dotted keys of more than 32 parts: it recurses once per part, and a hostile file must not
///   overflow the stack;
/// - arrays of more than 1024 values that are not tables: each value takes 120 bytes, and no scene
///   key needs more than a few;
/// - characters beyond ASCII outside of strings and comments, which are not legal TOML, and
///   multi-line strings, which are, but no scene key needs one: its test for blanks has undefined
///   behaviour there.
Status refuse_untrusted(std::string_view text, const std::string& file);

/// The key on a line (from 1) with the header above it, for errors: "camera.fov",
/// "sphere[2].radius"; "" where the line has none.
std::string key_on_line(std::string_view text, int line);

/// The place of a parser's error. The parser reports some errors behind the literal that it quotes
/// in `description`: then it is the literal's beginning, else `reported`.
TextPlace literal_place(std::string_view text, TextPlace reported, std::string_view description);

/// `text` without `prefix`, where it begins so.
std::string without_prefix(std::string_view text, std::string_view prefix);

}  // namespace boule
