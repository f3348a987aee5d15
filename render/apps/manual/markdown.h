#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boule::manual {

enum class BlockKind { heading, paragraph, code, bullet, number, table };

/// A piece of a document. Texts keep their marks for code, emphasis and links.
struct Block {
  BlockKind kind = BlockKind::paragraph;
  int level = 0;     ///< heading: 1 to 6
  std::string text;  ///< code: its language; table: none
  /// code: its lines. A line of a table is a row of cells, its heading first.
  std::vector<std::string> lines;
  std::vector<std::vector<std::string>> rows;
};

/// The blocks of a document in the Markdown of docs/: headings by #, paragraphs, fenced code, lists
/// without lists in them, tables.
std::vector<Block> parse_markdown(std::string_view text);

/// The blocks of the section under a heading of this level, up to the next heading of that level or
/// above it.
std::vector<Block> section_of(const std::vector<Block>& blocks, int level,
                              std::string_view heading);

}  // namespace boule::manual
