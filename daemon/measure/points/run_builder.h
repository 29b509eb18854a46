// What is alike for a run that dwells (pipeline.h) and one on the fly (replay/on_the_fly_run.h):
// raw blocks become frames, and solved points become a run. They differ in how they find the
// points.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "algo/model/solver.h"
#include "algo/plausibility/plausibility.h"
#include "algo/points/align.h"
#include "algo/uncertainty/chi_square.h"
#include "daemon/measure/corrections/point_corrections.h"
#include "daemon/measure/pipeline_options.h"
#include "daemon/measure/points/run_temperature.h"
#include "daemon/measure/points/suspect_encoder.h"
#include "drivers/calibration.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/sample.h"

namespace mdof::daemon {

// Points that were found and solved, stated at the fixture.
struct SolvedPoints {
  algo::Sequence sequence;
  const std::vector<Point>& as_read;  // averaged, not corrected
  const algo::DwellDetector::Summary& summary;
  double least_dwell_s = 0;
  const algo::Residuals& residuals;
  std::vector<double> targets_m;  // that a complete run has
  // By where they stand among the run's: first; behind what the run looks like; behind what its
  // points were corrected by; last, where the run is partial for this.
  Notices first = {}, of_signals = {}, of_points = {}, partial = {};
};

// Thread-bound.
class RunBuilder {
 protected:
  RunBuilder(Rig rig, PipelineOptions options, algo::Solver solver);

  // Uses the block up; frames that became complete are in frames_. Error: it cannot be calibrated,
  // or its time goes backwards.
  Status take(SampleBlock& raw);
  // Points, figures, scans and notices of a run, and its state.
  Run build(SolvedPoints points) const;

  Rig rig_;
  PipelineOptions options_;
  drivers::Calibrator calibrator_;
  algo::Aligner aligner_;
  algo::Solver solver_;
  PointCorrections corrections_;
  FrameBlock frames_;
  std::uint64_t lost_ = 0;
  SuspectEncoder suspect_;
  RunTemperature temperature_;

 private:
  RunHeader head(const algo::DwellDetector::Summary& summary) const;
  void add_plausibility(const SolvedPoints& points, Run& run) const;
};

}  // namespace mdof::daemon
