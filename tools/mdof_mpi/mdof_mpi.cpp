#include "tools/mdof_mpi/mdof_mpi.h"

#include <mpi.h>

#include <algorithm>
#include <limits>

namespace {

// Largest piece of a message. MPI counts bytes with int; therefore a message is sent as its length,
// then in pieces.
constexpr std::uint64_t kPiece = std::uint64_t{1} << 30;
static_assert(kPiece <= std::numeric_limits<int>::max());
constexpr int kLength = 1, kBytes = 2;

template <class Pass>
void in_pieces(std::uint64_t count, Pass pass) {
  for (std::uint64_t at = 0; at < count; at += kPiece)
    pass(at, static_cast<int>(std::min(kPiece, count - at)));
}

void send(int to, const char* bytes, std::uint64_t count) {
  MPI_Send(&count, 1, MPI_UINT64_T, to, kLength, MPI_COMM_WORLD);
  in_pieces(count, [&](std::uint64_t at, int n) {
    MPI_Send(bytes + at, n, MPI_BYTE, to, kBytes, MPI_COMM_WORLD);
  });
}

std::uint64_t incoming(int from) {
  std::uint64_t count = 0;
  MPI_Recv(&count, 1, MPI_UINT64_T, from, kLength, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return count;
}

void receive(int from, char* bytes, std::uint64_t count) {
  in_pieces(count, [&](std::uint64_t at, int n) {
    MPI_Recv(bytes + at, n, MPI_BYTE, from, kBytes, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
}

void broadcast(char* bytes, std::uint64_t count) {
  in_pieces(count, [&](std::uint64_t at, int n) {
    MPI_Bcast(bytes + at, n, MPI_BYTE, 0, MPI_COMM_WORLD);
  });
}

void abort_all(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
}

void finish() {
  MPI_Finalize();
}

MdofMpi interface = {0, 1, send, incoming, receive, broadcast, abort_all, finish};

}  // namespace

extern "C" const MdofMpi* mdof_mpi_start() {
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    return nullptr;
  MPI_Comm_rank(MPI_COMM_WORLD, &interface.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &interface.size);
  return &interface;
}
