#include "render/files/file/checksum.h"

#include <new>

#ifdef BOULE_HAS_XXHASH
#include <xxhash.h>
#endif

namespace boule {

#ifdef BOULE_HAS_XXHASH

struct Checksum::State {
  XXH3_state_t* hash = XXH3_createState();
  State() {
    if (hash == nullptr) throw std::bad_alloc();
    XXH3_64bits_reset(hash);
  }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

bool Checksum::available() { return true; }
Checksum::Checksum() : state_(std::make_unique<State>()) {}
Checksum::~Checksum() = default;
void Checksum::add(std::string_view bytes) {
  XXH3_64bits_update(state_->hash, bytes.data(), bytes.size());
}
std::uint64_t Checksum::value() const { return XXH3_64bits_digest(state_->hash); }

#else

struct Checksum::State {};
bool Checksum::available() { return false; }
Checksum::Checksum() = default;
Checksum::~Checksum() = default;
void Checksum::add(std::string_view /*bytes*/) {}
std::uint64_t Checksum::value() const { return 0; }

#endif

}  // namespace boule
