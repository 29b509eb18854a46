// The processes that share a study: one process, or those that mpirun or srun started together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "schema/base/result.h"

struct MdofMpi;

namespace mdof::tools {

// Thread-bound. Without MPI there is one process, and the functions only return their arguments.
// With MPI, all processes must call the same functions in the same order. If a process ends without
// leave(), MPI ends all processes.
class Processes {
 public:
  // If the environment shows that MPI started this process, loads the module mdof_mpi.so from the
  // folder of the program. Error: the module cannot be loaded. It is an error because each process
  // would otherwise calculate the whole study.
  static Result<Processes> join();

  int rank() const;
  int size() const;
  bool first() const { return rank() == 0; }

  std::string broadcast(std::string bytes);         // Returns the bytes of rank 0 to all processes.
  std::uint64_t broadcast_number(std::uint64_t x);  // Returns the number of rank 0 to all.
  // Returns, in all processes, whether `mine` is true in at least one process.
  bool any(bool mine);
  void send(int to, std::string_view bytes);
  std::string receive(int from);

  // Returns ok in all processes if `mine` is ok in all processes. Otherwise rank 0 returns the
  // error of the process that failed, and the others return an error that only ends them.
  Status agree(const Status& mine);
  // Call it at the end, and after agree() has returned an error.
  void leave();

 private:
  // Aborts MPI if leave() was never called.
  struct AbortAll {
    void operator()(const MdofMpi* mpi) const;
  };
  std::unique_ptr<const MdofMpi, AbortAll> mpi_;  // null: a single process
};

}  // namespace mdof::tools
