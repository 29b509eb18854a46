// Common base class of Pipeline (runs with dwells) and OnTheFlyRun (replay/on_the_fly_run.h). It
// converts raw blocks to frames, and builds a run from solved points. The two derived classes find
// the points in different ways.
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

// Solved points. The reference point of their errors is the fixture.
struct SolvedPoints {
  algo::Sequence sequence;
  const std::vector<Point>& as_read;  // averaged points without corrections
  const algo::DwellDetector::Summary& summary;
  const algo::Residuals& residuals;
  std::vector<double> targets_m;  // requested targets; empty: targets were recognised
  // Notices for four places in the list of notices of the run: `first` at the beginning,
  // notices_after_signals after the notices about the signals, `of_points` after the notices about
  // the corrections, `partial` at the end. `partial` states why the run is partial.
  Notices first = {}, notices_after_signals = {}, of_points = {}, partial = {};
};

// Thread-bound.
class RunBuilder {
 protected:
  RunBuilder(Rig rig, PipelineOptions options, algo::Solver solver);

  // Takes a block and changes its content. The frames that are complete now are in frames_. Error:
  // the block cannot be calibrated, or its time decreases.
  Status take(SampleBlock& raw);
  // The two steps of take().
  Status calibrate(SampleBlock& raw);
  Status align(SampleBlock& calibrated) { return aligner_.push(calibrated, frames_); }
  // Returns a run with points, figures, scans, notices and state.
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
  std::optional<std::int64_t> begin_ns_;  // time of the first scan; nullopt: no scan yet
  std::int64_t end_ns_ = 0;               // time of the last scan

 private:
  RunHeader head(const algo::DwellDetector::Summary& summary) const;
  void add_plausibility(const SolvedPoints& points, Run& run) const;
};

}  // namespace mdof::daemon
