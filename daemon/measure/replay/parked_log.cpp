#include "daemon/measure/replay/parked_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/model/moving_body.h"
#include "algo/model/restate.h"
#include "algo/model/solver.h"
#include "algo/points/align.h"
#include "daemon/measure/points/point_solver.h"
#include "drivers/calibration.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

constexpr double kShortStep_s = 0.1, kWindowsOfLog = 12;
// If the mean positions of two time steps differ by more than this, the axis moved.
constexpr double kMostTravel_m = 50e-6;
constexpr std::chrono::milliseconds kParkedTimeout{1000};

// Sums of the values of a channel over short time steps.
class Steps {
 public:
  void take(std::int64_t since_ns, double x) {
    if (!std::isfinite(x) || since_ns < 0) return;
    const auto step = static_cast<std::size_t>(ns_to_s(since_ns) / kShortStep_s);
    if (step >= sum_.size()) {
      sum_.resize(step + 1);
      n_.resize(step + 1);
    }
    sum_[step] += x;
    n_[step] += 1;
  }
  std::size_t size() const { return sum_.size(); }
  // Means of groups of `together` steps. NaN if a group has no readings.
  std::vector<double> means(std::size_t together, std::size_t count) const {
    std::vector<double> out;
    for (std::size_t k = 0; k < count; ++k) {
      double sum = 0, n = 0;
      for (std::size_t i = k * together; i < (k + 1) * together && i < sum_.size(); ++i) {
        sum += sum_[i];
        n += n_[i];
      }
      out.push_back(n > 0 ? sum / n : kNaN);
    }
    return out;
  }

 private:
  std::vector<double> sum_, n_;
};

class ParkedReader {
 public:
  ParkedReader(const Rig& rig, const algo::AlignOptions& align, std::vector<std::string> ids)
      : calibrator_(rig), aligner_(align, std::move(ids)), probes_(rig.probes.size()) {}

  Status read(ReplayLog& log, const ProgressCallback& progress) {
    SampleBlock block;
    for (;;) {
      MDOF_TRY(const auto state, log.driver().read(block, kParkedTimeout));
      if (block.scans() > 0) MDOF_CHECK(push(block));
      if (progress && !progress(log.progress()))
        return io_error(log.path() + ": the analysis was cancelled before the end of the log");
      if (state != drivers::ReadState::end) continue;
      aligner_.flush(frames_);
      take_frames();
      return {};
    }
  }

  Steps encoder, temperature;
  const std::vector<Steps>& probes() const { return probes_; }

 private:
  Status push(SampleBlock& block) {
    if (!begin_ns_) begin_ns_ = block.time_ns.front();
    const auto at = std::find(block.channels.begin(), block.channels.end(),
                              Channel{"temperature", Unit::deg_c});
    if (at != block.channels.end()) {
      const auto& values = block.value[static_cast<std::size_t>(at - block.channels.begin())];
      for (std::size_t i = 0; i < values.size(); ++i)
        temperature.take(block.time_ns[i] - *begin_ns_, values[i]);
    }
    MDOF_CHECK(calibrator_.apply(block));
    MDOF_CHECK(aligner_.push(block, frames_));
    take_frames();
    return {};
  }

  void take_frames() {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const std::int64_t since_ns = frames_.time_ns[i] - *begin_ns_;
      encoder.take(since_ns, frames_.encoder_m[i]);
      for (std::size_t k = 0; k < probes_.size(); ++k)
        if (usable(frames_.quality_at(k, i))) probes_[k].take(since_ns, frames_.probe_m[k][i]);
    }
    frames_.time_ns.clear();
  }

  drivers::Calibrator calibrator_;
  algo::Aligner aligner_;
  std::vector<Steps> probes_;
  FrameBlock frames_;
  std::optional<std::int64_t> begin_ns_;
};

Result<Rig> rig_of(const ParkedRequest& request, const ReplayLog& log) {
  if (!request.rig_source.empty()) return parse_rig(request.rig_text, request.rig_source);
  const std::string text = log.rig_text();
  if (!text.empty()) return parse_rig(text, request.log + " (its rig)");
  return fail(ErrorCode::usage, request.log + ": a CSV log contains no rig", Remedy::give_rig);
}

Status check_parked(const std::string& path, const std::vector<double>& encoder_m) {
  double low = 0, high = 0;
  bool any = false;
  for (const double x : encoder_m) {
    if (std::isnan(x)) continue;
    low = any ? std::min(low, x) : x;
    high = any ? std::max(high, x) : x;
    any = true;
  }
  if (!any) return bad_input(path + ": no scan has an encoder position");
  if (high - low <= kMostTravel_m) return {};
  return bad_input(path + ": the axis moved from " + plain_number(to_mm(low), 7) + " to " +
                       plain_number(to_mm(high), 7) +
                       " mm, but a warm-up test needs an axis that stands still",
                   Remedy::park_axis);
}

