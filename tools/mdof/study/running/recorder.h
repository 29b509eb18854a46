// Stores a study in the database while it runs. Opens the database for each write and closes it
// again, because a study may take hours and mdofd must be able to write during this time.
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
// Errors: not_found: no such study; conflict: the study is complete or has no checkpoint.
Result<StoredStudy> study_to_continue(const std::string& database, std::int64_t id);

// The state from the checkpoint of the stored study. Error (bad_input): the experiment differs from
// the stored one, because mdof or a file that the plan names has changed.
Result<StudyWork> continued_work(const StoredStudy& stored, const Study& study);

class StudyRecorder {
 public:
  StudyRecorder() = default;  // This recorder stores nothing.
  StudyRecorder(std::string database, std::int64_t id) : database_(std::move(database)), id_(id) {}
  static Result<StudyRecorder> begin(std::string database, const Study& study,
                                     const std::string& started_utc);

  std::optional<std::int64_t> id() const { return id_; }
  // Prints a warning if the checkpoint cannot be written; the study continues.
  void checkpoint(const StudyWork& state) const;
  // Stores the result. If the study is not complete, also stores `state`, so that the study can be
  // continued.
  Status end(const StudyResult& result, const std::string& figures_json,
             const StudyWork& state) const;
  // The command that continues the study: "mdof sensitivity --continue 3 --db FILE".
  std::string continue_command() const;

 private:
  std::string database_;  // The argument of --db.
  std::optional<std::int64_t> id_;
};

}  // namespace mdof::tools
