#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/apps/manual/markdown.h"

namespace boule::manual {

/// Text without marks, such as a name, so that roff prints it as it stands: its hyphens are those
/// that one types.
std::string roff_literal(std::string_view text);

/// A text of Markdown as roff: code and strong words bold, emphasis italic, links their words,
/// pictures their names. One line.
std::string roff_text(std::string_view markdown);

/// Lines of at most 78 characters, each ended, that roff fills anew: none is taken for a request.
std::string roff_lines(std::string_view roff);

/// ".TP", the term, and what it means; both as roff.
std::string roff_entry(std::string_view term, std::string_view meaning);

/// Lines that keep their breaks and blanks, such as commands; begins no paragraph.
std::string roff_example(const std::vector<std::string>& lines);

/// Blocks of a document. A heading of level `top` becomes a section (.SH), all below it .SS. The
/// rows of a table become entries: of the first cell, a default in brackets, and the rest.
std::string roff_blocks(const std::vector<Block>& blocks, int top);

}  // namespace boule::manual
