#include "algo/separation/separate.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "algo/linear_algebra/least_squares.h"
#include "algo/linear_algebra/spectra.h"
#include "algo/separation/grid.h"
#include "algo/separation/request_check.h"
#include "algo/separation/shared_readings.h"
#include "algo/separation/unseen.h"
#include "algo/uncertainty/coverage.h"
#include "schema/base/number/number_text.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/chi_square_limit.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kMostUnknowns = 1000;  // the solution then takes some seconds
// Limit for singular values. The coefficients are about 1 and the places are on an exact grid.
// Therefore singular values of undetermined shapes are only rounding, and singular values of
// determined shapes are much larger than this limit.
constexpr double kSeenAbove = 1e-9;

Index in(std::size_t i) {
  return static_cast<Index>(i);
}

// The equations A x = errors. Columns of A: places of the machine, places of the target, then
// offset and slope of each set-up.
struct Equations {
  Grid grid;
  MatrixXd A;
  VectorXd errors, u;  // error and u of each reading; u: NaN if unknown
  MatrixXd declared;   // [reading][quantity]: change of each reading by one standard uncertainty
  Index machine() const { return in(grid.position_m.size()); }
  Index target() const { return in(grid.place_m.size()); }
};

bool has_u_for_all_readings(const SeparationRequest& request) {
  return std::all_of(request.set_ups.begin(), request.set_ups.end(), [](const SetUp& s) {
    return s.u_m.size() == s.position_m.size() &&
           std::all_of(s.u_m.begin(), s.u_m.end(), [](double u) { return u > 0; });
  });
}

