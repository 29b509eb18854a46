// Common part of a run with dwells (pipeline.h) and a run on the fly (replay/on_the_fly_run.h): raw
// blocks become frames, and solved points become a run. The two differ in how they find points.
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

// Solved points, stated at the fixture.
struct SolvedPoints {
  algo::Sequence sequence;
  const std::vector<Point>& as_read;  // averaged, not corrected
  const algo::DwellDetector::Summary& summary;
  double least_dwell_s = 0;
  const algo::Residuals& residuals;
  std::vector<double> targets_m;  // targets of a complete run
  // Notices by their place in the run's list: at the beginning; after the notices on the run's
  // signals; after those on corrections; at the end, as reasons why the run is partial.
  Notices first = {}, notices_after_signals = {}, of_points = {}, partial = {};
};

// Thread-bound.
class RunBuilder {
 protected:
  RunBuilder(Rig rig, PipelineOptions options, algo::Solver solver);

  // Consumes the block; the completed frames are in frames_. Error: the block cannot be calibrated,
  // or its time decreases.
  Status take(SampleBlock& raw);
  // Fills points, figures, scans, notices and state of a run.
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
