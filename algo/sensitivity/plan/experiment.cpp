#include "algo/sensitivity/plan/experiment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "algo/iso230/line_fit.h"
#include "algo/sensitivity/plan/axis.h"
#include "algo/sensitivity/plan/experiment_base.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kChunk = 128;  // number of trials in one step; their columns stay in the
                                     // cache

// The named error of one reading, in SI. `local`: estimated or true errors.
double named_at(const std::vector<double>& local, const AxisReadings& r, const ErrorName& name,
                std::size_t reading, std::size_t j) {
  return name.sign * local[r.at(reading, static_cast<std::size_t>(name.local)) + j];
}

// The named error at the origin of M (fixture) instead of the carriage, to first order in the
// angles: (δy - d εz, δz + d εy) at the travel d.
double named_at_fixture(const std::vector<double>& local, const AxisReadings& r,
                        const ErrorName& name, std::size_t reading, std::size_t j,
                        double travel_m) {
  const double at_carriage = named_at(local, r, name, reading, j);
  if (name.angle) return at_carriage;
  const bool across = name.local == kDy;
  const double turned = travel_m * local[r.at(reading, across ? kEz : kEy) + j];
  return at_carriage + name.sign * (across ? -turned : turned);
}

// Estimated and true values of one error at all positions, at the origin of M. Lines are fitted to
// these values.
struct Series {
  std::vector<double> shown_m, found, travel_m, truth;

  void take(const AxisReadings& r, const ErrorName& name, std::size_t positions, std::size_t j) {
    for (auto* column : {&shown_m, &found, &travel_m, &truth}) column->clear();
    for (std::size_t k = 1; k <= positions; ++k) {
      shown_m.push_back(r.encoder_m[k * r.n + j]);
      found.push_back(named_at_fixture(r.estimate, r, name, k, j, shown_m.back()));
      travel_m.push_back(r.travel_m[k * r.n + j]);
      truth.push_back(named_at_fixture(r.truth, r, name, k, j, travel_m.back()));
    }
  }
  bool solved() const {
    return can_fit(shown_m) &&
           std::all_of(found.begin(), found.end(), [](double x) { return std::isfinite(x); });
  }
};

using LineThrough = Line (*)(std::span<const double>, std::span<const double>);

double straightness_error(const Series& s, LineThrough line) {
  const auto figure = [&](const std::vector<double>& x, const std::vector<double>& y) {
    return deviations_from(line(x, y), x, y).peak_to_valley;
  };
  return figure(s.shown_m, s.found) - figure(s.travel_m, s.truth);
}

double slope_error(const Series& s) {
  return least_squares_line(s.shown_m, s.found).slope -
         least_squares_line(s.travel_m, s.truth).slope;
}

class PlanExperiment final : public PlanExperimentBase {
 public:
  static Result<std::unique_ptr<ScalableExperiment>> create(const StudyPlan& plan, const Rig& rig);
  std::vector<std::pair<std::string, double>> inputs(std::uint64_t trial) const override;

 private:
  explicit PlanExperiment(const StudyPlan& plan)
      : PlanExperimentBase(plan), planned_(plan.outputs) {}
  void run_all(const DrawRequest& request, std::span<double* const> out) const override;
  void run_chunk(const DrawRequest& request, std::span<double* const> out) const;
  double value(const PlannedOutput& output, const AxisReadings& x, const AxisReadings& y,
               std::size_t j, Series& series) const;
  double squareness_error(const AxisReadings& x, const AxisReadings& y, std::size_t j,
                          Series& series) const;

  std::vector<PlannedOutput> planned_;
  std::optional<PlanAxis> x_, y_;
};

