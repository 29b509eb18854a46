// Frames of an axis that moves all the time -> points at targets, as dwells would give them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

// Streaming, the same however the frames are cut; the pass under way and the points are kept.
class OnTheFly {
 public:
  // `ids` and `range_m` of the probes, in the order of the frames; of `dwell` the greatest speed.
  OnTheFly(TargetGrid grid, std::vector<std::string> ids, std::vector<double> range_m,
           double max_speed_m_s = DwellOptions().max_speed_m_s);

  // Frames without a place (place_watch.h) are counted and left out. Error: PassFinder's.
  Status push(const FrameBlock& frames);
  void flush();

  // The points in the order of time, a run being a pass over the targets; not yet solved. A target
  // at the ends that is not known beforehand, and that fewer than half of the passes took steadily,
  // is none.
  Sequence sequence() const;
  // Why there is no point, with figures and a remedy; nothing: there are some.
  Status explain_nothing() const;
  // What a reader has to know of the log beside the points.
  Notices notices() const;
  // What a run in motion is, what it leaves out, its speeds, and what motion adds.
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
  PassFinder finder_;
  std::vector<PassBins> passes_;
  DwellDetector::Summary summary_;
  std::int64_t period_ns_ = 0, begin_ns_ = 0, last_ns_ = 0;
  bool begun_ = false;
};

}  // namespace mdof::algo
