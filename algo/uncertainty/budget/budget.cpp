#include "algo/uncertainty/budget/budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "algo/drift/removed_drift.h"
#include "algo/uncertainty/budget/budget_draws.h"
#include "algo/uncertainty/coverage.h"
#include "algo/uncertainty/statistics/target_noise.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr std::uint64_t kIntervalTrials = 2000;  // the error of U is then 2 %
constexpr std::uint64_t kTrialsPerBlock = 64;    // the shifts of 64 trials fit into the cache
// Largest U for which u is of first order, in multiples of u and of k u.
constexpr double kMostFirstOrderFactor = 3, kMostOfFirstOrder = 1.5;
// U / u of trials. A smaller ratio is due to few trials that are far away: a t distribution of two
// degrees of freedom or fewer has no standard deviation.
constexpr double kLeastFactor = 1.3;
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

// Collects up to four parts and adds them together to the shifts of all trials. This is faster,
// because each shift is read and written once for four parts.
class PartBatch {
 public:
  void add(const std::vector<double>& part, std::vector<double> drawn) {
    part_[n_] = part.data();
    width_ = part.size();
    drawn_[n_++] = std::move(drawn);
  }
  bool full() const { return n_ == kMost; }
  // `sums`: all shifts of the first trial, then of the next trial, and so on.
  void add_to(std::vector<double>& sums) {
    for (std::size_t t = 0; n_ > 0 && t < drawn_[0].size(); ++t) {
      double* sum = sums.data() + t * width_;
      if (full())
        add_four(sum, t);
      else
        for (std::size_t p = 0; p < n_; ++p)
          for (std::size_t i = 0; i < width_; ++i) sum[i] += drawn_[p][t] * part_[p][i];
    }
    n_ = 0;
  }

 private:
  static constexpr std::size_t kMost = 4;

  void add_four(double* sum, std::size_t t) const {
    const double a = drawn_[0][t], b = drawn_[1][t], c = drawn_[2][t], d = drawn_[3][t];
    const double *pa = part_[0], *pb = part_[1], *pc = part_[2], *pd = part_[3];
    for (std::size_t i = 0; i < width_; ++i)
      sum[i] = sum[i] + a * pa[i] + b * pb[i] + c * pc[i] + d * pd[i];
  }

  std::array<const double*, kMost> part_{};
  std::array<std::vector<double>, kMost> drawn_;
  std::size_t n_ = 0, width_ = 0;
};

}  // namespace

RunBudgets::RunBudgets(const Rig& rig, const Run& run)
    : means_(means_of(run, run.points)),
      repeatability_(repeatability(run.header.moving(), run.points, means_.targets)),
      changes_(run.header.moving(), run.points),
      runs_(means_of_each_run(run)),
      not_declared_(rig.undeclared_uncertainties()) {}

Result<RunBudgets> RunBudgets::create(const Rig& rig, const Run& run) {
  MDOF_TRY(const auto declared, contributors(rig, run));
  RunBudgets budgets(rig, run);
  for (const Contributor& contributor : declared) budgets.add(contributor, contributor.parts());
  return budgets;
}

std::size_t RunBudgets::cost() const {
  std::size_t parts = 1 + repeatability_.together.size() + repeatability_.of_passes.size();
  for (const Shifted& shifted : shifted_) parts += shifted.parts.size();
  return parts * means_.targets.size();
}

void RunBudgets::add(const Contributor& contributor, const std::vector<PointShifts>& parts) {
  Shifted& shifted = shifted_.emplace_back(Shifted{contributor, {}});
  shifted.contributor.parts = nullptr;  // this function would keep the whole run in memory
  for (const PointShifts& part : parts) {
    MeanShifts& shifts = shifted.parts.emplace_back();
    for (const Errors5& at_target : changes_.of(part))
      shifts.insert(shifts.end(), at_target.begin(), at_target.end());
  }
}

void RunBudgets::move(MeanErrors& means, std::span<const double> shifts, double factor) const {
  for (std::size_t i = 0; i < means.targets.size(); ++i)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      means.targets[i].named[k] = means_.targets[i].named[k] + factor * shifts[i * kErrorCount + k];
}

double RunBudgets::half_difference(const Figure& figure, const MeanShifts& shifts) const {
  MeanErrors means = means_;
  move(means, shifts, 1);
  const double plus = figure.of(means);
  move(means, shifts, -1);
  return (plus - figure.of(means)) / 2;
}