MatrixXd declared_columns(const std::vector<SetUp>& set_ups, Index readings) {
  std::vector<VectorXd> columns;
  std::map<std::string, std::size_t> shared;
  Index row = 0;
  for (const SetUp& set_up : set_ups) {
    for (const DeclaredShift& declared : set_up.declared) {
      std::size_t column = columns.size();
      if (!declared.common_as.empty())
        column = shared.try_emplace(declared.common_as, column).first->second;
      if (column == columns.size()) columns.emplace_back(VectorXd::Zero(readings));
      for (std::size_t i = 0; i < declared.shift_m.size(); ++i)
        columns[column](row + in(i)) += declared.shift_m[i];
    }
    row += in(set_up.position_m.size());
  }
  MatrixXd all(readings, in(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) all.col(in(c)) = columns[c];
  return all;
}

Equations equations_of(const SeparationRequest& request, Grid grid) {
  Equations e;
  e.grid = std::move(grid);
  const Index readings = in(e.grid.at_position.size()), clamps = in(2 * request.set_ups.size());
  e.A = MatrixXd::Zero(readings, e.machine() + e.target() + clamps);
  e.errors.resize(readings);
  e.u.setConstant(readings, std::numeric_limits<double>::quiet_NaN());
  const double first = e.grid.position_m.front(), last = e.grid.position_m.back();
  const bool with_u = has_u_for_all_readings(request);
  Index row = 0, clamp = e.machine() + e.target();
  for (const SetUp& set_up : request.set_ups) {
    for (std::size_t i = 0; i < set_up.position_m.size(); ++i, ++row) {
      const std::size_t at = e.grid.at_position[static_cast<std::size_t>(row)];
      e.A(row, in(at)) = 1;
      e.A(row, e.machine() + in(e.grid.at_place[static_cast<std::size_t>(row)])) =
          request.at.sides.error_sign() * set_up.turn.height_sign;
      e.A(row, clamp) = 1;
      e.A(row, clamp + 1) = (2 * e.grid.position_m[at] - first - last) / (last - first);
      e.errors(row) = set_up.error_m[i];
      if (with_u) e.u(row) = set_up.u_m[i];
    }
    clamp += 2;
  }
  e.declared = declared_columns(request.set_ups, readings);
  return e;
}

// Square roots of the weights of the readings. All weights are equal if u is unknown. Otherwise the
// largest weight is at most 1e6 times the smallest weight.
VectorXd root_weights(const VectorXd& u) {
  if (!u.allFinite()) return VectorXd::Ones(u.size());
  return (u.minCoeff() / u.array()).max(1e-3);
}

struct Solution {
  MatrixXd from_readings;  // unknowns = from_readings * readings
  MatrixXd null;  // orthonormal columns: combinations of unknowns that no reading determines
  Index rank = 0;
};

Solution solve(const Equations& e) {
  const VectorXd w = root_weights(e.u);
  const LeastNorm fit(w.asDiagonal() * e.A, kSeenAbove);
  return {fit.inverse() * w.asDiagonal(), fit.null_space(), fit.rank()};
}

// Orthonormal basis of the undetermined shapes of `count` unknowns, from the unknown `from` on.
MatrixXd unseen_part(const MatrixXd& null, Index from, Index count) {
  constexpr double kLeast = 1e-7;
  if (null.cols() == 0) return MatrixXd(count, 0);
  const SingularValues svd = singular_values(null.middleRows(from, count));
  const auto rank = (svd.values.array() > kLeast).count();
  return svd.U.leftCols(rank);
}

// u of each reading, with its degrees of freedom, from which u of the results is calculated.
struct ReadingUncertainty {
  VectorXd u;
  double freedom = std::numeric_limits<double>::infinity();
};

DeterminedSeries seen_part(const Equations& e, const Solution& solution, Index from,
                           const std::vector<double>& places_m, const ReadingUncertainty& reading,
                           const std::vector<double>& periods_m) {
  const Index count = in(places_m.size());
  const MatrixXd unseen = unseen_part(solution.null, from, count);
  const MatrixXd all = solution.from_readings.middleRows(from, count);
  const MatrixXd from_readings = all - unseen * (unseen.transpose() * all);
  const VectorXd seen = from_readings * e.errors;
  const VectorXd scatter = (from_readings * reading.u.asDiagonal()).rowwise().squaredNorm();
  const VectorXd square = scatter + (from_readings * e.declared).rowwise().squaredNorm();
  const VectorXd u = square.cwiseSqrt();
  DeterminedSeries series;
  series.place_m = places_m;
  series.seen_m.assign(seen.begin(), seen.end());
  series.u_m.assign(u.begin(), u.end());
  for (Index i = 0; i < count; ++i) {
    const double freedom =
        effective_freedom(square(i), fourth_over_freedom(scatter(i), reading.freedom));
    series.freedom.push_back(std::isfinite(u(i)) ? freedom : std::nan(""));
    series.k.push_back(std::isfinite(u(i)) ? coverage_factor(freedom) : std::nan(""));
  }
  series.unseen = named_shapes(places_m, unseen, periods_m);
  return series;
}

// χ² of all set-ups: the minimum over x and q of |(errors - A x - declared q)/u|² + |q|². q are the
// declared quantities, each with the standard uncertainty 1. `left`: residuals of the errors after
// the weighted fit. The columns of `declared` are replaced by their residuals in the same way. Then
// only q is unknown.
double chi_square_of(const Equations& e, const Solution& solution, const VectorXd& left) {
  const VectorXd weight = e.u.cwiseInverse();
  const VectorXd misfit = weight.asDiagonal() * left;
  if (e.declared.cols() == 0) return misfit.squaredNorm();
  const MatrixXd declared =
      weight.asDiagonal() * (e.declared - e.A * (solution.from_readings * e.declared));
  const MatrixXd normal =
      MatrixXd::Identity(declared.cols(), declared.cols()) + declared.transpose() * declared;
  const VectorXd moved = declared.transpose() * misfit;
  return misfit.squaredNorm() - moved.dot(LeastSquares(normal).solve(moved));
}

// χ² test of the readings without any shape of the target.
bool agrees_without_target(Equations e) {
  e.A.middleCols(e.machine(), e.target()).setZero();
  const Solution solution = solve(e);
  const VectorXd left = e.errors - e.A * (solution.from_readings * e.errors);
  const auto freedom = static_cast<int>(e.A.rows() - solution.rank);
  return freedom > 0 && chi_square_of(e, solution, left) <= chi_square_limit(freedom);
}

std::string declared_text(const Separation& result, const Equations& e) {
  if (e.declared.cols() > 0) return " and the declared uncertainties";
  return result.noise_only
             ? std::string(" (noise and repeatability only: ") + kNothingDeclared + ")"
             : "";
}

ReadingUncertainty judge(const Equations& e, const Solution& solution, Separation& result) {
  const VectorXd left = e.errors - e.A * (solution.from_readings * e.errors);
  const std::size_t freedom = result.freedom();
  if (freedom > 0) result.residual_m = std::sqrt(left.squaredNorm() / static_cast<double>(freedom));
  if (e.u.allFinite()) {
    result.u_reason = "the propagated u of the readings" + declared_text(result, e);
    const double chi_square = chi_square_of(e, solution, left);
    if (freedom > 0 && chi_square > chi_square_limit(static_cast<int>(freedom)))
      result.notices.push_back(notice(NoticeCode::set_ups_contradict, "",
                                      {{"chi_square", chi_square}, {"freedom", freedom}}));
    else if (agrees_without_target(e))
      result.notices.push_back(notice(NoticeCode::target_shows_no_shape));
    return {e.u};
  }
  result.u_reason =
      freedom > 0
          ? "the scatter about the fit (" + std::to_string(freedom) + " degrees of freedom)" +
                declared_text(result, e) +
                "; the u of the readings is not used, because not every reading has a u above 0"
          : "unknown: not every reading has a u above 0, and the fit has no degrees of freedom, so "
            "it cannot estimate u; give the standard uncertainty of the readings (u_um)";
  return {VectorXd::Constant(e.u.size(), result.residual_m), static_cast<double>(freedom)};
}

// Distances after which a shape must repeat so that the set-ups cannot determine it. Two set-ups
// with the same height sign hide a shape that repeats after the shift between them. If all shifted
// set-ups have opposite height signs, they hide a shape that changes its sign after the shift. Such
// a shape repeats after twice the shift.
std::vector<double> hidden_shifts(const std::vector<SetUp>& set_ups, double step_m) {
  std::vector<double> alike, turned;
  for (const SetUp& a : set_ups)
    for (const SetUp& b : set_ups) {
      if (a.turn.end_for_end || b.turn.end_for_end || !(step_m > 0)) continue;
      const double shift_m = std::round((a.shift_m - b.shift_m) / step_m) * step_m;
      (a.turn.height_sign == b.turn.height_sign ? alike : turned).push_back(shift_m);
    }
  if (std::any_of(alike.begin(), alike.end(), [](double s) { return s != 0; })) return alike;
  for (double& s : turned) s *= 2;
  return turned;
}

}  // namespace

