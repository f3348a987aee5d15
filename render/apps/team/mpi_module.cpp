#include "render/apps/team/mpi_module.h"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <list>
#include <vector>

namespace boule::mpi_module {
namespace {

/// A letter that is on its way: MPI reads its bytes until then.
struct Sent {
  std::vector<char> bytes;
  MPI_Request request;
};

/// All state of the module: MPI itself has one per process.
struct State {
  std::list<Sent> sent;
  std::vector<char> received;
};
State& state() {
  static State one;
  return one;
}

constexpr int tag = 1;

void drop_arrived() {
  std::list<Sent>& sent = state().sent;
  for (auto at = sent.begin(); at != sent.end();) {
    int arrived = 0;
    MPI_Test(&at->request, &arrived, MPI_STATUS_IGNORE);
    at = arrived != 0 ? sent.erase(at) : std::next(at);
  }
}

bool start(int* rank, int* size) {
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    return false;
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, size);
  return provided >= MPI_THREAD_FUNNELED;
}

void send(int to, const char* bytes, std::size_t count) {
  Sent& letter = state().sent.emplace_back(Sent{{bytes, bytes + count}, MPI_REQUEST_NULL});
  MPI_Isend(letter.bytes.data(), static_cast<int>(count), MPI_BYTE, to, tag, MPI_COMM_WORLD,
            &letter.request);
}

bool receive(Letter* letter) {
  drop_arrived();
  int is_there = 0, count = 0;
  MPI_Status status;
  const int code = MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &is_there, &status);
  if (code != MPI_SUCCESS || is_there == 0) return false;
  MPI_Get_count(&status, MPI_BYTE, &count);
  std::vector<char>& bytes = state().received;
  bytes.resize(static_cast<std::size_t>(std::max(count, 0)));
  if (MPI_Recv(bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, tag, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE) != MPI_SUCCESS)
    return false;
  *letter = {status.MPI_SOURCE, bytes.data(), bytes.size()};
  return true;
}

bool idle() {
  drop_arrived();
  return state().sent.empty();
}

void finish() { MPI_Finalize(); }

/// A launcher that ends all ranks may not pass on any more what one of them has just written.
void end_all(int code) {
  constexpr timespec a_moment{0, 300'000'000};
  ::nanosleep(&a_moment, nullptr);
  MPI_Abort(MPI_COMM_WORLD, code);
}

constexpr Table table = {version, start, send, receive, idle, finish, end_all};

/// What the loader looks for in the file before it runs any of the module.
[[gnu::used]] constexpr auto mark = std::to_array(version_mark);

}  // namespace
}  // namespace boule::mpi_module

extern "C" [[gnu::visibility("default")]] const boule::mpi_module::Table* boule_mpi_module() {
  return &boule::mpi_module::table;
}
