#include "render/apps/python/values/presence.h"

#include <atomic>

namespace boule::python {
namespace {

std::atomic<int> present{0};
std::atomic<bool> is_closed{false};
thread_local bool ends_interpreter = false;

}  // namespace

Presence::Presence() {
  if (enter()) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw pybind11::error_already_set();
}

Presence::~Presence() { leave(); }

/// Counts before it looks: close() closes before it counts.
bool Presence::enter() {
  ++present;
  if (!is_over()) return true;
  leave();
  return false;
}

void Presence::leave() { --present; }

bool Presence::is_over() { return is_closed && !ends_interpreter; }

void Presence::close() {
  ends_interpreter = true;
  is_closed = true;
}

int Presence::count() { return present; }

void Presence::forget() { present = 0; }

}  // namespace boule::python
