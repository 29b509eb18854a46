// A recorded log -> a run with its full provenance: what `mdof replay` does.
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

// A log of either kind, open for reading, with what its run has to say of it. Thread-bound.
class ReplayLog {
 public:
  // A recording by the first bytes of the file (SQLite's), else CSV, plain or gzip. "-" is CSV from
  // the standard input. Errors are the drivers'. With descriptors that are open already (of a CSV
  // file as well) `path` is for messages alone, and no file is opened.
  using Descriptors = drivers::RecordingLog::Descriptors;
  static Result<ReplayLog> open(const std::string& path, Descriptors opened);
  static Result<ReplayLog> open(const std::string& path) { return open(path, {}); }

  drivers::Driver& driver() { return *driver_; }
  const std::string& path() const { return path_; }
  const char* kind() const { return recording_ ? "recording" : "csv"; }
  std::string rig_text() const;       // of a recording, else empty
  std::string started_utc() const;    // of a recording, else empty: not known
  std::string configuration() const;  // mdofd.toml of a recording, else empty
  // How the run was measured of which this is the recording: by its mdofd.toml, then by what was
  // asked of it. Defaults for a CSV log.
  Result<AskedFor> asked_for() const;
  std::vector<std::string> comments() const;  // of a CSV log
  Progress progress() const;                  // in bytes of a CSV log, in chunks of a recording
  // After the end of the log:
  std::string sha256() const;
  Notices notices() const;

 private:
  explicit ReplayLog(std::string path) : path_(std::move(path)) {}

  std::string path_;
  std::unique_ptr<drivers::Driver> driver_;
  drivers::CsvLog* csv_ = nullptr;  // one of these two is the driver
  drivers::RecordingLog* recording_ = nullptr;
};

// Does the rig fit this file? Errors: a comment "axis: Y" says that it is of another axis; there is
// no column of the encoder or of one of the rig's probes (the columns there are get named).
Status check_axis(const std::string& source, const std::vector<std::string>& comments,
                  const Rig& rig);
Status check_channels(const std::string& source, const std::vector<Channel>& channels,
                      const Rig& rig);

// Reads the log to its end through the pipeline. The run has everything but its id, and a starting
// time only if the log has one. Errors: a rig that does not fit the log, the driver's and the
// pipeline's; `progress`, called after every block, gave it up.
Result<Run> replay(ReplayLog& log, const Rig& rig, const PipelineOptions& options,
                   const ProgressCallback& progress = {});

}  // namespace mdof::daemon
