// Continues a run that was cut off or stopped early as a new run that supersedes it. Its recording
// is recorded and measured again; then the samples of the devices follow.
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

// The request of the run, with the run itself as the start. Errors: not_found; conflict, if the run
// is complete, in progress, not recorded here, superseded, of another rig, or if only one of the
// run and the axis is simulated.
Result<RunRequest> request_to_resume(store::Store& reader, std::int64_t run,
                                     const AxisConfig& axis);

// A run is evaluated with the same settings throughout. Error (conflict): these settings would
// change its first part.
Status check_same_settings(const CutOffRun& cut_off, const PipelineOptions& now);

// A run has one datum. Error (conflict): equal positions in the run and `now` are, or may be,
// different places. `counts_on`: as from EncoderZero::has_counted_since() for the run.
Status check_same_datum(const CutOffRun& cut_off, const EncoderDatum& now, bool counts_on);

// Reads the recording of `cut_off` into `pipeline` and, block by block, into `run.begun`, which it
// creates. Returns the time of the last scan. Errors: those of reading or writing a recording; io
// if `wanted` becomes false. Takes as long as a replay.
Result<std::int64_t> record_again(const CutOffRun& cut_off, const Storekeeper& keeper, NewRun& run,
                                  Pipeline& pipeline, const std::atomic<bool>& wanted);

// Shifts the samples of the devices to the time line of the continued recording.
class Continuation {
 public:
  explicit Continuation(std::int64_t after_ns) : after_ns_(after_ns) {}
  // The machine's clock may have restarted since. The first block of each device states lost scans,
  // because the axis was not measured before it.
  void shift(SampleBlock& block);

 private:
  std::int64_t after_ns_;
  std::optional<std::int64_t> shift_ns_;
  std::set<std::string> seen_;  // devices
};

}  // namespace mdof::daemon
