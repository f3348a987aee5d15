#include "render/apps/manual/roff.h"

#include <algorithm>
#include <cctype>

namespace boule::manual {
namespace {

constexpr std::size_t width = 78;

/// One character as roff prints it, in a literal or in running text.
std::string roff_letter(char letter, bool literal) {
  switch (letter) {
    case '\\':
      return "\\e";
    case '^':
      return "\\(ha";
    case '~':
      return "\\(ti";
    case '`':
      return "\\(ga";
    case '"':
      return "\\(dq";
    case '\'':
      return literal ? "\\(aq" : "'";
    case '-':
      return literal ? "\\-" : "-";
    default:
      return {letter};
  }
}

std::string roff_letters(std::string_view text, bool literal) {
  std::string roff;
  for (const char letter : text) roff += roff_letter(letter == '\n' ? ' ' : letter, literal);
  return roff;
}

/// The part of a text between two marks, and where the text goes on; none if there is no end.
struct Span {
  std::string_view inside;
  std::size_t next = 0;
};

Span span_of(std::string_view text, std::size_t at, std::string_view begin, std::string_view end) {
  if (!text.substr(at).starts_with(begin)) return {};
  const std::size_t from = at + begin.size(), to = text.find(end, from);
  if (to == std::string_view::npos || to == from) return {};
  return {text.substr(from, to - from), to + end.size()};
}

/// The words of a link, "[words](" at text[at]; code among them may have brackets.
Span link_words(std::string_view text, std::size_t at) {
  if (at >= text.size() || text[at] != '[') return {};
  bool in_code = false;
  for (std::size_t i = at + 1; i < text.size(); ++i) {
    if (text[i] == '`') in_code = !in_code;
    if (in_code) continue;
    if (text[i] == '[') return {};
    if (text[i] == ']')
      return text.substr(i).starts_with("](") ? Span{text.substr(at + 1, i - at - 1), i + 2}
                                              : Span{};
  }
  return {};
}

std::string file_of(std::string_view path) {
  return std::string(path.substr(path.rfind('/') + 1));  // npos + 1 is 0
}

/// What stands at `text[at]`, as roff; moves `at` behind it.
std::string take_inline(std::string_view text, std::size_t& at) {
  const auto go = [&at](std::size_t next) { at = next; };
  if (const Span code = span_of(text, at, "`", "`"); code.next > 0) {
    go(code.next);
    return "\\fB" + roff_letters(code.inside, true) + "\\fP";
  }
  if (const Span strong = span_of(text, at, "**", "**"); strong.next > 0) {
    go(strong.next);
    return "\\fB" + roff_text(strong.inside) + "\\fP";
  }
  if (const Span soft = span_of(text, at, "*", "*"); soft.next > 0) {
    go(soft.next);
    return "\\fI" + roff_text(soft.inside) + "\\fP";
  }
  const bool is_picture = text.substr(at).starts_with("![");
  if (const Span words = link_words(text, at + (is_picture ? 1 : 0)); words.next > 0) {
    const std::size_t end = std::min(text.find(')', words.next), text.size() - 1);
    go(end + 1);
    if (!is_picture) return roff_text(words.inside);
    const std::string_view path = text.substr(words.next, end - words.next);
    return "[picture " + roff_letters(file_of(path), true) + "]";
  }
  return roff_letter(text[at++] == '\n' ? ' ' : text[at - 1], false);
}

std::string upper(std::string_view text) {
  std::string letters(text);
  for (char& letter : letters)
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return letters;
}

/// A heading's words without the marks of code and links.
std::string plain(std::string_view text) {
  std::string words(text);
  std::erase(words, '`');
  return words;
}

std::string roff_heading(const Block& block, int top) {
  const bool section = block.level <= top;
  const std::string words = plain(block.text);
  return (section ? ".SH " : ".SS ") + roff_letters(section ? upper(words) : words, true) + "\n";
}

/// A row's meaning: all cells but the first, each with its column's name where that tells more.
std::string meaning_of(const std::vector<std::string>& heads, const std::vector<std::string>& row) {
  std::string meaning;
  bool after_default = false;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i].empty()) continue;
    const bool is_default = i < heads.size() && heads[i] == "default";
    const bool is_named = row.size() > 2 && i < heads.size() && heads[i] != "meaning";
    if (!meaning.empty()) meaning += after_default ? " " : "; ";
    after_default = is_default;
    if (is_default) {
      meaning += "(" + row[i] + ")";
    } else {
      meaning += (is_named ? heads[i] + ": " : "") + row[i];
    }
  }
  return meaning;
}

