#include "daemon/output/controllers/siemens/siemens_steps.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::controllers {
namespace {

constexpr double kSameStep_m = 1e-9;
// Ratio of the largest change by resampling to the largest error.
constexpr double kPermittedChange = 0.01;

double value_at(const EqualSteps& e, const std::vector<double>& values, double at_m) {
  const double place =
      std::clamp((at_m - e.first_m) / e.step_m, 0.0, static_cast<double>(values.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), values.size() - 2);
  return values[i] + (values[i + 1] - values[i]) * (place - static_cast<double>(i));
}

// Resamples the errors of one approach to `steps` + 1 values. Updates e.loss_m.
std::vector<double> resampled(const Series& s, const std::vector<double>& approach,
                              std::size_t steps, EqualSteps& e) {
  Series one = s;
  one.forward = one.reverse = approach;
  std::vector<double> values;
  for (std::size_t i = 0; i <= steps; ++i)
    values.push_back(mean_error_at(one, e.first_m + static_cast<double>(i) * e.step_m));
  for (std::size_t i = 0; i < s.position_m.size(); ++i)
    e.loss_m = std::max(e.loss_m, std::abs(value_at(e, values, s.position_m[i]) - approach[i]));
  return values;
}

EqualSteps in_steps(const Series& s, std::size_t steps) {
  EqualSteps e;
  e.first_m = std::round(s.position_m.front() / kSameStep_m) * kSameStep_m;
  e.step_m = std::round((s.position_m.back() - s.position_m.front()) / static_cast<double>(steps) /
                        kSameStep_m) *
             kSameStep_m;
  e.forward = resampled(s, s.forward, steps, e);
  e.reverse = resampled(s, s.reverse, steps, e);
  return e;
}

}  // namespace

double largest_error_m(const Series& s) {
  double largest_m = 0;
  for (const auto* errors : {&s.forward, &s.reverse})
    for (const double error : *errors) largest_m = std::max(largest_m, std::abs(error));
  return largest_m;
}

std::size_t most_points(const ExportOptions& options) {
  return options.siemens_points > 0 ? options.siemens_points : kSiemensPointLimit;
}

Result<EqualSteps> equal_steps(const Series& s, const ExportOptions& options, Export& out) {
  const auto& x = s.position_m;
  if (x.size() < 2)
    return bad_input(s.error +
                     ": only one point, but a table of equal steps needs at least two points");
  const double range = x.back() - x.front();
  double smallest = range;
  for (std::size_t i = 1; i < x.size(); ++i) smallest = std::min(smallest, x[i] - x[i - 1]);
  const double wanted = std::max(
      1.0, std::min(std::round(range / smallest), static_cast<double>(most_points(options) - 1)));
  auto steps = static_cast<std::size_t>(wanted);
  EqualSteps e = in_steps(s, steps);
  const double permitted_m = std::max(kSameStep_m, kPermittedChange * largest_error_m(s));
  while (e.loss_m > permitted_m && steps + 1 < most_points(options)) {
    steps = std::min(2 * steps, most_points(options) - 1);
    if (EqualSteps finer = in_steps(s, steps); finer.loss_m < e.loss_m) e = std::move(finer);
  }
  if (e.loss_m > kSameStep_m)
    out.notes.push_back(
        s.error + ": " + std::to_string(x.size()) + " points were interpolated to a table of " +
        std::to_string(e.forward.size()) + " points at equal steps of " +
        plain_number(to_mm(e.step_m), 7) + " mm; this changes the values by up to " +
        plain_number(to_um(e.loss_m)) + " um");
  out.written.back().points = e.forward.size();
  out.written.back().largest_deviation = e.loss_m;
  return e;
}

ExportOptions without_tolerance(const ExportOptions& options, Export& out) {
  if (options.tolerance_m > 0)
    out.notes.emplace_back("tolerance_um has no effect, because the points are at equal steps");
  ExportOptions all_points = options;
  all_points.tolerance_m = 0;
  return all_points;
}

std::string siemens_axis(char axis) {
  return "AX" + std::to_string(axis - 'X' + 1);
}

}  // namespace mdof::controllers
