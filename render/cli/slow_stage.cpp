#include "render/cli/slow_stage.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

namespace boule::cli {
namespace {

char told_line[202] = "";
std::atomic<std::size_t> told_size{0};
std::atomic<int> ticks{0};

constexpr long tick_us = 800000;

void handle_tick(int) {
  constexpr int patience = 5;   // ticks without work of ours
  constexpr double work = 0.6;  // seconds: pictures' libraries start in less
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  const double seconds =
      static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9;
  const int tick = ++ticks;
  if (tick < patience && seconds < work) return;
  itimerval timer{};
  timer.it_interval.tv_sec = timer.it_value.tv_sec = 10;
  setitimer(ITIMER_REAL, &timer, nullptr);
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, told_line, told_size);
}

}  // namespace

SlowStage::SlowStage(const std::string& line) {
  const std::size_t size = line.copy(told_line, sizeof told_line - 2);
  told_line[size] = '\n';
  told_size = size + 1;
  ticks = 0;
  struct sigaction action {};
  action.sa_handler = handle_tick;
  action.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &action, nullptr);
  itimerval timer{};
  timer.it_interval.tv_usec = timer.it_value.tv_usec = tick_us;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

SlowStage::~SlowStage() {
  const itimerval none{};
  setitimer(ITIMER_REAL, &none, nullptr);
  std::signal(SIGALRM, SIG_IGN);  // the last one may be on its way
}

}  // namespace boule::cli
