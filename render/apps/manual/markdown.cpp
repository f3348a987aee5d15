#include "render/apps/manual/markdown.h"

#include <regex>
#include <sstream>

namespace boule::manual {
namespace {

/// The cells of "| a | b |"; a bar behind a backslash is part of its cell.
std::vector<std::string> cells_of(const std::string& row) {
  static const std::regex cell(R"(\|\s*((?:\\.|[^|\\])*?)\s*(?=\|))"), bar(R"(\\\|)");
  std::vector<std::string> cells;
  for (std::sregex_iterator it(row.begin(), row.end(), cell), end; it != end; ++it)
    cells.push_back(std::regex_replace(it->str(1), bar, "|"));
  return cells;
}

/// All cells but the first, each with its column's name where that tells more.
std::string meaning_of(const std::vector<std::string>& heads, const std::vector<std::string>& row) {
  std::string meaning;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i].empty()) continue;
    if (heads.at(i) == "default") {
      meaning += "(" + row[i] + ") ";
    } else {
      const bool is_named = row.size() > 2 && heads.at(i) != "meaning";
      meaning += (is_named ? heads.at(i) + ": " : "") + row[i] + "; ";
    }
  }
  return meaning.substr(0, meaning.find_last_not_of("; ") + 1);
}

std::string terms_of(const std::string& table) {
  std::istringstream lines(table);
  std::string line, terms;
  std::getline(lines, line);
  const std::vector<std::string> heads = cells_of(line);
  std::getline(lines, line);  // the rule below the heads
  while (std::getline(lines, line)) {
    const std::vector<std::string> row = cells_of(line);
    if (!row.at(0).empty()) terms += "\n" + row[0] + "\n";
    terms += ": " + meaning_of(heads, row) + "\n";
  }
  return terms;
}

}  // namespace

std::string literal(std::string_view text) {
  std::string markdown;
  for (const char letter : text) {
    if (std::string_view("\\`*_[]<>&~").find(letter) != std::string_view::npos) markdown += '\\';
    markdown += letter;
  }
  return markdown;
}

std::vector<std::string> pieces_of(const std::string& document) {
  std::istringstream lines(document);
  std::vector<std::string> pieces;
  bool open = false, fenced = false;  // the last piece takes more lines; these are code
  for (std::string line; std::getline(lines, line);) {
    if (!open && !line.empty()) pieces.emplace_back();
    open = fenced || !line.empty();
    if (line.starts_with("```")) fenced = !fenced;
    if (open) pieces.back() += line + "\n";
  }
  return pieces;
}

std::string page_piece(const std::string& piece) {
  static const std::regex picture(R"(!\[[^\]]*\]\((?:[^)]*/)?([^)/]*)\))"),
      heading("#(#+ )(.*\\n)");
  std::smatch match;
  if (piece.starts_with("```")) return piece + "\n";
  if (std::regex_match(piece, match, heading)) {
    std::string words = match.str(2);
    std::erase(words, '`');
    return match.str(1) + literal(words) + "\n";
  }
  const std::string text = std::regex_replace(piece, picture, R"(\[picture $1\])");
  return (text.starts_with('|') ? terms_of(text) : text) + "\n";
}

}  // namespace boule::manual
