#pragma once

#include <string>
#include <vector>

namespace boule::bench {

/// A table of text; what looks like a number is set to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : head_(std::move(head)) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] std::string html() const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> rows_;
};

/// From <!doctype html> on, the style included; and the script that shows what is pointed at.
std::string page_head(const std::string& title);
std::string page_end();

std::string section(const std::string& title, const std::string& html);

}  // namespace boule::bench
