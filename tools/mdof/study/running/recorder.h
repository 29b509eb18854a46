// A study in the database while it goes on. The database is opened for each write only: a study may
// take hours, and mdofd may want to write meanwhile.
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

// A stored study that can go on.
struct StoredStudy {
  store::StudyRecord record;
  store::StudyCheckpoint checkpoint;
  StudyRequest request;
};
// not_found, or a conflict where it is complete or nothing of it was kept.
Result<StoredStudy> study_to_continue(const std::string& database, std::int64_t id);

// The study as far as it goes, with the state of its work. bad_input where the experiment is not
// what it was: a file that the plan names, or mdof itself, has changed.
Result<StudyWork> continued_work(const StoredStudy& stored, const Study& study);

class StudyRecorder {
 public:
  StudyRecorder() = default;  // keeps nothing
  StudyRecorder(std::string database, std::int64_t id) : database_(std::move(database)), id_(id) {}
  static Result<StudyRecorder> begin(std::string database, const Study& study,
                                     const std::string& started_utc);

  std::optional<std::int64_t> id() const { return id_; }
  // A warning where it cannot be written: the study goes on.
  void checkpoint(const StudyWork& state) const;
  // `state` is kept where the result is not complete.
  Status end(const StudyResult& result, const std::string& figures_json,
             const StudyWork& state) const;
  // "mdof sensitivity --continue 3 --db FILE"
  std::string how_to_continue() const;

 private:
  std::string database_;  // as for --db
  std::optional<std::int64_t> id_;
};

}  // namespace mdof::tools