double RunBudgets::half_difference_at(const Figure& figure, MeanErrors& means, std::size_t i,
                                      const Errors5& shift) {
  Errors5& at_target = means.targets[i].named;
  const Errors5 measured = at_target;
  const auto shifted = [&](double factor) {
    for (std::size_t k = 0; k < kErrorCount; ++k) at_target[k] = measured[k] + factor * shift[k];
    return figure.of(means);
  };
  const double plus = shifted(1), minus = shifted(-1);
  at_target = measured;
  return (plus - minus) / 2;
}

std::vector<RunBudgets::Contribution> RunBudgets::contributions(const Figure& figure) const {
  std::vector<Contribution> all;
  for (const Shifted& shifted : shifted_) {
    Contribution& of = all.emplace_back(Contribution{&shifted.contributor, {}});
    for (const MeanShifts& part : shifted.parts) of.parts.push_back(half_difference(figure, part));
  }
  return all;
}

BudgetLine RunBudgets::line(const Contributor& c, const std::vector<double>& parts) {
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

Budget RunBudgets::first_order(const Figure& figure) const {
  Budget budget;
  budget.figure = figure.name;
  budget.value = figure.of(means_);
  const Random random = random_of(figure);
  budget.u_random = random.u;
  budget.is_single_run = runs_.size() < 2;
  budget.not_declared = not_declared_;
  BudgetLine noise;
  noise.name = {ContributorKind::noise_repeatability};
  noise.distribution = "normal";
  noise.contribution = random.u;
  noise.freedom = random.freedom;
  budget.lines.push_back(noise);
  for (const auto& [contributor, parts] : contributions(figure))
    budget.lines.push_back(line(*contributor, parts));
  complete(budget);
  return budget;
}

Budget RunBudgets::of(const Figure& figure) const {
  return of(std::vector{figure}).front();
}

std::vector<Budget> RunBudgets::of(const std::vector<Figure>& figures) const {
  std::vector<Budget> budgets;
  std::vector<Figure> ranges;
  std::vector<std::size_t> place;  // index of the budget of each range
  for (const Figure& figure : figures) {
    budgets.push_back(first_order(figure));
    if (!figure.is_range() || !std::isfinite(budgets.back().value)) continue;
    ranges.push_back(figure);
    place.push_back(budgets.size() - 1);
  }
  if (ranges.empty()) return budgets;
  auto trials = drawn(ranges, {kIntervalTrials, 1}, 0);
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    Budget& budget = budgets[place[r]];
    state_interval(budget, {ranges[r].deviations(means_), std::move(trials[r].changes)});
  }
  return budgets;
}

// All shifts of the means in the first trial, then in the next trial, and so on. `quantities`:
// distribution of each contributor.
std::vector<double> RunBudgets::moved_by(BlockOfDraws& draws, std::size_t trials,
                                         const std::vector<UnitQuantity>& quantities) const {
  std::vector<double> moved(trials * means_.targets.size() * kErrorCount);
  PartBatch some;
  for (std::size_t s = 0; s < shifted_.size(); ++s) {
    // The parts of a contributor share its degrees of freedom.
    const double freedom = shifted_[s].contributor.declared.freedom;
    const bool is_common = shifted_[s].parts.size() > 1 && std::isfinite(freedom);
    std::vector<double> common;
    if (is_common) common = draws.next(UnitQuantity(kInfinite));
    for (double& x : common) x = student_factor(x, freedom);
    for (const MeanShifts& part : shifted_[s].parts) {
      std::vector<double> drawn = draws.next(quantities[s]);
      for (std::size_t t = 0; t < common.size(); ++t) drawn[t] *= common[t];
      some.add(part, drawn);
      if (some.full()) some.add_to(moved);
    }
  }
  some.add_to(moved);
  return moved;
}

