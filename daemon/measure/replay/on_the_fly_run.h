// Raw blocks of one axis that moves all the time -> a run. Pipeline does the same for dwells.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "algo/on_the_fly/on_the_fly.h"
#include "daemon/measure/points/run_builder.h"

namespace mdof::daemon {

// Thread-bound.
class OnTheFlyRun : RunBuilder {
 public:
  // `options` contain on_the_fly, accepted by check_on_the_fly(). Errors: those of Pipeline.
  static Result<OnTheFlyRun> create(const Rig& rig, const PipelineOptions& options);

  // Consumes the block. Errors: those of Pipeline; a pass that is too long; more points than a run
  // may have.
  Status push(SampleBlock& raw);
  // Ends the data, like Pipeline::finish(). Error: no bin was passed at a constant speed with
  // enough scans, or no bin could be solved; the message states the reason.
  Result<Run> finish();

 private:
  OnTheFlyRun(Rig rig, PipelineOptions options, algo::Solver solver);
  Status check_room();
  // Removes points during which the encoder was suspect. Error: no others are left.
  Status leave_suspect_out(algo::Sequence& sequence, Notices& notices) const;
  void correct(algo::Sequence& sequence) const;
  Status solve(algo::Sequence& sequence, const algo::Residuals& residuals) const;

  algo::OnTheFly fly_;
  std::size_t passes_seen_ = 0, points_ = 0;  // counts in fly_
  std::optional<std::int64_t> begin_ns_;
};

}  // namespace mdof::daemon