std::string roff_table(const Block& table) {
  std::string roff;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const auto& row = table.rows[i];
    std::string term = roff_text(row.front());
    if (term.empty()) term = "\\&";
    const std::string meaning = roff_text(meaning_of(table.rows.front(), row));
    roff += roff_entry(term, meaning.empty() ? "\\&" : meaning);
  }
  return roff;
}

std::string roff_item(const Block& block, int number) {
  const std::string mark =
      block.kind == BlockKind::bullet ? "\\(bu 2" : std::to_string(number) + ". 4";
  return ".IP " + mark + "\n" + roff_lines(roff_text(block.text));
}

}  // namespace

std::string roff_literal(std::string_view text) { return roff_letters(text, true); }

std::string roff_text(std::string_view markdown) {
  std::string roff;
  for (std::size_t at = 0; at < markdown.size();) roff += take_inline(markdown, at);
  return roff;
}

std::string roff_lines(std::string_view roff) {
  std::string lines, line;
  const auto end_line = [&] {
    const bool is_request = line.starts_with('.') || line.starts_with('\'');
    lines += (is_request ? "\\&" : "") + line + "\n";
    line.clear();
  };
  while (!roff.empty()) {
    const std::size_t end = std::min(roff.find(' '), roff.size());
    const std::string_view word = roff.substr(0, end);
    roff.remove_prefix(std::min(end + 1, roff.size()));
    if (word.empty()) continue;
    if (!line.empty() && line.size() + 1 + word.size() > width) end_line();
    line += (line.empty() ? "" : " ") + std::string(word);
  }
  if (!line.empty()) end_line();
  return lines;
}

std::string roff_entry(std::string_view term, std::string_view meaning) {
  return ".TP\n" + std::string(term) + "\n" + roff_lines(meaning);
}

std::string roff_example(const std::vector<std::string>& lines) {
  std::string roff = ".RS 4\n.nf\n";
  for (const std::string& line : lines) {
    const std::string literal = roff_letters(line, true);
    const bool is_request = literal.starts_with('.') || literal.starts_with('\'');
    roff += (is_request || literal.empty() ? "\\&" : "") + literal + "\n";
  }
  return roff + ".fi\n.RE\n";
}

std::string roff_blocks(const std::vector<Block>& blocks, int top) {
  std::string roff;
  int number = 0;
  bool is_first = true;  // below its heading
  for (const Block& block : blocks) {
    number = block.kind == BlockKind::number ? number + 1 : 0;
    const bool is_text = block.kind == BlockKind::paragraph || block.kind == BlockKind::code;
    if (is_text && !is_first) roff += ".PP\n";
    is_first = block.kind == BlockKind::heading;
    switch (block.kind) {
      case BlockKind::heading:
        roff += roff_heading(block, top);
        break;
      case BlockKind::code:
        roff += roff_example(block.lines);
        break;
      case BlockKind::table:
        roff += roff_table(block);
        break;
      case BlockKind::bullet:
      case BlockKind::number:
        roff += roff_item(block, number);
        break;
      case BlockKind::paragraph:
        roff += roff_lines(roff_text(block.text));
        break;
    }
  }
  return roff;
}

}  // namespace boule::manual
