// Rows of a frames file -> five errors each, a block of columns at a time.
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

// One value a row in each column; m and rad in the axis' local frame, of the target, at the
// carriage (Eq. 2-12); all NaN where not solved.
struct SolvedRows {
  std::vector<double> encoder_m;
  std::array<std::vector<double>, kErrorCount> local;
  std::size_t size() const { return local[0].size(); }
};

// Thread-bound.
class FrameSolver {
 public:
  // `channels` as the file's header has them. Errors: the rig cannot see the five errors, or does
  // not fit the model or the channels.
  static Result<FrameSolver> create(const Rig& rig, Model model, std::vector<Channel> channels);

  // `raw` is used up, `out` replaced (its memory is reused). Rows keep their order.
  Status solve(SampleBlock& raw, SolvedRows& out);

  std::uint64_t rows() const { return rows_; }
  std::uint64_t over_range() const { return over_range_; }  // rows with a probe at its range's end
  // Rows without errors because a probe's value is missing; not counted as unsolved.
  std::uint64_t without_reading() const { return without_reading_; }
  std::uint64_t unsolved() const { return unsolved_; }
  const std::string& why_unsolved() const { return why_unsolved_; }  // of the first such row
  // What was corrected (schema/rig/effects/physics.h), and by how much at most; one sentence each.
  Notices correction_notices() const;
  // Height maps of the rig that end before the rows do.
  Notices map_notices(const Rig& rig) const;
  // Probes that read where their record has not calibrated them.
  Notices stretch_notices() const { return algo::stretch_notices(rig_, spans_); }

 private:
  FrameSolver(const Rig& rig, algo::Solver solver, std::vector<Channel> channels);
  bool corrects() const { return rig_.physics && rig_.physics->corrects(); }
  std::optional<Air> air_of(const SampleBlock& block, std::size_t row) const;
  // False: why it cannot be is noted.
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
  std::vector<double> travel_m_;  // where it is not the encoder
  std::vector<Channel> channels_;
  std::size_t encoder_ = 0;
  std::vector<std::size_t> probes_;                             // [probe of the rig] -> channel
  std::array<std::optional<std::size_t>, kAirQuantities> air_;  // channels
  daemon::LargestChange tilt_, dielectric_;
  std::uint64_t rows_ = 0, over_range_ = 0, without_reading_ = 0, unsolved_ = 0;
  std::string why_unsolved_;
  std::optional<std::array<double, 2>> travels_m_;       // least and most d solved one by one
  std::vector<std::optional<algo::ReadingSpan>> spans_;  // of probes with a calibrated stretch
};

}  // namespace mdof::tools
