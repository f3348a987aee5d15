#include "render/apps/team/team_letters.h"

namespace boule {

std::string_view LetterReader::get_text() {
  const auto count = get<std::uint64_t>();
  if (count > rest_.size()) {
    good_ = false;
    return {};
  }
  const std::string_view text = rest_.substr(0, static_cast<std::size_t>(count));
  rest_.remove_prefix(text.size());
  return text;
}

std::vector<std::uint32_t> LetterReader::get_list() {
  const std::string_view text = get_text();
  std::vector<std::uint32_t> list(text.size() / sizeof(std::uint32_t));
  if (!list.empty()) std::memcpy(list.data(), text.data(), list.size() * sizeof(list[0]));
  return list;
}

std::string hello_letter(const RankName& name) {
  LetterWriter letter(LetterKind::hello);
  letter.add_text(name.host).add(name.process).add_text(name.processes).add(name.threads);
  return letter.take();
}

RankName read_hello(LetterReader& letter) {
  RankName name;
  name.host = letter.get_text();
  name.process = letter.get<int>();
  name.processes = letter.get_text();
  name.threads = letter.get<int>();
  return name;
}

}  // namespace boule
