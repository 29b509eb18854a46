#include "daemon/measure/machine/table_functions.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "algo/compensation/between_targets.h"
#include "algo/machine/frames.h"
#include "schema/base/number/number_text.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::daemon {

ErrorFunction error_function(const std::vector<double>& position,
                             const std::vector<double>& forward, const std::vector<double>& reverse,
                             const std::vector<double>& u, const std::vector<double>& u_noise) {
  ErrorFunction f;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const bool has_forward = std::isfinite(forward[i]), has_reverse = std::isfinite(reverse[i]);
    if (!has_forward && !has_reverse) continue;
    f.position.push_back(position[i]);
    f.forward.push_back(has_forward ? forward[i] : reverse[i]);
    f.reverse.push_back(has_reverse ? reverse[i] : forward[i]);
    f.u.push_back(u[i]);
    f.u_independent.push_back(std::isfinite(u_noise[i]) ? u_noise[i] : 0);
  }
  double largest = kNaN;
  for (const double each : f.u) largest = std::fmax(largest, each);
  if (!std::isfinite(largest)) {
    f.u.clear();
    f.u_independent.clear();
  }
  for (double& each : f.u)
    if (!std::isfinite(each)) each = largest;
  add_curvature(f);
  return f;
}

void add_curvature(ErrorFunction& f) {
  if (f.u.empty() || f.position.size() < 3 || !f.curvature.empty()) return;
  std::vector<double> noise = f.u_independent;
  noise.resize(f.position.size());
  f.curvature = algo::curvatures(f.position, f.forward, noise);
  if (!f.reverse.empty())
    f.curvature = larger(f.curvature, algo::curvatures(f.position, f.reverse, noise));
}

void add_curvatures(Machine& machine) {
  for (MachineFrame& frame : machine.frames)
    for (ErrorFunction& error : frame.error) add_curvature(error);
}

void set_angle_zero_at(ErrorFunction& f, double zero_m) {
  if (f.position.empty() || zero_m <= f.position.front()) return;
  const algo::TablePlace zero = algo::place_of(f.position, zero_m);
  const double mean = (algo::value_at(f.forward, zero) + algo::value_at(f.reverse, zero)) / 2;
  for (auto* values : {&f.forward, &f.reverse})
    for (double& x : *values) x -= mean;
}

void bound_angle_u(ErrorFunction& f, double zero_m) {
  if (f.u.empty() || zero_m <= f.position.front()) return;
  const double there = algo::value_at(f.u, algo::place_of(f.position, zero_m));
  for (double& u : f.u) u += there;
}

std::vector<double> larger(const std::vector<double>& forward, const std::vector<double>& reverse) {
  std::vector<double> u = forward;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = std::fmax(u[i], reverse[i]);
  return u;
}

std::vector<double> scaled(std::vector<double> values, double by) {
  for (double& x : values) x *= by;
  return values;
}

std::size_t body_error_index(const CompensationTable& table, std::size_t named) {
  return std::string_view("XYZABC").find(error_names(table.axis)[named].name[1]);
}

namespace {

std::array<std::size_t, kErrorCount> body_error_indices(const CompensationTable& table) {
  std::array<std::size_t, kErrorCount> of{};
  for (std::size_t named = 0; named < kErrorCount; ++named)
    of[named] = body_error_index(table, named);
  return of;
}

// Whether at_m is more than one interval before the first or after the last position. The interval
// is the interval of the two positions at this end.
bool is_far_outside(const std::vector<double>& position_m, double at_m) {
  const std::size_t n = position_m.size();
  return n > 1 && (at_m < 2 * position_m[0] - position_m[1] ||
                   at_m > 2 * position_m[n - 1] - position_m[n - 2]);
}

}  // namespace

void set_covariance(MachineFrame& frame, const CompensationTable& table,
                    const algo::ErrorCovariances& covariances) {
  const auto of = body_error_indices(table);
  ErrorCovariance& all = frame.covariance;
  all.position = table.position_m;
  const auto body = [&](const Covariance5& named) {
    Covariance6 at{};
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l)
        if (all.has[of[k]] && all.has[of[l]]) at[of[k]][of[l]] = named[k * kErrorCount + l];
    return at;
  };
  for (const std::size_t k : of) all.has[k] = !frame.error[k].u.empty();
  for (std::size_t row = 0; row < all.position.size(); ++row) {
    all.noise.push_back(body(covariances.noise[row]));
    all.declared.push_back(
        body(covariances.declared.empty() ? Covariance5{} : covariances.declared[row]));
  }
  for (const std::size_t k : of) {
    ErrorFunction& f = frame.error[k];
    std::size_t row = 0;
    for (std::size_t i = 0; all.has[k] && i < f.position.size(); ++i) {
      // An error may have fewer positions than the table.
      while (all.position[row] < f.position[i]) ++row;
      f.u_independent[i] = std::sqrt(all.noise[row][k][k]);
      f.u[i] = std::sqrt(all.noise[row][k][k] + all.declared[row][k][k]);
    }
  }
}

void add_shared(MachineFrame& frame, const CompensationTable& table, const std::string& name,
                const std::vector<Errors5>& by_row) {
  const auto of = body_error_indices(table);
  ErrorCovariance& all = frame.covariance;
  SharedPart& shared = all.shared.emplace_back();
  shared.name = name;
  for (std::size_t row = 0; row < by_row.size(); ++row) {
    auto& at = shared.at.emplace_back();
    for (std::size_t k = 0; k < kErrorCount; ++k)
      if (all.has[of[k]]) at[of[k]] = by_row[row][k];
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      for (std::size_t l = 0; l < kBodyErrors; ++l) all.declared[row][k][l] -= at[k] * at[l];
    for (std::size_t k = 0; k < kBodyErrors; ++k)  // rounding errors can make a variance negative
      all.declared[row][k][k] = std::fmax(all.declared[row][k][k], 0);
  }
}

Status check_angles_zero(const MachineFrame& frame, const std::vector<double>& position_m,
                         Notices& doubtful) {
  const double zero_m = frame.angles_zero_m.value_or(0);
  if (!is_far_outside(position_m, zero_m)) return {};
  const double first_mm = to_mm(position_m.front()), last_mm = to_mm(position_m.back());
  if (frame.angles_zero_m)
    return bad_input("axis " + frame.id +
                     " of the machine: angles_zero_at_mm = " + plain_number(to_mm(zero_m), 6) +
                     " is outside the range of the measured errors (" + plain_number(first_mm, 6) +
                     " to " + plain_number(last_mm, 6) +
                     " mm); give the position at which this axis stood while the other axes were "
                     "measured. This position must be inside the range");
  doubtful.push_back(notice(NoticeCode::angles_zero_assumed, frame.id,
                            {{"first_mm", first_mm}, {"last_mm", last_mm}}));
  return {};
}

}  // namespace mdof::daemon