// Calculates the five errors of the moving body at each time step.
void add_errors(const algo::Solver& solver, const Rig& rig, const std::vector<double>& encoder_m,
                algo::ParkedReadings& readings) {
  const std::size_t probes = readings.series.size();
  std::vector<std::vector<double>> named(kErrorCount);
  for (std::size_t i = 0; i < encoder_m.size(); ++i) {
    std::vector<double> probe_m;
    for (std::size_t k = 0; k < probes; ++k) probe_m.push_back(readings.series[k].value[i]);
    const double travel_m = rig.sides.target_travel_m(encoder_m[i]);
    AxisErrors errors;
    if (!std::isnan(travel_m)) errors = solver.solve(travel_m, probe_m, {});
    if (errors.valid)
      errors = algo::restate(algo::errors_of_moving_body(errors, solver.model(), rig.moving()),
                             solver.model(), rig.moving(), travel_m, kAtCarriage, kAtFixture);
    const Errors5 here = named_from_local(rig.moving(), errors.local);
    for (std::size_t k = 0; k < kErrorCount; ++k) named[k].push_back(errors.valid ? here[k] : kNaN);
  }
  for (std::size_t k = 0; k < kErrorCount; ++k)
    readings.series.push_back({error_names(rig.axis)[k].key, std::move(named[k])});
}

void set_limits(const ParkedRequest& request, const Rig& rig, ParkedLog& parked) {
  parked.limit_m_per_s = request.limit_m_per_s ? request.limit_m_per_s : rig.drift_limit_m_per_s;
  for (std::size_t s = 0; s < parked.readings.series.size(); ++s) {
    const bool angle = s >= parked.probes && error_names(rig.axis)[s - parked.probes].angle;
    const auto& limit = angle ? request.angle_limit_rad_per_s : parked.limit_m_per_s;
    if (limit) parked.readings.series[s].limit_per_s = *limit;
  }
}

}  // namespace

Result<ParkedLog> read_parked_log(const ParkedRequest& request, const ProgressCallback& progress) {
  MDOF_TRY(ReplayLog log, ReplayLog::open(request.log));
  MDOF_TRY(const Rig rig, rig_of(request, log));
  MDOF_CHECK(check_axis(log.path(), log.comments(), rig));
  MDOF_CHECK(check_channels(log.path(), log.driver().info().channels, rig));
  MDOF_TRY(const RecordedRequest asked, log.asked_for());
  MDOF_TRY(const algo::Solver solver, algo::Solver::create(rig, asked.options.model));
  ParkedReader reader(rig, asked.options.align, probe_ids(rig));
  MDOF_CHECK(reader.read(log, progress));
  ParkedLog parked;
  parked.axis = rig.axis;
  parked.declares = rig.declares_uncertainty();
  parked.simulated = log.driver().info().simulated;
  parked.length_s = static_cast<double>(reader.encoder.size()) * kShortStep_s;
  parked.notices = log.notices();
  const double per_step =
      request.window_s.value_or(parked.length_s / kWindowsOfLog) / algo::kStepsOfWindow;
  // The number of steps is rounded down, so that a log contains twelve windows of a twelfth of its
  // length. If one step is longer than the log, the upper limit of std::clamp gives `steps` = 0. A
  // log that is shorter than one window is rejected.
  const auto together =
      static_cast<std::size_t>(std::clamp(std::floor(per_step / kShortStep_s + 1e-9), 1.0,
                                          static_cast<double>(reader.encoder.size() + 1)));
  const std::size_t steps = reader.encoder.size() / together;
  if (steps < algo::kStepsOfWindow)
    return bad_input(log.path() + ": the log lasts " + plain_number(parked.length_s) +
                         " s, but a time window needs at least " +
                         plain_number(std::max(per_step, kShortStep_s) *
                                      static_cast<double>(algo::kStepsOfWindow)) +
                         " s",
                     Remedy::record_longer);
  parked.readings.step_s = static_cast<double>(together) * kShortStep_s;
  const auto encoder_m = reader.encoder.means(together, steps);
  MDOF_CHECK(check_parked(log.path(), encoder_m));
  double n = 0;
  for (const double x : encoder_m)
    if (!std::isnan(x)) parked.position_m += (x - parked.position_m) / ++n;
  for (std::size_t k = 0; k < rig.probes.size(); ++k)
    parked.readings.series.push_back(
        {rig.probes[k].id + "_um", reader.probes()[k].means(together, steps)});
  parked.probes = rig.probes.size();
  if (reader.temperature.size() > 0)
    parked.readings.temperature_C = reader.temperature.means(together, steps);
  add_errors(solver, rig, encoder_m, parked.readings);
  set_limits(request, rig, parked);
  return parked;
}

}  // namespace mdof::daemon
