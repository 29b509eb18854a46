// Stores a study in the database while it runs. Each write opens the database separately, because a
// study may take hours and mdofd must be able to write meanwhile.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "daemon/store/study/study_record.h"
#include "schema/base/result.h"
#include "schema/study/study.h"
#include "tools/mdof/study/running/checkpoint.h"
#include "tools/mdof/study/running/study_request.h"

namespace mdof::tools {

// A stored study that can be continued.
struct StoredStudy {
  store::StudyRecord record;
  store::StudyCheckpoint checkpoint;
  StudyRequest request;
};
// Errors: not_found; conflict, if the study is complete or has no checkpoint.
Result<StoredStudy> study_to_continue(const std::string& database, std::int64_t id);

// The state of the work of the stored study. Error (bad_input): the experiment has changed, because
// a file that the plan names or mdof itself has changed.
Result<StudyWork> continued_work(const StoredStudy& stored, const Study& study);

class StudyRecorder {
 public:
  StudyRecorder() = default;  // Stores nothing.
  StudyRecorder(std::string database, std::int64_t id) : database_(std::move(database)), id_(id) {}
  static Result<StudyRecorder> begin(std::string database, const Study& study,
                                     const std::string& started_utc);

  std::optional<std::int64_t> id() const { return id_; }
  // Prints a warning if the checkpoint cannot be written; the study continues.
  void checkpoint(const StudyWork& state) const;
  // Stores `state` if the result is not complete.
  Status end(const StudyResult& result, const std::string& figures_json,
             const StudyWork& state) const;
  // "mdof sensitivity --continue 3 --db FILE"
  std::string continue_command() const;

 private:
  std::string database_;  // The argument of --db.
  std::optional<std::int64_t> id_;
};

}  // namespace mdof::tools
