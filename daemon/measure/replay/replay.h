// A recorded log -> a run with its full provenance. This is the work of `mdof replay`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/pipeline.h"
#include "daemon/measure/replay/request_json.h"
#include "drivers/csv/csv_log.h"
#include "drivers/recording/recording_log.h"
#include "schema/base/progress.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// An open log of either kind, with its description of the run. Thread-bound.
class ReplayLog {
 public:
  // A file that begins with the bytes of SQLite is a recording; every other file is CSV, plain or
  // gzip. "-" is CSV from the standard input. Errors are those of the drivers. With open
  // descriptors (also of a CSV file) `path` is only used in messages, and no file is opened.
  using Descriptors = drivers::RecordingLog::Descriptors;
  static Result<ReplayLog> open(const std::string& path, Descriptors opened);
  static Result<ReplayLog> open(const std::string& path) { return open(path, {}); }

  drivers::Driver& driver() { return *driver_; }
  const std::string& path() const { return path_; }
  const char* kind() const { return recording_ ? "recording" : "csv"; }
  std::string rig_text() const;       // rig of a recording, otherwise empty
  std::string started_utc() const;    // start of a recording, otherwise empty (unknown)
  std::string configuration() const;  // mdofd.toml of a recording, otherwise empty
  // The options of the recorded run: its mdofd.toml, overridden by the request of the run. Defaults
  // for a CSV log.
  Result<RecordedRequest> asked_for() const;
  std::vector<std::string> comments() const;  // comments of a CSV log
  Progress progress() const;                  // in bytes of a CSV log, in chunks of a recording
  // Valid after the end of the log:
  std::string sha256() const;
  Notices notices() const;

 private:
  explicit ReplayLog(std::string path) : path_(std::move(path)) {}

  std::string path_;
  std::unique_ptr<drivers::Driver> driver_;
  drivers::CsvLog* csv_ = nullptr;  // either csv_ or recording_ points to driver_
  drivers::RecordingLog* recording_ = nullptr;
};

// Checks that the rig fits this file. Errors: a comment "axis: Y" that names another axis; a
// missing column of the encoder or of a probe (the message lists the existing columns).
Status check_axis(const std::string& source, const std::vector<std::string>& comments,
                  const Rig& rig);
Status check_channels(const std::string& source, const std::vector<Channel>& channels,
                      const Rig& rig);

// Reads the whole log through the pipeline. The run has everything but its id; it has a start time
// only if the log has one. Errors: a rig that does not fit the log; those of the driver and the
// pipeline; `progress`, which is called after every block, cancelled the replay.
Result<Run> replay(ReplayLog& log, const Rig& rig, const PipelineOptions& options,
                   const ProgressCallback& progress = {});

}  // namespace mdof::daemon
