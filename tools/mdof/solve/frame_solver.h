// Solves the five errors of each row of a frames file, one block of columns at a time.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "algo/model/solver.h"
#include "algo/plausibility/calibrated_stretch.h"
#include "algo/probe_physics/reading_correction.h"
#include "daemon/measure/corrections/point_corrections.h"
#include "drivers/calibration.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"
#include "schema/sample.h"

namespace mdof::tools {

// One value for each row in each column; m and rad in the axis' local frame, motion of the target,
// at the carriage (Eq. 2-12). All errors are NaN if the row is not solved.
struct SolvedRows {
  std::vector<double> encoder_m;
  std::array<std::vector<double>, kErrorCount> local;
  std::size_t size() const { return local[0].size(); }
};

// Thread-bound.
class FrameSolver {
 public:
  // `channels`: the channels in the file's header. Errors: the rig cannot determine the five
  // errors, or does not match the model or the channels.
  static Result<FrameSolver> create(const Rig& rig, Model model, std::vector<Channel> channels);

  // Consumes `raw` and replaces `out` (reusing its memory). Rows keep their order.
  Status solve(SampleBlock& raw, SolvedRows& out);

  std::uint64_t rows() const { return rows_; }
  // Rows in which a probe is at the end of its range.
  std::uint64_t over_range() const { return over_range_; }
  // Rows without errors because a probe's value is missing; not counted as unsolved.
  std::uint64_t without_reading() const { return without_reading_; }
  std::uint64_t unsolved() const { return unsolved_; }
  // The reason for the first unsolved row.
  const std::string& why_unsolved() const { return why_unsolved_; }
  // The applied corrections (schema/rig/effects/physics.h) and their largest amount, one sentence
  // each.
  Notices correction_notices() const;
  // Reports height maps of the rig that do not cover the travel of the rows.
  Notices map_notices(const Rig& rig) const;
  // Reports probes whose readings leave the calibrated range of their record.
  Notices stretch_notices() const { return algo::stretch_notices(rig_, spans_); }

 private:
  FrameSolver(const Rig& rig, algo::Solver solver, std::vector<Channel> channels);
  bool corrects() const { return rig_.physics && rig_.physics->corrects(); }
  std::optional<Air> air_of(const SampleBlock& block, std::size_t row) const;
  // False: the reading cannot be corrected; the reason is noted.
  bool correct(const algo::ReadingCorrection& correction, const SampleBlock& block, std::size_t row,
               std::vector<double>& readings_m);
  void leave_unsolved(std::size_t row, const std::string& why);
  const double* travel(const std::vector<double>& encoder_m);
  void solve_columns(const SampleBlock& block, SolvedRows& out);
  void solve_singly(const SampleBlock& block, SolvedRows& out);
  void note_travel(double travel_m);
  void count_over_range(const SampleBlock& block);
  void note_readings(const SampleBlock& block);
  bool has_missing(const SampleBlock& block, std::size_t row) const;

  Rig rig_;
  algo::Solver solver_;
  drivers::Calibrator calibrator_;
  std::vector<double> travel_m_;  // Used only if the travel differs from the encoder.
  std::vector<Channel> channels_;
  std::size_t encoder_ = 0;
  std::vector<std::size_t> probes_;                             // [probe of the rig] -> channel
  std::array<std::optional<std::size_t>, kAirQuantities> air_;  // channels
  daemon::LargestChange tilt_, dielectric_;
  std::uint64_t rows_ = 0, over_range_ = 0, without_reading_ = 0, unsolved_ = 0;
  std::string why_unsolved_;
  // Least and largest d of the rows solved one by one.
  std::optional<std::array<double, 2>> travels_m_;
  std::vector<std::optional<algo::ReadingSpan>> spans_;  // Probes with a calibrated stretch.
};

}  // namespace mdof::tools
