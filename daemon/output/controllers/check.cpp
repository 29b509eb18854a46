#include "daemon/output/controllers/check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "daemon/output/controllers/linuxcnc/ramp.h"
#include "daemon/output/controllers/series.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr int kTestIntervals = 4;  // number of test intervals between two points of the table
constexpr double kRounding_m = 1e-12;
// The nodes of a file have equal intervals, so its end can differ from the last measured position.
constexpr double kSameEnd_m = 1e-6;

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  const auto i = static_cast<std::size_t>(above - x.begin());
  return y[i - 1] + (y[i] - y[i - 1]) * ((at - x[i - 1]) / (x[i] - x[i - 1]));
}

// The simulated machine: the factors (+1 or -1) with which an error of the axis `along`, and a
// correction of the axis `command`, move the tool relative to the work. The factors follow from the
// bodies in the chain. The factor of the export is not used, because the test must detect errors in
// this factor.
struct Machine {
  double error = 1, command = 1;
  bool own = false;  // true: the correction moves the measured axis itself, and so changes the
                     // position at which the error acts
};

Machine machine_of(const CompensationTable& table, const AppliedCorrection& applied) {
  if (applied.along == applied.command) return {1, 1, true};
  const ChainAxis* measured = table.machine.find(applied.along);
  const ChainAxis* corrected = table.machine.find(applied.command);
  Machine machine;
  if (measured && measured->carries_work) machine.error = -1;
  if (corrected && corrected->carries_work) machine.command *= -1;
  if (corrected && corrected->against_command) machine.command *= -1;
  return machine;
}

// The data of one approach: the errors of the axis, and the corrections of the controller.
struct Approach {
  const std::vector<double>&error_at, &error, &added_at, &added;
};

double tool_error_with(const Machine& machine, const Approach& a, double x, double c) {
  const double at = machine.own ? x + c : x;
  return machine.error * interpolated(a.error_at, a.error, at) + machine.command * c;
}

double tool_error(const Machine& machine, const Approach& a, double x, double sign) {
  return tool_error_with(machine, a, x, sign * interpolated(a.added_at, a.added, x));
}

class Trial {
 public:
  Trial(const Series& series, const AppliedCorrection& applied, const Machine& machine, double zero)
      : series_(series), applied_(applied), machine_(machine), zero_(zero) {}

  // The largest error over all test points and both approaches. `sign`: 1: with the correction, 0:
  // without the correction, -1: with the wrong sign. `swapped`: with the correction of the other
  // approach. `one_way`: uses the mean error of both approaches.
  double residual(double sign, bool swapped, bool one_way) const {
    double largest = 0;
    for (const double x : places()) {
      const double f = at(x, sign, !swapped, true), r = at(x, sign, swapped, false);
      const double of_both = one_way ? std::abs(0.5 * (f + r)) : std::max(std::abs(f), std::abs(r));
      largest = std::max(largest, of_both);
    }
    return largest;
  }
  // The largest error while LinuxCNC does not apply a step of the correction. The axis reverses at
  // any test point and moves on. The old correction stays applied as long as the step to the new
  // correction has a size that the ramp does not apply.
  double largest_unapplied_error(const UnappliedSteps& held) const {
    const std::vector<double> x = places();
    double largest = 0;
    for (std::size_t turn = 0; turn < x.size(); ++turn)
      for (const bool forward : {true, false}) {
        const double kept = interpolated(applied_.position_m,
                                         forward ? applied_.reverse : applied_.forward, x[turn]);
        const Approach now = approach(forward, forward);
        for (std::size_t i = turn; i < x.size(); forward ? ++i : --i) {
          if (!held.holds(std::abs(interpolated(now.added_at, now.added, x[i]) - kept))) break;
          largest = std::max(largest, std::abs(tool_error_with(machine_, now, x[i], kept) +
                                               machine_.command * zero_));
        }
      }
    return largest;
  }
  // Whether at least one test point is inside the measured range and inside the range of the file.
  bool has_test_points() const { return !places().empty(); }
  // Largest |E dE/dx|, where E is the error at the position x. If the correction moves the measured
  // axis, the error acts at another position, and changes by about this value.
  double second_order() const {
    if (!machine_.own) return 0;
    double largest = 0, steepest = 0;
    for (const auto* y : {&series_.forward, &series_.reverse})
      for (std::size_t i = 1; i < y->size(); ++i) {
        steepest =
            std::max(steepest, std::abs(((*y)[i] - (*y)[i - 1]) /
                                        (series_.position_m[i] - series_.position_m[i - 1])));
        largest = std::max({largest, std::abs((*y)[i]), std::abs((*y)[i - 1])});
      }
    return (largest + std::abs(zero_)) * steepest;
  }

