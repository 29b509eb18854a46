// Calculates points at the targets from frames of an axis that moves without stopping. The points
// have the same type as the points of stops.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/on_the_fly/jump_search.h"
#include "algo/on_the_fly/pass_bins.h"
#include "algo/on_the_fly/passes.h"
#include "algo/on_the_fly/reading_lag.h"
#include "algo/on_the_fly/target_grid.h"
#include "algo/plausibility/encoder/place_watch.h"
#include "algo/plausibility/probe/probe_watch.h"
#include "algo/plausibility/resolution.h"
#include "algo/points/dwell.h"
#include "algo/sequence/sequence.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::algo {

// The result does not depend on how the frames are divided into blocks. The current pass and all
// points are kept in memory.
class OnTheFly {
 public:
  // `ids` and `range_m`: ids and ranges of the probes, in the order of the probes in the frames.
  OnTheFly(TargetGrid grid, std::vector<std::string> ids, std::vector<double> range_m,
           double max_speed_m_s = DwellOptions().max_speed_m_s);

  // Counts frames without a valid position (place_watch.h) and leaves them out. Errors: the errors
  // of PassFinder::push().
  Status push(const FrameBlock& frames);
  void flush();

  // Returns the points in the order of time; their errors are not yet solved. Each pass over the
  // targets is a run. A target that was not specified before the run is left out if it has fewer
  // than half as many points as the target with the most points.
  Sequence sequence() const;
  // Error: there is no point. The error states measured values and what to change.
  Status check_has_points() const;
  // Notices about events in the log that are not visible in the points. If the encoder's count
  // jumped by 50 µm or more, the positions after the jump are invalid.
  Notices notices() const;
  // Notices about the method: that the run was measured in motion, omitted bins, speeds, and the
  // effects of the motion.
  Notices statements() const;

  const DwellDetector::Summary& summary() const { return summary_; }
  const std::vector<PassBins>& passes() const { return passes_; }
  std::vector<ReadingLag> lags() const { return reading_lags(passes_, probes_.ids.size()); }

 private:
  void begin(const FrameBlock& frames);
  void take_pass(const AxisPass& pass);
  void learn_resolution(const AxisPass& pass);
  void watch(const AxisPass& pass, const PassBins& bins);
  std::vector<TargetGrid::Target> targets() const;

  TargetGrid grid_;
  ProbesOfBins probes_;
  ProbeResolution resolution_;
  PlaceWatch places_;
  ProbeWatch watch_;
  JumpSearch jumps_;
  PassFinder finder_;
  std::vector<PassBins> passes_;
  DwellDetector::Summary summary_;
  std::int64_t period_ns_ = 0, begin_ns_ = 0, last_ns_ = 0;
  bool begun_ = false;
};

}  // namespace mdof::algo
