#pragma once

#include <string>
#include <string_view>

#include "core/base/error.h"
#include "render/scene_file/text_place.h"

namespace boule {

/// What the parser leaves to its caller: better places and keys for its errors, and bounds.

/// Refuses what toml++ 3.3 must not see: dotted keys of more than 32 parts (it recurses once per
/// part, and a hostile file must not overflow the stack), arrays of more than 1024 values that are
/// no tables (each takes 120 bytes; no key of ours needs more than a few), and characters beyond
/// ASCII outside of strings and comments or in multi-line strings (undefined behaviour in its test
/// for blanks). Only multi-line strings are legal TOML; no key of ours needs one.
Status refuse_untrusted(std::string_view text, const std::string& file);

/// The key that `line` (from 1) shows, with the header it stands under: "camera.fov",
/// "sphere[2].radius"; "" where the line shows none. A label for errors, read line by line.
std::string key_on_line(std::string_view text, int line);

/// The parser places some errors behind the literal that it quotes in `description`: the
/// literal's beginning if it stands there, else `reported`.
TextPlace literal_place(std::string_view text, TextPlace reported, std::string_view description);

/// `text` without `prefix`, where it begins so.
std::string without_prefix(std::string_view text, std::string_view prefix);

}  // namespace boule