Result<std::unique_ptr<ScalableExperiment>> PlanExperiment::create(const StudyPlan& plan,
                                                                   const Rig& rig) {
  if (plan.whole_run)
    return bad_input(plan.source +
                     ": output_of = \"run\" needs a simulation of whole runs, but the study "
                     "simulates single points");
  std::unique_ptr<PlanExperiment> e(new PlanExperiment(plan));
  const auto asks = [&](auto... kinds) {
    return std::any_of(plan.outputs.begin(), plan.outputs.end(),
                       [&](const PlannedOutput& o) { return ((o.kind == kinds) || ...); });
  };
  const bool series =
      asks(OutputKind::straightness, OutputKind::straightness_ends, OutputKind::squareness);
  MDOF_TRY(e->x_, PlanAxis::create(plan, rig, "", asks(OutputKind::error), series, e->causes_));
  std::vector<const PlanDraws*> draws = {&e->x_->draws()};
  if (asks(OutputKind::squareness)) {
    MDOF_TRY(e->y_, PlanAxis::create(plan, *plan.rig_y, "Y:", false, true, e->causes_));
    draws.push_back(&e->y_->draws());
  }
  if (auto distinct = check_hashes(draws); !distinct)
    return in_context(plan.source, distinct.error());
  return std::unique_ptr<ScalableExperiment>(std::move(e));
}

// The error of EC0Y = -slope(EXY) - slope(EYX) + corner * artefact (schema/iso230/squareness.h),
// with corner = -1: the fixture is turned from X to Y with the axis. The slopes are measured
// relative to the true artefact, and EC0Y is corrected by the stated angle. Therefore the error of
// the stated angle is added to the error of EC0Y.
double PlanExperiment::squareness_error(const AxisReadings& x, const AxisReadings& y, std::size_t j,
                                        Series& series) const {
  double error = x.square_rad[j];
  for (const auto& [axis, readings] : {std::pair{&*x_, &x}, std::pair{&*y_, &y}}) {
    series.take(*readings, error_names(axis->axis())[0], axis->positions(), j);
    if (!series.solved()) return kNotSolved;
    error -= slope_error(series);
  }
  return error;
}

double PlanExperiment::value(const PlannedOutput& output, const AxisReadings& x,
                             const AxisReadings& y, std::size_t j, Series& series) const {
  const ErrorName& name = error_names(x_->axis())[output.error];
  if (output.kind == OutputKind::error)
    return to_key_unit(named_at(x.estimate, x, name, 0, j) - named_at(x.truth, x, name, 0, j));
  if (output.kind == OutputKind::squareness) return to_key_unit(squareness_error(x, y, j, series));
  series.take(x, name, x_->positions(), j);
  if (!series.solved()) return kNotSolved;
  const bool ends = output.kind == OutputKind::straightness_ends;
  return to_key_unit(straightness_error(series, ends ? end_point_line : least_squares_line));
}

void PlanExperiment::run_chunk(const DrawRequest& request, std::span<double* const> out) const {
  AxisReadings x, y;
  x_->run(request, x);
  if (y_) y_->run(request, y);
  Series series;
  for (std::size_t k = 0; k < planned_.size(); ++k) {
    for (std::size_t j = 0; j < request.n; ++j) out[k][j] = value(planned_[k], x, y, j, series);
  }
  // If one output has no solution, the trial has no solution.
  for (std::size_t j = 0; j < request.n; ++j) {
    const bool solved =
        std::all_of(out.begin(), out.end(), [&](const double* o) { return std::isfinite(o[j]); });
    if (solved) continue;
    for (double* o : out) o[j] = kNotSolved;
  }
}

void PlanExperiment::run_all(const DrawRequest& request, std::span<double* const> out) const {
  std::vector<double*> part(out.begin(), out.end());
  DrawRequest chunk = request;
  for (std::size_t done = 0; done < request.n; done += chunk.n) {
    chunk.first = request.first + request.step * done;
    chunk.n = std::min(kChunk, request.n - done);
    run_chunk(chunk, part);
    for (double*& p : part) p += chunk.n;
  }
}

std::vector<std::pair<std::string, double>> PlanExperiment::inputs(std::uint64_t trial) const {
  auto all = drawn_inputs(x_->draws(), trial, "");
  if (!y_) return all;
  const auto second = drawn_inputs(y_->draws(), trial, "Y:");
  all.insert(all.end(), second.begin(), second.end());
  return all;
}

}  // namespace

Result<std::unique_ptr<ScalableExperiment>> make_plan_experiment(const StudyPlan& plan) {
  return PlanExperiment::create(plan, plan.rig);
}

Result<std::unique_ptr<ScalableExperiment>> make_compared_experiment(const StudyPlan& plan) {
  assert(plan.compare);
  return PlanExperiment::create(plan, *plan.compare);
}

}  // namespace mdof::algo
