// Continues a run that ended early. The continued run is a new run that supersedes the old run.
// mdofd first copies and measures the recording of the old run, and then measures the samples of
// the devices.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "daemon/measure/configuration/config.h"
#include "daemon/measure/pipeline.h"
#include "daemon/measure/run_request.h"
#include "daemon/store/store.h"
#include "daemon/storekeeper/storekeeper.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// The request for a run that continues `run`. Errors: not_found; conflict if the old run
//   - is complete, in progress or superseded,
//   - was not recorded by mdofd,
//   - has another rig than the axis has now, or
//   - was simulated and the axis is not, or the other way round.
Result<RunRequest> request_to_resume(store::Store& reader, std::int64_t run,
                                     const AxisConfig& axis);

// Both parts of a run must be evaluated with the same settings. Error (conflict): `now` differs
// from the settings of the old run.
Status check_same_settings(const CutOffRun& cut_off, const PipelineOptions& now);

// Both parts of a run must have the same datum. Error (conflict): the datum `now` is, or may be,
// different from the datum of the old run. `counts_on`: result of EncoderZero::has_counted_since()
// for the old run.
Status check_same_datum(const CutOffRun& cut_off, const EncoderDatum& now, bool counts_on);

// Reads the recording of `cut_off`. Pushes each block into `pipeline`, and writes it to the new
// recording `run.begun`. Returns the time of the last scan. Errors: those of reading or writing a
// recording; io if `wanted` becomes false. Takes as long as a replay.
Result<std::int64_t> record_again(const CutOffRun& cut_off, const Storekeeper& keeper, NewRun& run,
                                  Pipeline& pipeline, const std::atomic<bool>& wanted);

// Shifts the times of new samples so that they follow the times of the old recording.
class Continuation {
 public:
  explicit Continuation(std::int64_t after_ns) : after_ns_(after_ns) {}
  // The shift is at least 0. A shift is needed because the clock of the computer may have restarted
  // after the old run. The first block of each device states lost scans, because the axis was not
  // measured between the two parts.
  void shift(SampleBlock& block);

 private:
  std::int64_t after_ns_;
  std::optional<std::int64_t> shift_ns_;
  std::set<std::string> seen_;  // devices that have sent a block
};

}  // namespace mdof::daemon
