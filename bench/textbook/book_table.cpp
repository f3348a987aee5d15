#include "bench/textbook/book_solvers.h"
#include "simd/dispatch/cpu.h"

namespace boule::bench {

namespace scalar {
extern const std::span<const BookSolver> book_solvers;
}  // namespace scalar
namespace sse42 {
extern const std::span<const BookSolver> book_solvers;
}  // namespace sse42
namespace avx2 {
extern const std::span<const BookSolver> book_solvers;
}  // namespace avx2
namespace avx512 {
extern const std::span<const BookSolver> book_solvers;
}  // namespace avx512
namespace neon {
extern const std::span<const BookSolver> book_solvers;
}  // namespace neon

std::span<const BookSolver> book_solvers(Isa isa) {
  if (!cpu_supports(isa)) return {};
  switch (isa) {
    case Isa::scalar:
      return scalar::book_solvers;
#ifdef BOULE_HAS_SSE42
    case Isa::sse42:
      return sse42::book_solvers;
#endif
#ifdef BOULE_HAS_AVX2
    case Isa::avx2:
      return avx2::book_solvers;
#endif
#ifdef BOULE_HAS_AVX512
    case Isa::avx512:
      return avx512::book_solvers;
#endif
#ifdef BOULE_HAS_NEON
    case Isa::neon:
      return neon::book_solvers;
#endif
    default:
      return {};
  }
}

}  // namespace boule::bench
