// What mdof asks of MPI, as a C interface: the only code that links libmpi is a module of its own,
// loaded when mdof finds itself under mpirun or srun, so that no other start of mdof pays for it.
#pragma once

#include <cstdint>

extern "C" {

// Errors of MPI itself end all processes, as its default handler does. One thread calls these.
struct MdofMpi {
  int rank, size;
  void (*send)(int to, const char* bytes, std::uint64_t count);
  std::uint64_t (*incoming)(int from);  // waits for a message; its length
  void (*receive)(int from, char* bytes, std::uint64_t count);
  void (*broadcast)(char* bytes, std::uint64_t count);  // from rank 0 to all
  void (*abort)(int exit_code);                         // ends all processes
  void (*finish)();
};

// MPI_Init and what comes with it; nullptr where MPI cannot be started.
const MdofMpi* mdof_mpi_start();
}
