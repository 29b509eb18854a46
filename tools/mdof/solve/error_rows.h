// Solved rows -> text on the standard output, on a thread of its own: writing 17 digits takes as
// long as reading them, and has a core to itself.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "schema/axis.h"
#include "schema/base/bounded_queue.h"
#include "schema/base/result.h"
#include "schema/point.h"
#include "tools/mdof/solve/frame_solver.h"

namespace mdof::tools {

enum class RowForm {
  csv,   // a header: the error keys and encoder_mm; a line a row, empty errors where it is not
         // solved
  json,  // {"axis", "model", "reference", "rows": [{"EYX_um": ..., "encoder_mm": ...}, ...]}; null
         // where it is not solved
};

// Thread-bound, but for its own thread "write rows". Memory: a few blocks.
class ErrorRows {
 public:
  ErrorRows(RowForm form, const MovingAxis& moving, Model model);
  ~ErrorRows();  // ends without the rest

  // The next block to fill; nullptr: nothing can be written any more, finish() knows why.
  SolvedRows* next();
  void put();  // to be written
  // Writes what is left; error: the standard output refused.
  Status finish();

 private:
  void work();
  Status write_all();
  void write_head();
  struct Texts;
  char* append_csv(const SolvedRows& rows, char* out) const;
  char* append_json(const SolvedRows& rows, char* out);

  const RowForm form_;
  std::array<ErrorName, 5> names_;        // with the sign of the moving body
  std::array<std::string, 6> json_keys_;  // {"EYX_um": ,"encoder_mm":
  std::string head_;
  bool first_row_ = true;
  std::vector<char> text_;
  SolvedRows filling_;
  BoundedQueue<SolvedRows> filled_, free_;  // a block that is written is free again
  Status status_;                           // of the thread, once it has ended
  std::thread thread_;                      // last: starts when all else is there
};

}  // namespace mdof::tools
