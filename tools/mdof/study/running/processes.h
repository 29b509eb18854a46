// The processes that share a study: one process, or those that mpirun or srun started together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "schema/base/result.h"

struct MdofMpi;

namespace mdof::tools {

// Thread-bound. With one process, every call is trivial. Under MPI, all processes make the same
// calls in the same order; if one process ends without leave(), MPI ends all of them.
class Processes {
 public:
  // If the environment shows that MPI started this process, loads the module mdof_mpi.so from the
  // folder of the program. Error: the module cannot be loaded; each process would calculate the
  // whole study.
  static Result<Processes> join();

  int rank() const;
  int size() const;
  bool first() const { return rank() == 0; }

  std::string broadcast(std::string bytes);         // Returns the bytes of rank 0 to all processes.
  std::uint64_t broadcast_number(std::uint64_t x);  // Returns the number of rank 0 to all.
  bool any(bool mine);  // Returns to all processes whether `mine` is true in any of them.
  void send(int to, std::string_view bytes);
  std::string receive(int from);

  // Ok if `mine` is ok in all processes. Otherwise rank 0 gets the error of the process that
  // failed; the others get an error that only ends them.
  Status agree(const Status& mine);
  // Called at the end, and after an error on which all processes have agreed.
  void leave();

 private:
  // Aborts MPI if leave() was never called.
  struct AbortAll {
    void operator()(const MdofMpi* mpi) const;
  };
  std::unique_ptr<const MdofMpi, AbortAll> mpi_;  // null: a single process
};

}  // namespace mdof::tools
