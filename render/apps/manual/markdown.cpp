#include "render/apps/manual/markdown.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace boule::manual {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// The cells of "| a | b |"; a bar behind a backslash is part of its cell.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  std::string cell;
  line.remove_prefix(1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|') {
      cell += line[++i];
    } else if (line[i] == '|') {
      cells.emplace_back(trimmed(cell));
      cell.clear();
    } else {
      cell += line[i];
    }
  }
  return cells;
}

bool is_rule(std::string_view line) {
  return line.find_first_not_of("|-: ") == std::string_view::npos;
}

/// The length of the mark at the start of a list's item, "- " or "12. "; 0 if there is none.
std::size_t item_mark(std::string_view line) {
  if (line.starts_with("- ")) return 2;
  std::size_t digits = 0;
  while (digits < line.size() && std::isdigit(static_cast<unsigned char>(line[digits])) != 0)
    ++digits;
  return digits > 0 && line.substr(digits).starts_with(". ") ? digits + 2 : 0;
}

/// Takes the lines of a document one after the other.
class Parser {
 public:
  void take(std::string_view line) {
    if (fenced_) {
      if (line.starts_with("```")) {
        fenced_ = false;
      } else {
        blocks_.back().lines.emplace_back(line);
      }
    } else if (line.starts_with("```")) {
      begin(BlockKind::code, line.substr(3));
      fenced_ = true;
    } else {
      take_text(line);
    }
  }

  std::vector<Block> blocks() {
    end();
    return std::move(blocks_);
  }

 private:
  void take_text(std::string_view line) {
    const std::string_view text = trimmed(line);
    const std::size_t level = line.find_first_not_of('#'), mark = item_mark(line);
    if (text.empty()) {
      end();
    } else if (level != std::string_view::npos && level > 0 && line[level] == ' ') {
      begin(BlockKind::heading, line.substr(level + 1));
      blocks_.back().level = static_cast<int>(level);
      end();
    } else if (text.size() > 1 && text.front() == '|' && text.back() == '|') {
      if (!open_ || blocks_.back().kind != BlockKind::table) begin(BlockKind::table, "");
      if (!is_rule(text)) blocks_.back().rows.push_back(cells_of(text));
    } else if (mark > 0) {
      begin(mark == 2 ? BlockKind::bullet : BlockKind::number, line.substr(mark));
    } else if (open_ && blocks_.back().kind != BlockKind::table) {
      blocks_.back().text += "\n" + std::string(text);
    } else {
      begin(BlockKind::paragraph, text);
    }
  }

  void begin(BlockKind kind, std::string_view text) {
    end();
    blocks_.push_back({kind, 0, std::string(text), {}, {}});
    open_ = true;
  }

  void end() { open_ = false; }

  std::vector<Block> blocks_;
  bool open_ = false;    ///< the last block takes more lines
  bool fenced_ = false;  ///< the last block is code that has not ended
};

}  // namespace

std::vector<Block> parse_markdown(std::string_view text) {
  Parser parser;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    parser.take(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parser.blocks();
}

std::vector<Block> section_of(const std::vector<Block>& blocks, int level,
                              std::string_view heading) {
  std::vector<Block> section;
  bool inside = false;
  for (const Block& block : blocks) {
    if (block.kind == BlockKind::heading && block.level <= level) {
      inside = block.level == level && block.text == heading;
    } else if (inside) {
      section.push_back(block);
    }
  }
  return section;
}

}  // namespace boule::manual
