#pragma once

#include <string>
#include <string_view>

#include "render/apps/parts/film_file.h"

namespace boule {

/// The part of a film file's head that is text: a line for each fact and each entry of the
/// picture's header, its fields separated by tabs. Numbers are written as their bits.
std::string film_text(const FilmHead& head);

/// Adds what the text says to `head`. False if it is no such text. Takes any text.
bool read_film_text(std::string_view text, FilmHead& head);

}  // namespace boule
