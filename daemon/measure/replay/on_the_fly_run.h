// Raw blocks of one axis that moves all the time -> a run: what Pipeline does where it dwells.
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
  // `options` have on_the_fly, which check_on_the_fly() accepts. Error: Pipeline's.
  static Result<OnTheFlyRun> create(const Rig& rig, const PipelineOptions& options);

  // Uses the block up. Error: Pipeline's, a pass that is too long, or more points than a run holds.
  Status push(SampleBlock& raw);
  // End of the data, as Pipeline::finish(). Error: no bin was passed at a steady speed with scans
  // enough, or none could be solved, with the reason.
  Result<Run> finish();

 private:
  OnTheFlyRun(Rig rig, PipelineOptions options, algo::Solver solver);
  Status check_room();
  // Points while the encoder was suspect. Error: there are no others.
  Status leave_suspect_out(algo::Sequence& sequence, Notices& notices) const;
  void correct(algo::Sequence& sequence) const;
  Status solve(algo::Sequence& sequence, const algo::Residuals& residuals) const;

  algo::OnTheFly fly_;
  std::size_t passes_seen_ = 0, points_ = 0;  // of fly_
  std::optional<std::int64_t> begin_ns_;
};

}  // namespace mdof::daemon
