#pragma once

/// The operators new and delete of a test program, which count and can fail.
namespace boule::test {

/// How many allocations there were so far, of all threads.
long allocations();

/// While it lives, only so many more allocations succeed.
class ShortMemory {
 public:
  explicit ShortMemory(long allowed);
  ~ShortMemory();
  ShortMemory(const ShortMemory&) = delete;
  ShortMemory& operator=(const ShortMemory&) = delete;
};

/// While it lives, allocation `number` fails, counted from 1 on, and no other.
class OneFailure {
 public:
  explicit OneFailure(long number);
  ~OneFailure();
  OneFailure(const OneFailure&) = delete;
  OneFailure& operator=(const OneFailure&) = delete;

  /// Whether there were so many.
  [[nodiscard]] bool has_come() const;

 private:
  long number_;
};

}  // namespace boule::test
