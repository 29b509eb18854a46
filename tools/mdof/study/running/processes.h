// The processes that share a study: one, or those that mpirun or srun started together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "schema/base/result.h"

struct MdofMpi;

namespace mdof::tools {

// Thread-bound. Alone, every call is trivial. Under MPI all processes make the same calls in the
// same order; if one ends without having left, all are ended.
class Processes {
 public:
  // Loads the module mdof_mpi.so from beside the program where the environment says that MPI
  // started this process. Error: it is not there; each process would do the whole work.
  static Result<Processes> join();

  int rank() const;
  int size() const;
  bool first() const { return rank() == 0; }

  std::string broadcast(std::string bytes);         // that of rank 0, on all
  std::uint64_t broadcast_number(std::uint64_t x);  // likewise
  bool any(bool mine);                              // whether it is true on any; on all
  void send(int to, std::string_view bytes);
  std::string receive(int from);

  // Whether all can go on. Where one cannot, its error is that of rank 0; what the others get only
  // asks them to end.
  Status agree(const Status& mine);
  // At the end, and after an error that all have agreed on.
  void leave();

 private:
  // What becomes of MPI where leave() was never called.
  struct AbortAll {
    void operator()(const MdofMpi* mpi) const;
  };
  std::unique_ptr<const MdofMpi, AbortAll> mpi_;  // null: alone
};

}  // namespace mdof::tools