 private:
  double at(double x, double sign, bool added_forward, bool forward) const {
    return tool_error(machine_, approach(added_forward, forward), x, sign) +
           sign * machine_.command * zero_;
  }
  Approach approach(bool added_forward, bool forward) const {
    return {series_.position_m, forward ? series_.forward : series_.reverse, applied_.position_m,
            added_forward ? applied_.forward : applied_.reverse};
  }
  std::vector<double> places() const {
    std::vector<double> x;
    const double first = std::max(series_.position_m.front(), applied_.position_m.front());
    const double last = std::min(series_.position_m.back(), applied_.position_m.back());
    for (std::size_t i = 0; i + 1 < series_.position_m.size(); ++i)
      for (int k = 0; k <= kTestIntervals; ++k) {
        const double a = series_.position_m[i], b = series_.position_m[i + 1];
        const double place = a + (b - a) * k / kTestIntervals;
        if (place >= first - kRounding_m && place <= last + kRounding_m) x.push_back(place);
      }
    return x;
  }

  const Series& series_;
  const AppliedCorrection& applied_;
  Machine machine_;
  // Constant that was subtracted from the correction, so that the correction is 0 at home.
  double zero_;
};

Control control_of(const std::string& name, double residual, double bound, double change) {
  return {name, residual, residual > bound, change <= 2 * bound};
}

double largest_reversal(const Series& s) {
  double largest = 0;
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    largest = std::max(largest, std::abs(s.forward[i] - s.reverse[i]));
  return largest;
}

// The series without positions at which a value is missing; such positions are not exported.
Series without_missing(const Series& s) {
  Series whole = s;
  whole.position_m.clear();
  whole.forward.clear();
  whole.reverse.clear();
  for (std::size_t i = 0; i < s.position_m.size(); ++i) {
    if (!std::isfinite(s.forward[i]) || !std::isfinite(s.reverse[i])) continue;
    whole.position_m.push_back(s.position_m[i]);
    whole.forward.push_back(s.forward[i]);
    whole.reverse.push_back(s.reverse[i]);
  }
  return whole;
}

// The error of one approach at measured positions beyond the ends of the file. Adds to `largest`.
void add_outside(const Series& measured, const std::vector<double>& error,
                 const AppliedCorrection& applied, const std::vector<double>& added,
                 const Machine& machine, double zero, double& largest) {
  for (std::size_t i = 0; i < measured.position_m.size(); ++i) {
    const double x = measured.position_m[i];
    const bool inside =
        x >= applied.position_m.front() - kSameEnd_m && x <= applied.position_m.back() + kSameEnd_m;
    if (inside || !std::isfinite(error[i])) continue;
    const double c = interpolated(applied.position_m, added, x) + zero;
    largest = std::fmax(largest, std::abs(machine.error * error[i] + machine.command * c));
  }
}

// The correction at home, which was subtracted from all values in the file. This constant only
// shifts the zero of the machine and is no error. If home is outside the range of the file, the
// controller uses the value at the end of the file, and this function uses the same value.
double zero_of(const Series& s, const AppliedCorrection& applied, const ExportOptions& options) {
  const std::optional<double> home_m = options.home_m(applied.along);
  if (!home_m) return 0;
  const double held_m = std::clamp(*home_m, applied.position_m.front(), applied.position_m.back());
  return s.factor * mean_error_at(s, held_m);
}

double residual_limit(const ExportOptions& options) {
  return options.residual_m + options.tolerance_m;
}

