#include "algo/uncertainty/budget.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "algo/model/restate.h"
#include "algo/sensitivity/distribution.h"
#include "algo/sensitivity/random.h"
#include "algo/uncertainty/coverage.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr std::uint64_t kTrialsOfU = 2000;  // U is then right to 2 %
constexpr double kMostFreedom = 10000;      // of Student's t; normal beyond
constexpr double kInfinite = std::numeric_limits<double>::infinity();

MeanErrors means_of(const Run& run, const std::vector<MeasuredPoint>& points) {
  return {run.header.sides, target_means(run.header.moving(), points, Approach::both)};
}

std::vector<MeanErrors> means_of_each_run(const Run& run) {
  std::map<int, std::vector<MeasuredPoint>> by_run;
  for (const auto& p : run.points) by_run[p.run].push_back(p);
  std::vector<MeanErrors> means;
  for (const auto& [number, points] : by_run) means.push_back(means_of(run, points));
  return means;
}

double sum_of_squares(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return sum;
}

// JCGM 101 6.4; of one standard uncertainty, and Student's t where the degrees of freedom are few
// (6.4.9).
Distribution of_one_u(const DeclaredUncertainty& declared) {
  Distribution d;
  const auto limited = [&](Distribution::Kind kind, double half_width) {
    d.kind = kind;
    d.low = -half_width;
    d.high = half_width;
  };
  switch (declared.shape) {
    case UncertaintyShape::rectangular:
      limited(Distribution::Kind::rectangular, std::sqrt(3.0));
      break;
    case UncertaintyShape::triangular:
      limited(Distribution::Kind::triangular, std::sqrt(6.0));
      break;
    case UncertaintyShape::u_shaped:
      limited(Distribution::Kind::u_shaped, std::sqrt(2.0));
      break;
    case UncertaintyShape::normal:
      d.kind = Distribution::Kind::normal;
      d.spread = 1;
      if (declared.freedom <= kMostFreedom) {
        d.kind = Distribution::Kind::t;
        d.dof = declared.freedom;
      }
  }
  return d;
}

// Shares, the largest first, and what follows from all lines.
void complete(Budget& budget) {
  std::vector<UncertaintyPart> parts;
  double square = 0;
  for (const BudgetLine& line : budget.lines) {
    square += line.contribution * line.contribution;
    parts.push_back({std::abs(line.contribution), line.freedom});
  }
  budget.u = std::sqrt(square);
  for (BudgetLine& line : budget.lines)
    line.share = square > 0 ? line.contribution * line.contribution / square : 0;
  std::stable_sort(budget.lines.begin(), budget.lines.end(),
                   [](const BudgetLine& a, const BudgetLine& b) { return a.share > b.share; });
  budget.freedom = effective_freedom(parts);
  budget.coverage_factor = coverage_factor(budget.freedom);
  budget.U = budget.coverage_factor * budget.u;
}

void add_to(std::vector<Errors5>& sum, const std::vector<Errors5>& part, double factor) {
  for (std::size_t i = 0; i < part.size(); ++i)
    for (std::size_t k = 0; k < kErrorCount; ++k) sum[i][k] += factor * part[i][k];
}

// The distance from `value` within which 95 % of the trials lie.
double distance_of_95_percent(std::vector<double> trials, double value) {
  for (double& trial : trials) trial = std::abs(trial - value);
  const auto at =
      trials.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(trials.size()));
  std::nth_element(trials.begin(), at, trials.end());
  return *at;
}

}  // namespace

Result<RunBudgets> RunBudgets::create(const Rig& rig, const Run& run) {
  MDOF_TRY(const auto declared, contributors(rig, run));
  RunBudgets budgets;
  budgets.not_declared_ = rig.undeclared_uncertainties();
  budgets.means_ = means_of(run, run.points);
  budgets.runs_ = means_of_each_run(run);
  for (const Contributor& contributor : declared) budgets.add(contributor, run);
  return budgets;
}

std::size_t RunBudgets::cost() const {
  std::size_t parts = 1;
  for (const Shifted& shifted : shifted_) parts += shifted.parts.size();
  return parts * means_.targets.size();
}

void RunBudgets::add(const Contributor& contributor, const Run& run) {
  Shifted shifted{contributor, {}};
  std::vector<MeasuredPoint> points = run.points;
  for (const PointShifts& shifts : contributor.parts()) {
    shift(points, shifts);
    const MeanErrors means = means_of(run, points);
    for (std::size_t j = 0; j < points.size(); ++j) points[j].errors = run.points[j].errors;
    MeanShifts& of_means = shifted.parts.emplace_back(means_.targets.size());
    for (std::size_t i = 0; i < of_means.size(); ++i)
      for (std::size_t k = 0; k < kErrorCount; ++k)
        of_means[i][k] = means.targets[i].named[k] - means_.targets[i].named[k];
  }
  shifted_.push_back(std::move(shifted));
}

