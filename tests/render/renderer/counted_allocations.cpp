#include "tests/render/renderer/counted_allocations.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> count{0};
std::atomic<long> last{-1};    ///< allocations after this one fail; -1: none
std::atomic<long> failing{0};  ///< this one fails; 0: none

void* counted(std::size_t size, std::size_t alignment) {
  const long number = ++count;
  if ((last >= 0 && number > last) || number == failing) throw std::bad_alloc();
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  if (void* memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded))
    return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace boule::test {

long allocations() { return count; }

ShortMemory::ShortMemory(long allowed) { last = count + allowed; }
ShortMemory::~ShortMemory() { last = -1; }

OneFailure::OneFailure(long number) : number_(count + number) { failing = number_; }
OneFailure::~OneFailure() { failing = 0; }

bool OneFailure::has_come() const { return count >= number_; }

}  // namespace boule::test
