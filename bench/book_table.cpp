#include "bench/book_solvers.h"
#include "simd/dispatch/cpu.h"

namespace boule::bench {

#define BOULE_BOOK(isa)                       \
  namespace isa {                             \
  extern const BookSolver book_solvers[];     \
  extern const std::size_t book_solver_count; \
  }
BOULE_BOOK(scalar)
BOULE_BOOK(sse42)
BOULE_BOOK(avx2)
BOULE_BOOK(avx512)
BOULE_BOOK(neon)
#undef BOULE_BOOK

std::span<const BookSolver> book_solvers(Isa isa) {
  if (!cpu_supports(isa)) return {};
  switch (isa) {
    case Isa::scalar:
      return {scalar::book_solvers, scalar::book_solver_count};
#ifdef BOULE_HAS_SSE42
    case Isa::sse42:
      return {sse42::book_solvers, sse42::book_solver_count};
#endif
#ifdef BOULE_HAS_AVX2
    case Isa::avx2:
      return {avx2::book_solvers, avx2::book_solver_count};
#endif
#ifdef BOULE_HAS_AVX512
    case Isa::avx512:
      return {avx512::book_solvers, avx512::book_solver_count};
#endif
#ifdef BOULE_HAS_NEON
    case Isa::neon:
      return {neon::book_solvers, neon::book_solver_count};
#endif
    default:
      return {};
  }
}

}  // namespace boule::bench
