// Calculates a run, with its full provenance, from a recorded log. `mdof replay` uses these
// functions.
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

// An open log (recording or CSV) and the description of the run in the log. Thread-bound.
class ReplayLog {
 public:
  // A file that begins with the header of SQLite is a recording. Every other file is CSV, plain or
  // gzip. "-" is CSV from the standard input. If `opened` contains descriptors, open() opens no
  // file, and uses `path` only in messages. Errors: those of the drivers.
  using Descriptors = drivers::RecordingLog::Descriptors;
  static Result<ReplayLog> open(const std::string& path, Descriptors opened);
  static Result<ReplayLog> open(const std::string& path) { return open(path, {}); }

  drivers::Driver& driver() { return *driver_; }
  const std::string& path() const { return path_; }
  const char* kind() const { return recording_ ? "recording" : "csv"; }
  std::string rig_text() const;  // rig in the recording; empty for a CSV log
  // Start time of a recording, or of a CSV log with the comment "started: "; otherwise empty.
  std::string started_utc() const;
  std::string configuration() const;  // mdofd.toml in the recording; empty for a CSV log
  // The request and the options of the recorded run. The options are read from mdofd.toml of the
  // recording; the request of the run overrides these options. A CSV log has the default options.
  Result<RecordedRequest> asked_for() const;
  std::vector<std::string> comments() const;  // comments in the CSV log
  Progress progress() const;                  // in bytes (CSV log) or in chunks (recording)
  // The following functions are valid only after the end of the log has been read.
  std::string sha256() const;
  Notices notices() const;

 private:
  explicit ReplayLog(std::string path) : path_(std::move(path)) {}

  std::string path_;
  std::unique_ptr<drivers::Driver> driver_;
  // One of csv_ and recording_ is *driver_, the other one is nullptr.
  drivers::CsvLog* csv_ = nullptr;
  drivers::RecordingLog* recording_ = nullptr;
};

// check_axis(): error if a comment, "axis: Y", names another axis than the rig. check_channels():
// error if the column of the encoder or of a probe is missing. The message lists the existing
// columns.
Status check_axis(const std::string& source, const std::vector<std::string>& comments,
                  const Rig& rig);
Status check_channels(const std::string& source, const std::vector<Channel>& channels,
                      const Rig& rig);

// Reads the whole log and calculates the run. The run has no id yet. The run has a start time only
// if the log has a start time. `progress` is called after every block and can cancel the replay.
// Errors: the rig does not fit the log; `progress` cancelled the replay; those of the driver and of
// the pipeline.
Result<Run> replay(ReplayLog& log, const Rig& rig, const PipelineOptions& options,
                   const ProgressCallback& progress = {});

}  // namespace mdof::daemon