std::vector<RunBudgets::Drawn> RunBudgets::drawn(const std::vector<Figure>& figures,
                                                 const TrialsRequest& request,
                                                 std::uint32_t stream) const {
  std::vector<Random> random;
  std::map<double, UnitQuantity>
      noise;  // by degrees of freedom, because the quantiles of t take long to calculate
  std::vector<std::vector<double>> measured;
  bool any_range = false;
  for (const Figure& figure : figures) {
    random.push_back(random_of(figure));
    noise.try_emplace(random.back().freedom, random.back().freedom);
    measured.push_back(figure.is_range() ? figure.deviations(means_) : std::vector<double>());
    any_range = any_range || !measured.back().empty();
  }
  std::vector<UnitQuantity> quantities;
  for (const Shifted& s : shifted_)
    quantities.push_back(s.parts.size() == 1 ? UnitQuantity(s.contributor.declared)
                                             : UnitQuantity(kInfinite));
  std::vector<Drawn> all(figures.size());
  for (std::size_t f = 0; f < figures.size(); ++f) {
    all[f].values.resize(request.trials);
    all[f].changes.reserve(request.trials * measured[f].size());
  }
  MeanErrors means = means_, noisy = means_;  // of one trial
  for (std::uint64_t first = 0; first < request.trials; first += kTrialsPerBlock) {
    const std::size_t trials = std::min(kTrialsPerBlock, request.trials - first);
    BlockOfDraws draws({request.seed, stream}, first, trials);
    const std::vector<double> uniform = draws.next();
    const std::vector<double> shifts = moved_by(draws, trials, quantities);
    const std::size_t width = shifts.size() / trials;
    std::map<double, std::vector<double>> of_noise;
    for (const auto& [freedom, quantity] : noise)
      quantity.quantiles(of_noise.try_emplace(freedom, uniform).first->second);
    std::optional<TargetNoise> of_targets;
    if (any_range) of_targets.emplace(draws, repeatability_);
    for (std::size_t t = 0; t < trials; ++t) {
      move(means, std::span(shifts).subspan(t * width, width), 1);
      std::optional<double> by;  // factor of the noise that `noisy` contains
      for (std::size_t f = 0; f < figures.size(); ++f) {
        if (measured[f].empty()) {
          all[f].values[first + t] =
              figures[f].of(means) + random[f].u * of_noise.at(random[f].freedom)[t];
          continue;
        }
        const double factor = random[f].widened * of_targets->student(t, random[f].freedom);
        if (factor != by) {
          noisy = means;
          of_targets->add_to(noisy, t, factor);
          by = factor;
        }
        const std::vector<double> deviations = figures[f].deviations(noisy);
        const auto [least, most] = std::minmax_element(deviations.begin(), deviations.end());
        all[f].values[first + t] = *most - *least;
        for (std::size_t i = 0; i < deviations.size(); ++i)
          all[f].changes.push_back(deviations[i] - measured[f][i]);
      }
    }
  }
  return all;
}

std::vector<std::vector<double>> RunBudgets::draw(const std::vector<Figure>& figures,
                                                  const TrialsRequest& request,
                                                  std::uint32_t stream) const {
  std::vector<std::vector<double>> values;
  for (Drawn& of : drawn(figures, request, stream)) values.push_back(std::move(of.values));
  return values;
}

BudgetTrials RunBudgets::trials(const Figure& figure, const TrialsRequest& request) const {
  Drawn of = std::move(drawn({figure}, request, 0).front());
  if (of.changes.empty()) return summary_of(std::move(of.values), request.seed);
  const RangeTrials range(figure.deviations(means_), std::move(of.changes));
  const double value = figure.of(means_), U = range.U();
  return {request.trials, request.seed, range.standard_deviation(), std::max(0.0, value - U),
          value + U};
}

void state_interval(Budget& budget, const RangeTrials& range) {
  const double U = range.U();
  if (!(U > 0)) return;
  budget.U = U;
  // If a shift is larger than the deviations, +shift and -shift cause nearly the same range, and u
  // of first order is nearly 0.
  const double factor = std::max(kMostFirstOrderFactor, kMostOfFirstOrder * budget.coverage_factor);
  budget.u_by_trials = !(factor * budget.u >= U);
  if (budget.u_by_trials) {
    const double u = range.root_mean_square(std::max(0.0, budget.value - U));
    budget.u = U < kLeastFactor * u ? U / budget.coverage_factor : u;
  }
  budget.coverage_factor = budget.U / budget.u;
  budget.U_by_trials = true;
}

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
  // An uncertainty that is not declared may contribute, so u is unknown.
  if (budget.u == 0 && !budget.not_declared.empty())
    budget.u = budget.U = budget.coverage_factor = std::numeric_limits<double>::quiet_NaN();
  budget.noise_only = is_noise_only(budget);
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

}  // namespace mdof::algo
