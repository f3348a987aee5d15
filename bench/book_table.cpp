#include "bench/book_solvers.h"
#include "simd/dispatch/cpu.h"

namespace boule::bench {

namespace scalar {
extern const BookSolver book_solvers[];
extern const std::size_t book_solver_count;
}  // namespace scalar
namespace sse42 {
extern const BookSolver book_solvers[];
extern const std::size_t book_solver_count;
}  // namespace sse42
namespace avx2 {
extern const BookSolver book_solvers[];
extern const std::size_t book_solver_count;
}  // namespace avx2
namespace avx512 {
extern const BookSolver book_solvers[];
extern const std::size_t book_solver_count;
}  // namespace avx512
namespace neon {
extern const BookSolver book_solvers[];
extern const std::size_t book_solver_count;
}  // namespace neon

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