MeanErrors RunBudgets::moved(const MeanShifts& shifts, double factor) const {
  MeanErrors means = means_;
  for (std::size_t i = 0; i < shifts.size(); ++i)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      means.targets[i].named[k] += factor * shifts[i][k];
  return means;
}

double RunBudgets::half_difference(const Figure& figure, const MeanShifts& shifts) const {
  return (figure.of(moved(shifts, 1)) - figure.of(moved(shifts, -1))) / 2;
}

BudgetLine RunBudgets::line(const Figure& figure, const Shifted& shifted) const {
  const Contributor& c = shifted.contributor;
  std::vector<double> parts;
  for (const MeanShifts& part : shifted.parts) parts.push_back(half_difference(figure, part));
  BudgetLine line;
  line.name = c.name;
  line.key = c.key;
  line.distribution = to_string(c.declared.shape);
  line.value = c.declared.u * c.to_unit;
  line.unit = c.unit;
  line.contribution = parts.size() == 1 ? parts.front() : std::sqrt(sum_of_squares(parts));
  line.freedom = c.declared.freedom;
  return line;
}

// Degrees of freedom: the visits of all targets less their means, each approach with its own. A
// single visit's noise is that of many readings.
RunBudgets::Random RunBudgets::random_of_targets(const Figure& figure) const {
  std::vector<double> parts;
  double freedom = 0;
  for (std::size_t i = 0; i < means_.targets.size(); ++i) {
    MeanShifts alone(means_.targets.size());
    alone[i] = means_.targets[i].u;
    parts.push_back(half_difference(figure, alone));
    freedom += std::max(0.0, static_cast<double>(means_.targets[i].n) - 2);
  }
  return {std::sqrt(sum_of_squares(parts)), freedom > 0 ? freedom : kInfinite};
}

RunBudgets::Random RunBudgets::random_of_runs(const Figure& figure) const {
  std::vector<double> values;
  for (const MeanErrors& run : runs_)
    if (run.targets.size() == means_.targets.size()) values.push_back(figure.of(run));
  const auto n = static_cast<double>(values.size());
  if (values.size() < 2) return {0, kInfinite};
  double mean = 0;
  for (const double v : values) mean += v / n;
  for (double& v : values) v -= mean;
  return {std::sqrt(sum_of_squares(values) / (n - 1) / n), n - 1};
}

RunBudgets::Random RunBudgets::random_of(const Figure& figure) const {
  const Random targets = random_of_targets(figure), runs = random_of_runs(figure);
  return runs.u > targets.u ? runs : targets;
}

Budget RunBudgets::first_order(const Figure& figure) const {
  Budget budget;
  budget.figure = figure.name;
  budget.value = figure.of(means_);
  const Random random = random_of(figure);
  budget.u_random = random.u;
  budget.noise_only = shifted_.empty();
  budget.not_declared = not_declared_;
  BudgetLine noise;
  noise.name = "noise and repeatability";
  noise.distribution = "normal";
  noise.contribution = random.u;
  noise.freedom = random.freedom;
  budget.lines.push_back(noise);
  for (const Shifted& shifted : shifted_) budget.lines.push_back(line(figure, shifted));
  complete(budget);
  return budget;
}

Budget RunBudgets::of(const Figure& figure) const {
  return of(std::vector{figure}).front();
}

std::vector<Budget> RunBudgets::of(const std::vector<Figure>& figures) const {
  std::vector<Budget> budgets;
  std::vector<Figure> ranges;
  std::vector<std::size_t> place;  // of each range among the budgets
  for (const Figure& figure : figures) {
    budgets.push_back(first_order(figure));
    if (!figure.is_range || !(budgets.back().u > 0)) continue;
    ranges.push_back(figure);
    place.push_back(budgets.size() - 1);
  }
  if (ranges.empty()) return budgets;
  auto values = draw(ranges, {kTrialsOfU, 1});
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    Budget& budget = budgets[place[r]];
    budget.U = distance_of_95_percent(std::move(values[r]), budget.value);
    budget.coverage_factor = budget.U / budget.u;
    budget.U_by_trials = true;
  }
  return budgets;
}

