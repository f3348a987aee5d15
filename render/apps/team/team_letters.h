#pragma once

#include <cstdint>
#include <string>

#include "core/scene/field.h"
#include "render/files/file/byte_fields.h"

namespace boule {

/// What the ranks of a team tell each other. The first byte of a letter is its kind.
enum class LetterKind : std::uint8_t {
  hello,   ///< to and from the leader: who I am
  facts,   ///< to the leader: what I would render (RunFacts); I am ready
  beat,    ///< to and from the leader: I am alive; for so many seconds this may be the last sign
  work,    ///< from the leader: blocks to render
  result,  ///< to the leader: blocks that are rendered
  frame,   ///< to the leader: a frame, please; from the leader: its number, or -1
  ended,   ///< to the leader: my part is over, with an exit code and what is to be told
  caught,  ///< to the leader: a signal wants me to end
  stop,    ///< from the leader: render no more
  leave,   ///< from the leader: leave, with an exit code
};

inline ByteWriter letter_of(LetterKind kind) {
  return ByteWriter().put(static_cast<std::uint8_t>(kind));
}
inline LetterKind kind_of(ByteReader& letter) {
  return static_cast<LetterKind>(letter.get<std::uint8_t>());
}

/// What a rank says of itself.
struct RankName {
  std::string host;
  int process = 0;
  std::string processes;  ///< which system's processes `process` is one of
  int threads = 1;
};

template <>
inline constexpr auto fields<RankName> = field_list("rank", field("host", &RankName::host),
                                                    field("process", &RankName::process),
                                                    field("processes", &RankName::processes),
                                                    field("threads", &RankName::threads));

}  // namespace boule