CheckedError judged(const Format& format, const CompensationTable& table, const Series& measured,
                    const AppliedCorrection& applied, const Export& exported,
                    const ExportOptions& options) {
  const Series series = without_missing(measured);
  const Machine machine = machine_of(table, applied);
  const double zero = format.takes_home ? zero_of(series, applied, options) : 0;
  const Trial trial(series, applied, machine, zero);
  CheckedError e;
  add_outside(measured, measured.forward, applied, applied.forward, machine, zero, e.outside);
  add_outside(measured, measured.reverse, applied, applied.reverse, machine, zero, e.outside);
  e.error = applied.error;
  e.angle = series.angle;
  // True: the file has one value for both approaches, but the errors of the approaches differ.
  const bool one_value = applied.forward == applied.reverse && largest_reversal(series) > 0;
  e.one_way = one_value && options.one_approach;
  e.by_reversal = one_value ? 0.5 * largest_reversal(series) : 0;
  double thinning = 0;
  for (const Written& written : exported.written)
    if (written.error == e.error) thinning = written.largest_deviation;
  e.before = trial.residual(0, false, e.one_way);
  e.residual = trial.residual(1, false, e.one_way);
  for (const ExportOptions::Ramp& ramp : options.ramps)
    if (format.takes_joints && ramp.axis == applied.along)
      e.error_by_ramp =
          std::max(e.error_by_ramp, trial.largest_unapplied_error(unapplied_steps(ramp)));
  e.residual = std::max(e.residual, e.error_by_ramp);
  const double step = format.quantum_m + kRounding_m;
  e.nothing = e.before <= step;
  const double left = e.one_way ? 0 : e.by_reversal;
  e.bound = std::min(
      thinning + trial.second_order() + step + left + e.error_by_ramp,
      algo::ResidualLimits{residual_limit(options), options.residual_share}.of(e.before, step));
  // If all values are less than the resolution of the numbers in the file, all values are rounded
  // to 0 and nothing is corrected. This happens, for example, if values in mm are read as um.
  const bool lost = e.nothing && e.before > kRounding_m;
  e.cancels = trial.has_test_points() && e.residual <= e.bound && !lost;
  e.controls.push_back(
      control_of("wrong sign", trial.residual(-1, false, e.one_way), e.bound, 2 * e.before));
  // If the file has one value for both approaches, this mistake has no effect.
  e.controls.push_back(control_of("forward and reverse swapped", trial.residual(1, true, e.one_way),
                                  e.bound, one_value ? 0 : largest_reversal(series)));
  return e;
}

// The table that contains this error, with its series. {nullptr, empty}: no table.
std::pair<const CompensationTable*, std::optional<Series>> table_of(
    const std::vector<CompensationTable>& tables, const std::string& error) {
  for (const CompensationTable& table : tables) {
    const std::vector<Series> series = series_of(table);
    if (const Series* found = find_series(series, error)) return {&table, *found};
  }
  return {};
}

}  // namespace

bool Check::passed() const {
  if (errors.empty() && not_judged.empty()) return false;
  if (nothing_to_correct()) return false;
  return std::all_of(errors.begin(), errors.end(), [](const CheckedError& e) {
    return e.cancels && std::all_of(e.controls.begin(), e.controls.end(),
                                    [](const Control& c) { return c.detected || c.too_small; });
  });
}

bool Check::nothing_to_correct() const {
  return !errors.empty() &&
         std::all_of(errors.begin(), errors.end(), [](const CheckedError& e) { return e.nothing; });
}

Result<Check> check_export(const Format& format, const std::vector<CompensationTable>& tables,
                           const Export& exported, const ExportOptions& options) {
  MDOF_TRY(const auto applied, format.axes.read(exported.files));
  Check check;
  check.most_residual_m = residual_limit(options);
  check.share = options.residual_share;
  for (const AppliedCorrection& one : applied) {
    const auto [table, measured] = table_of(tables, one.error);
    if (!table)
      return fail(ErrorCode::check, "the files correct " + one.error +
                                        ", but no exported table contains " + one.error);
    check.errors.push_back(judged(format, *table, *measured, one, exported, options));
  }
  for (const Written& written : exported.written) {
    const bool there = std::any_of(check.errors.begin(), check.errors.end(),
                                   [&](const auto& e) { return e.error == written.error; });
    if (there) continue;
    const auto [table, series] = table_of(tables, written.error);
    if (table && series->factor != 0)
      return fail(ErrorCode::check,
                  written.error + " was exported, but the files do not contain " + written.error);
    check.not_judged.push_back(written.error);
  }
  return check;
}

}  // namespace mdof::controllers
