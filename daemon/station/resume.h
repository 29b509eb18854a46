// A run that was cut off, or stopped before it had all, goes on as a new run that supersedes it:
// what was recorded of it is recorded again and measured again, then the devices follow.
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

// What the run was asked for, with the run itself to go on from. Errors: not_found; conflict for a
// run that is complete or under way, was not recorded here, is superseded, whose rig is another, or
// whose devices were simulated where those of the axis are not, or the other way round.
Result<RunRequest> request_to_resume(store::Store& reader, std::int64_t run,
                                     const AxisConfig& axis);

// One run is evaluated in one way. Error (conflict): these settings would change its first part.
Status check_same_settings(const CutOffRun& cut_off, const PipelineOptions& now);

// One run has one datum. Error (conflict): a position of the run and the same number `now` are, or
// may be, two places. `counts_on`: as of EncoderZero::counts_on_since() the run's beginning.
Status check_same_datum(const CutOffRun& cut_off, const EncoderDatum& now, bool counts_on);

// Reads the recording of `cut_off` into `pipeline` and, block by block, into `run.begun`, which it
// makes. Gives the time of the last scan. Errors: as of a recording that is read or written; io
// where `wanted` has become false. Takes as long as a replay.
Result<std::int64_t> record_again(const CutOffRun& cut_off, const Storekeeper& keeper, NewRun& run,
                                  Pipeline& pipeline, const std::atomic<bool>& wanted);

// Puts what the devices give on the time line of the recording that it continues.
class Continuation {
 public:
  explicit Continuation(std::int64_t after_ns) : after_ns_(after_ns) {}
  // The machine's clock may have begun anew since. The first block of each device says that scans
  // were lost: nobody saw the axis before it.
  void shift(SampleBlock& block);

 private:
  std::int64_t after_ns_;
  std::optional<std::int64_t> shift_ns_;
  std::set<std::string> seen_;  // devices
};

}  // namespace mdof::daemon
