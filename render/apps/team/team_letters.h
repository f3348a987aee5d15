#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace boule {

/// What the ranks of a team tell each other. The first byte of a letter is its kind.
enum class LetterKind : std::uint8_t {
  hello,   ///< to the leader: who I am
  facts,   ///< to the leader: what I would render (RunFacts as text); I am ready
  beat,    ///< to and from the leader: I am alive; for so many seconds this may be the last sign
  work,    ///< from the leader: blocks to render
  result,  ///< to the leader: blocks that are rendered
  frame,   ///< to the leader: a frame, please; from the leader: its number, or -1
  ended,   ///< to the leader: my part is over, with an exit code and what is to be told
  caught,  ///< to the leader: a signal wants me to end
  stop,    ///< from the leader: render no more
  leave,   ///< from the leader: leave, with an exit code
};

/// Puts a letter together.
class LetterWriter {
 public:
  explicit LetterWriter(LetterKind kind) { add(kind); }

  template <class T>
  LetterWriter& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  LetterWriter& add_text(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    text_ += text;
    return *this;
  }
  LetterWriter& add_list(const std::vector<std::uint32_t>& list) {
    return add_text({reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0])});
  }

  [[nodiscard]] std::string take() { return std::move(text_); }
  [[nodiscard]] std::size_t size() const { return text_.size(); }

 private:
  std::string text_;
};

/// Takes a letter apart. A letter that is too short gives zeros, and is not good().
class LetterReader {
 public:
  explicit LetterReader(std::string_view letter) : rest_(letter) {}

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    if (rest_.size() < sizeof value) {
      good_ = false;
      return value;
    }
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return value;
  }
  std::string_view get_text();
  std::vector<std::uint32_t> get_list();

  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  bool good_ = true;
};

/// What a rank says of itself.
struct RankName {
  std::string host;
  int process = 0;
  std::string processes;  ///< which system's processes `process` is one of
  int threads = 1;
};
std::string hello_letter(const RankName& name);
RankName read_hello(LetterReader& letter);

}  // namespace boule
