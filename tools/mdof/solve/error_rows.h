// Writes solved rows as text to the standard output. A separate thread writes, because writing
// numbers with 17 digits needs as much time as reading them.
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
  csv,   // A header with the error keys and encoder_mm, then one line for each row. In an unsolved
         // row the errors are empty.
  json,  // {"axis", "model", "reference", "rows": [{"EYX_um": ..., "encoder_mm": ...}, ...]}; in an
         // unsolved row the errors are null.
};

// Thread-bound; its thread "write rows" is internal. Uses memory for a few blocks.
class ErrorRows {
 public:
  ErrorRows(RowForm form, const MovingAxis& moving, Model model);
  ~ErrorRows();  // Does not write the pending blocks.

  // Returns the block that the caller fills next. nullptr: writing has failed, and finish() returns
  // the error.
  SolvedRows* next();
  void put();  // Queues the filled block for writing.
  // Writes the pending blocks. Error: writing to the standard output failed.
  Status finish();

 private:
  void work();
  Status write_all();
  void write_head();
  struct Texts;
  char* append_csv(const SolvedRows& rows, char* out) const;
  char* append_json(const SolvedRows& rows, char* out);

  const RowForm form_;
  std::array<ErrorName, 5> names_;        // With the sign for the moving body.
  std::array<std::string, 6> json_keys_;  // {"EYX_um": ,"encoder_mm":
  std::string head_;
  bool first_row_ = true;
  std::vector<char> text_;
  SolvedRows filling_;
  BoundedQueue<SolvedRows> filled_, free_;  // Written blocks return to free_.
  Status status_;                           // Result of the thread; valid after it has ended.
  std::thread thread_;                      // Last member, because the thread uses all others.
};

}  // namespace mdof::tools
