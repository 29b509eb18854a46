#include "tools/mdof/solve/frame_solver.h"

#include <algorithm>
#include <functional>

#include "algo/model/moving_body.h"
#include "algo/plausibility/map_cover.h"

namespace mdof::tools {
namespace {

std::size_t index_of(const std::vector<Channel>& channels, const std::string& id) {
  const auto found =
      std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.id == id; });
  assert(found != channels.end());
  return static_cast<std::size_t>(found - channels.begin());
}

}  // namespace

Result<FrameSolver> FrameSolver::create(const Rig& rig, Model model,
                                        std::vector<Channel> channels) {
  MDOF_TRY(algo::Solver solver, algo::Solver::create(rig, model));
  return FrameSolver(rig, std::move(solver), std::move(channels));
}

FrameSolver::FrameSolver(const Rig& rig, algo::Solver solver, std::vector<Channel> channels)
    : rig_(rig),
      solver_(std::move(solver)),
      calibrator_(rig),
      channels_(std::move(channels)),
      spans_(rig.probes.size()) {
  encoder_ = index_of(channels_, kEncoderChannel);
  for (const Probe& probe : rig.probes) probes_.push_back(index_of(channels_, probe.id));
  for (std::size_t q = 0; q < kAirQuantities; ++q)
    for (std::size_t c = 0; c < channels_.size(); ++c)
      if (daemon::has_air_quantity(channels_[c], q)) air_[q] = c;
}

Status FrameSolver::solve(SampleBlock& raw, SolvedRows& out) {
  raw.channels = channels_;  // the channels of the previous block were converted to metres
  raw.quality.clear();
  MDOF_CHECK(calibrator_.apply(raw));
  count_over_range(raw);
  note_readings(raw);
  out.encoder_m = raw.value[encoder_];
  for (auto& column : out.local) column.resize(raw.scans());
  solver_.small_angle() && !corrects() ? solve_columns(raw, out) : solve_singly(raw, out);
  if (rig_.sides.fixture_moves) convert_to_fixture(out);
  rows_ += raw.scans();
  return {};
}

// The travel d of the target in the models. It needs a separate column only if it differs from the
// encoder position.
const double* FrameSolver::travel(const std::vector<double>& encoder_m) {
  if (rig_.sides.target_travel_m(1.0) > 0) return encoder_m.data();
  travel_m_.resize(encoder_m.size());
  std::transform(encoder_m.begin(), encoder_m.end(), travel_m_.begin(), std::negate<>());
  return travel_m_.data();
}

void FrameSolver::solve_columns(const SampleBlock& block, SolvedRows& out) {
  const algo::SmallAngleFixture& fixture = *solver_.small_angle();
  algo::BatchIn in{travel(block.value[encoder_]), {}};
  algo::BatchOut to{};
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    in.reading_m[k] = block.value[probes_[fixture.probe[k]]].data();
    to.local[k] = out.local[k].data();
  }
  algo::solve_batch(solver_.model(), fixture, in, to, block.scans());
  if (block.quality.empty()) return;
  for (std::size_t i = 0; i < block.scans(); ++i) {
    if (!has_missing(block, i)) continue;
    ++without_reading_;
    // All errors become NaN, also those that do not depend on the missing reading.
    for (auto& column : out.local) column[i] = kNaN;
  }
}

void FrameSolver::solve_singly(const SampleBlock& block, SolvedRows& out) {
  std::optional<algo::ReadingCorrection> correction;
  if (corrects())
    correction.emplace(rig_, solver_,
                       algo::WhichCorrections{rig_.physics->tilt, rig_.physics->dielectric});
  std::vector<double> readings_m(probes_.size());
  for (std::size_t i = 0; i < block.scans(); ++i) {
    for (std::size_t p = 0; p < probes_.size(); ++p) readings_m[p] = block.value[probes_[p]][i];
    const double travel_m = rig_.sides.target_travel_m(block.value[encoder_][i]);
    if (correction && !correct(*correction, block, i, readings_m)) {
      for (auto& column : out.local) column[i] = kNaN;
      continue;
    }
    const AxisErrors errors = solver_.solve(travel_m, readings_m, {});
    if (errors.valid) note_travel(travel_m);
    for (std::size_t k = 0; k < kErrorCount; ++k)
      out.local[k][i] = errors.valid ? errors.local[k] : kNaN;
    if (errors.valid) continue;
    if (has_missing(block, i))
      ++without_reading_;
    else
      leave_unsolved(i, errors.reason);
  }
}

