// The functions of MPI that mdof uses, as a C interface. Only this module is linked to libmpi. mdof
// loads it only if mpirun or srun started mdof; otherwise mdof starts without libmpi.
#pragma once

#include <cstdint>

extern "C" {

// All functions are called from one thread. If a call of MPI fails, MPI ends all processes (its
// default error handler).
struct MdofMpi {
  int rank, size;
  void (*send)(int to, const char* bytes, std::uint64_t count);
  std::uint64_t (*incoming)(int from);  // Waits for a message and returns its length.
  void (*receive)(int from, char* bytes, std::uint64_t count);
  void (*broadcast)(char* bytes, std::uint64_t count);  // from rank 0 to all
  void (*abort)(int exit_code);                         // ends all processes
  void (*finish)();
};

// Calls MPI_Init_thread; nullptr: MPI cannot be started.
const MdofMpi* mdof_mpi_start();
}
