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

// Each column has one value for each row. The errors describe the motion of the target in the local
// frame of the axis, in m and rad (Eq. 2-12); their reference point is the origin of the carriage.
// If the fixture moves, they are the negative errors of the fixture.
// In an unsolved row all errors are NaN.
struct SolvedRows {
  std::vector<double> encoder_m;
  std::array<std::vector<double>, kErrorCount> local;
  std::size_t size() const { return local[0].size(); }
};

// Thread-bound.
class FrameSolver {
 public:
  // `channels`: the channels in the header of the file. Errors: the probes of the rig cannot
  // determine the five errors; the rig does not match the model or the channels.
  static Result<FrameSolver> create(const Rig& rig, Model model, std::vector<Channel> channels);

  // Solves the rows of `raw` and replaces the contents of `out`, in the same order. Converts the
  // values in `raw` to metres.
  Status solve(SampleBlock& raw, SolvedRows& out);

  std::uint64_t rows() const { return rows_; }
  // Number of rows in which a probe is at the end of its range.
  std::uint64_t over_range() const { return over_range_; }
  // Number of rows without errors because the reading of a probe is missing. unsolved() does not
  // include these rows.
  std::uint64_t without_reading() const { return without_reading_; }
  std::uint64_t unsolved() const { return unsolved_; }
  // Why the first unsolved row was not solved.
  const std::string& why_unsolved() const { return why_unsolved_; }
  // One sentence for each applied correction (schema/rig/effects/physics.h), with its largest
  // value.
  Notices correction_notices() const;
  // Reports the height maps of the rig that do not cover the travel in these rows.
  Notices map_notices(const Rig& rig) const;
  // Reports the probes with readings outside the calibrated range in their calibration record.
  Notices calibrated_range_notices() const { return algo::calibrated_range_notices(rig_, spans_); }

 private:
  FrameSolver(const Rig& rig, algo::Solver solver, std::vector<Channel> channels);
  bool corrects() const { return rig_.physics && rig_.physics->corrects(); }
  std::optional<Air> air_of(const SampleBlock& block, std::size_t row) const;
  // Corrects the readings of one row. False: a reading cannot be corrected; the function stores the
  // reason.
  bool correct(const algo::ReadingCorrection& correction, const SampleBlock& block, std::size_t row,
               std::vector<double>& readings_m);
  void leave_unsolved(std::size_t row, const std::string& why);
  const double* travel(const std::vector<double>& encoder_m);
  void solve_columns(const SampleBlock& block, SolvedRows& out);
  void solve_singly(const SampleBlock& block, SolvedRows& out);
  void convert_to_fixture(SolvedRows& out) const;
  void note_travel(double travel_m);
  void count_over_range(const SampleBlock& block);
  void note_readings(const SampleBlock& block);
  bool has_missing(const SampleBlock& block, std::size_t row) const;

  Rig rig_;
  algo::Solver solver_;
  drivers::Calibrator calibrator_;
  std::vector<double> travel_m_;  // Used only if the travel differs from the encoder position.
  std::vector<Channel> channels_;
  std::size_t encoder_ = 0;
  std::vector<std::size_t> probes_;                             // [probe of the rig] -> channel
  std::array<std::optional<std::size_t>, kAirQuantities> air_;  // channels
  daemon::LargestChange tilt_, dielectric_;
  std::uint64_t rows_ = 0, over_range_ = 0, without_reading_ = 0, unsolved_ = 0;
  std::string why_unsolved_;
  // Smallest and largest travel of the rows that were solved one by one.
  std::optional<std::array<double, 2>> travels_m_;
  // [probe] range of its readings; nullopt: its record states no calibrated range.
  std::vector<std::optional<algo::ReadingSpan>> spans_;
};

}  // namespace mdof::tools
