// Calculates a run from the raw blocks of one axis that moves all the time. The class Pipeline does
// the same for an axis that stops.
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
  // `options` must contain on_the_fly, and check_on_the_fly() must have accepted these options.
  // Errors: those of Pipeline.
  static Result<OnTheFlyRun> create(const Rig& rig, const PipelineOptions& options);

  // Takes a block. Errors: those of Pipeline; a pass is too long; the run would have too many
  // points.
  Status push(SampleBlock& raw);
  // As Pipeline::finish(). Error: the axis passed no bin at a constant speed with enough scans, or
  // no bin could be solved. The message states the reason.
  Result<Run> finish();

 private:
  OnTheFlyRun(Rig rig, PipelineOptions options, algo::Solver solver);
  Status check_room();
  // Removes points during which the encoder was suspect. Error: no point is left.
  Status remove_suspect_points(algo::Sequence& sequence, Notices& notices) const;
  void correct(algo::Sequence& sequence) const;
  Status solve(algo::Sequence& sequence, const algo::Residuals& residuals) const;

  algo::OnTheFly fly_;
  std::size_t passes_seen_ = 0, points_ = 0;  // number of passes and points in fly_
  std::optional<std::int64_t> begin_ns_;
};

}  // namespace mdof::daemon