std::vector<std::vector<double>> RunBudgets::draw(const std::vector<Figure>& figures,
                                                  const TrialsRequest& request,
                                                  std::uint32_t stream) const {
  std::vector<Random> random;
  std::vector<QuantileFunction> noise, alone;
  for (const Figure& figure : figures) {
    random.push_back(random_of(figure));
    noise.emplace_back(of_one_u({1, UncertaintyShape::normal, random.back().freedom}));
  }
  const QuantileFunction normal(of_one_u({1, UncertaintyShape::normal, kInfinite}));
  for (const Shifted& s : shifted_) alone.emplace_back(of_one_u(s.contributor.declared));
  std::vector<std::vector<double>> values(figures.size(), std::vector<double>(request.trials));
  MeanErrors means = means_;
  for (std::uint64_t trial = 0; trial < request.trials; ++trial) {
    std::uint64_t q = 0;
    const auto next = [&] { return algo::draw({request.seed, stream}, trial, q++); };
    const double of_noise = next();
    MeanShifts moved(means_.targets.size());
    for (std::size_t s = 0; s < shifted_.size(); ++s) {
      const QuantileFunction& of_parts = shifted_[s].parts.size() == 1 ? alone[s] : normal;
      for (const MeanShifts& part : shifted_[s].parts) add_to(moved, part, of_parts.at(next()));
    }
    for (std::size_t i = 0; i < moved.size(); ++i)
      for (std::size_t k = 0; k < kErrorCount; ++k)
        means.targets[i].named[k] = means_.targets[i].named[k] + moved[i][k];
    for (std::size_t f = 0; f < figures.size(); ++f)
      values[f][trial] = figures[f].of(means) + random[f].u * noise[f].at(of_noise);
  }
  return values;
}

BudgetTrials summary_of(std::vector<double> trials, std::uint64_t seed) {
  BudgetTrials summary{trials.size(), seed, 0, 0, 0};
  const auto n = static_cast<double>(trials.size());
  double mean = 0;
  for (const double v : trials) mean += v / n;
  double square = 0;
  for (const double v : trials) square += (v - mean) * (v - mean);
  summary.u = std::sqrt(square / (n - 1));
  std::sort(trials.begin(), trials.end());
  const auto at = [&](double p) {
    return trials[std::min(trials.size() - 1, static_cast<std::size_t>(p * n))];
  };
  summary.low = at(0.025);
  summary.high = at(0.975);
  return summary;
}

namespace {

void add_run(Budget& budget, const Budget& of_run, const std::string& name) {
  for (const std::string& key : of_run.not_declared)
    budget.not_declared.push_back(name + " " + key);
  for (BudgetLine line : of_run.lines) {
    line.name = name + ", " + line.name;
    line.contribution = -line.contribution;
    budget.lines.push_back(std::move(line));
  }
}

BudgetLine artefact_line(const SquareArtefact& artefact) {
  BudgetLine line;
  line.name = "angle of the square";
  line.key = "u_artefact_angle_urad";
  line.distribution = to_string(UncertaintyShape::normal);
  line.value = artefact.u_rad * 1e6;
  line.unit = "µrad";
  line.contribution = artefact.u_rad * (artefact.corner < 0 ? -1 : 1);
  return line;
}

}  // namespace

Result<Budget> squareness_budget(const Rig& rig_x, const Run& run_x, const Rig& rig_y,
                                 const Run& run_y, const SquareArtefact& artefact,
                                 const TrialsRequest& request) {
  MDOF_TRY(const RunBudgets along_x, RunBudgets::create(rig_x, restate(run_x, kAtFixture)));
  MDOF_TRY(const RunBudgets along_y, RunBudgets::create(rig_y, restate(run_y, kAtFixture)));
  const Figure slope_x = slope_figure(Axis::x, 0), slope_y = slope_figure(Axis::y, 0);
  const Budget x = along_x.of(slope_x), y = along_y.of(slope_y);
  Budget budget;
  budget.figure = "EC0Y_urad";
  budget.value = -y.value - x.value + artefact.corner * artefact.angle_error_rad;
  budget.u_random = std::hypot(x.u_random, y.u_random);
  budget.noise_only = x.noise_only && y.noise_only && artefact.u_rad == 0;
  add_run(budget, x, "X");
  add_run(budget, y, "Y");
  if (artefact.u_rad > 0)
    budget.lines.push_back(artefact_line(artefact));
  else
    budget.not_declared.emplace_back("u_artefact_angle_urad");
  complete(budget);
  if (request.trials < 2) return budget;
  std::vector<double> values = along_x.draw({slope_x}, request, 0).front();
  const std::vector<double> of_y = along_y.draw({slope_y}, request, 1).front();
  const QuantileFunction normal(of_one_u({1, UncertaintyShape::normal, kInfinite}));
  for (std::uint64_t t = 0; t < request.trials; ++t)
    values[t] = -values[t] - of_y[t] + artefact.corner * artefact.angle_error_rad +
                artefact.u_rad * normal.at(algo::draw({request.seed, 2}, t, 0));
  budget.trials = summary_of(std::move(values), request.seed);
  return budget;
}

}  // namespace mdof::algo
