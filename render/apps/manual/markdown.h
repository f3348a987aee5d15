#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boule::manual {

/// Markdown that shows a text as it stands.
std::string literal(std::string_view text);

/// What empty lines part in a document: headings, paragraphs, lists, tables. Fenced code is one.
std::vector<std::string> pieces_of(const std::string& document);

/// A piece of a document as a manual page has it. Headings of level 2 become sections. The rows of
/// a table become terms: of the first cell, a default in brackets, and the rest; a row without a
/// first cell says more of the term above. Pictures become their names.
std::string page_piece(const std::string& piece);

}  // namespace boule::manual