Result<Separation> separate(const SeparationRequest& given) {
  MDOF_CHECK(check_request(given));
  MDOF_TRY(Grid grid, grid_of(given.at, given.set_ups, given.match_m));
  MDOF_CHECK(check_shared(grid, given.set_ups));
  MDOF_TRY(SharedReadings shared, shared_readings(given.set_ups, std::move(grid)));
  SeparationRequest request = given;
  request.set_ups = std::move(shared.set_ups);
  const Equations e = equations_of(request, std::move(shared.grid));
  if (e.A.cols() > in(kMostUnknowns))
    return bad_input("these set-ups have " + std::to_string(e.A.cols()) +
                     " unknowns, but at most " + std::to_string(kMostUnknowns) +
                     " can be calculated at once; leave some set-ups out");
  const Solution solution = solve(e);
  Separation result;
  result.set_ups = request.set_ups.size();
  result.readings = static_cast<std::size_t>(e.A.rows());
  result.unknowns = static_cast<std::size_t>(e.A.cols());
  result.rank = static_cast<std::size_t>(solution.rank);
  result.notices = std::move(shared.notices);
  result.noise_only = request.u_is_noise && e.declared.cols() == 0;
  const ReadingUncertainty u = judge(e, solution, result);
  const auto periods =
      hidden_periods(hidden_shifts(request.set_ups, e.grid.step_m), e.grid.step_m, request.match_m);
  result.machine = seen_part(e, solution, 0, e.grid.position_m, u, periods);
  result.target = seen_part(e, solution, e.machine(), e.grid.place_m, u, periods);
  return result;
}

}  // namespace mdof::algo
