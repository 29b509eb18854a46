// The part of MPI that mdof uses, as a C interface. Only this separate module links libmpi. mdof
// loads it only under mpirun or srun, so that other starts of mdof have no cost.
#pragma once

#include <cstdint>

extern "C" {

// All functions are called from one thread. An error of MPI ends all processes (its default
// handler).
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