void FrameSolver::convert_to_fixture(SolvedRows& out) const {
  AxisErrors row;
  row.valid = true;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (std::isnan(out.local[0][i])) continue;
    for (std::size_t k = 0; k < kErrorCount; ++k) row.local[k] = out.local[k][i];
    const Errors5 moving = algo::errors_of_moving_body(row, solver_.model(), rig_.moving()).local;
    for (std::size_t k = 0; k < kErrorCount; ++k) out.local[k][i] = moving[k];
  }
}

void FrameSolver::leave_unsolved(std::size_t row, const std::string& why) {
  if (unsolved_++ == 0) why_unsolved_ = "row " + std::to_string(rows_ + row + 1) + ": " + why;
}

// The ambient conditions of a row: each value is the declared value of the rig, otherwise the value
// in the row.
std::optional<Air> FrameSolver::air_of(const SampleBlock& block, std::size_t row) const {
  Air air{};
  for (std::size_t q = 0; q < kAirQuantities; ++q) {
    const auto& declared = rig_.physics->air->run[q];
    air[q] = declared ? *declared : air_[q] ? block.value[*air_[q]][row] : kNaN;
    if (!(air[q] >= air_quantities()[q].least && air[q] <= air_quantities()[q].most))
      return std::nullopt;
  }
  return air;
}

bool FrameSolver::correct(const algo::ReadingCorrection& correction, const SampleBlock& block,
                          std::size_t row, std::vector<double>& readings_m) {
  std::optional<Air> air = Air{};
  if (rig_.physics->dielectric) air = air_of(block, row);
  if (!air) {
    leave_unsolved(row,
                   "the dielectric correction ([corrections] of the rig) needs ambient conditions, "
                   "which are unknown or out of range; give permitted values in each row");
    return false;
  }
  const auto corrected = correction.correct(rig_.sides.target_travel_m(block.value[encoder_][row]),
                                            readings_m, {}, *air);
  if (!corrected.why_not.empty()) {
    leave_unsolved(row, corrected.why_not);
    return false;
  }
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    tilt_.add(corrected.tilt_m[k], rig_.probes[k].id);
    dielectric_.add(corrected.dielectric_m[k], rig_.probes[k].id);
  }
  readings_m = corrected.readings_m;
  return true;
}

Notices FrameSolver::correction_notices() const {
  Notices found;
  if (!rig_.physics) return found;
  if (rig_.physics->tilt) found.push_back(daemon::change_notice("tilt", true, tilt_));
  if (rig_.physics->dielectric)
    found.push_back(daemon::change_notice("dielectric", true, dielectric_));
  return found;
}

void FrameSolver::note_travel(double travel_m) {
  if (!travels_m_) travels_m_ = {travel_m, travel_m};
  auto& [least, most] = *travels_m_;
  least = std::min(least, travel_m);
  most = std::max(most, travel_m);
}

// travels_m_ is known only if rows were solved one by one. Only the rigid model uses height maps,
// and it solves rows one by one.
Notices FrameSolver::map_notices(const Rig& rig) const {
  if (!travels_m_) return {};
  return algo::map_notices(rig, solver_.fixture(), (*travels_m_)[0], (*travels_m_)[1]);
}

void FrameSolver::note_readings(const SampleBlock& block) {
  for (std::size_t p = 0; p < probes_.size(); ++p)
    if (rig_.probes[p].calibration.calibrated_um)
      for (const double reading_m : block.value[probes_[p]]) algo::widen(spans_[p], reading_m);
}

void FrameSolver::count_over_range(const SampleBlock& block) {
  if (block.quality.empty()) return;
  for (std::size_t i = 0; i < block.scans(); ++i) {
    over_range_ += std::any_of(probes_.begin(), probes_.end(), [&](std::size_t c) {
      return block.quality_at(c, i) == Quality::over_range;
    });
  }
}

bool FrameSolver::has_missing(const SampleBlock& block, std::size_t row) const {
  return std::any_of(probes_.begin(), probes_.end(),
                     [&](std::size_t c) { return block.quality_at(c, row) == Quality::missing; });
}

}  // namespace mdof::tools
