#include "algo/uncertainty/positioning/positioning_budgets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "algo/iso230/line_fit.h"
#include "algo/uncertainty/positioning/repeatability_interval.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

// Number of trials. The error of U is 2 % with kMostTrials and 7 % with kFewestTrials.
constexpr std::size_t kMostTrials = 2000, kFewestTrials = 200;
constexpr std::size_t kMostDrawn = 4'000'000;  // number of visits times number of trials

// Converts each pair of target and approach to a separate target (2 target, plus 1 for forward),
// with forward approach only.
Run with_separate_approaches(Run run) {
  for (MeasuredPoint& p : run.points) {
    p.target = 2 * p.target + (p.point.direction > 0 ? 1 : 0);
    if (p.point.direction != 0) p.point.direction = 1;
  }
  return run;
}

// The means of a run that with_separate_approaches() has converted, sorted by target and approach.
class Approaches {
 public:
  Approaches(const MeanErrors& means, std::size_t named, bool without_line) {
    std::map<int, std::array<const TargetMean*, 2>> by_target;
    for (const TargetMean& mean : means.targets)
      by_target[mean.target / 2][static_cast<std::size_t>(mean.target % 2)] = &mean;
    std::vector<double> x, both;
    for (const auto& [target, ways] : by_target) {
      double position = 0, error = 0, n = 0;
      for (const TargetMean* way : ways)
        if (way != nullptr) {
          position += way->position_m;
          error += way->named[named];
          n += 1;
        }
      x.push_back(position / n);
      both.push_back(error / n);
    }
    const Line line = without_line && can_fit(x) ? least_squares_line(x, both) : Line{};
    for (const auto& [target, ways] : by_target)
      for (const std::size_t way : {0u, 1u})
        errors_[way].push_back(
            ways[way] != nullptr ? ways[way]->named[named] - line.at(ways[way]->position_m) : kNaN);
  }
  const std::vector<double>& reverse() const { return errors_[0]; }
  const std::vector<double>& forward() const { return errors_[1]; }
  std::vector<double> all() const {
    std::vector<double> both = errors_[0];
    both.insert(both.end(), errors_[1].begin(), errors_[1].end());
    return both;
  }
  std::vector<double> reversals() const {
    std::vector<double> B;
    for (std::size_t i = 0; i < errors_[0].size(); ++i) B.push_back(errors_[1][i] - errors_[0][i]);
    return B;
  }
  // Half reversals with both signs. The range of these values is the largest absolute reversal.
  std::vector<double> signed_half_reversals() const {
    std::vector<double> halves;
    for (const double B : reversals()) {
      halves.push_back(B / 2);
      halves.push_back(-B / 2);
    }
    return halves;
  }

 private:
  std::array<std::vector<double>, 2> errors_;
};

using Deviations = std::function<std::vector<double>(const Approaches&)>;

class Parameters {
 public:
  Parameters(const RunBudgets& run, std::size_t named, bool without_line)
      : run_(run), named_(named), without_line_(without_line) {}
  // U of the range of these deviations; NaN if one of them is missing.
  double range(const Deviations& deviations) const {
    return U({"",
              [of = of(deviations)](const MeanErrors& means) {
                const std::vector<double> all = of(means);
                const auto [least, most] = std::minmax_element(all.begin(), all.end());
                return *most - *least;
              },
              of(deviations)});
  }
  double mean(const Deviations& deviations) const {
    return U({"", [of = of(deviations)](const MeanErrors& means) {
                double sum = 0;
                const std::vector<double> all = of(means);
                for (const double v : all) sum += v;
                return sum / static_cast<double>(all.size());
              }});
  }

 private:
  std::function<std::vector<double>(const MeanErrors&)> of(const Deviations& deviations) const {
    return [deviations, named = named_, without_line = without_line_](const MeanErrors& means) {
      return deviations(Approaches(means, named, without_line));
    };
  }
  double U(const Figure& figure) const {
    const std::vector<double> all =
        figure.is_range() ? figure.deviations(run_.means()) : std::vector{figure.of(run_.means())};
    const bool known =
        std::all_of(all.begin(), all.end(), [](double v) { return std::isfinite(v); });
    return known ? run_.of(figure).U : kNoFigure;
  }

  const RunBudgets& run_;
  std::size_t named_;
  bool without_line_;
};

struct Visits {
  VisitGroups groups;
  std::vector<double> measured, noise;  // noise: standard uncertainty of each visit by the noise of
                                        // the dwell
  std::vector<std::size_t> point;       // index of each visit in run.points
};

Visits visits_of(const Run& run, std::size_t named) {
  Visits visits;
  std::map<int, std::size_t> targets;
  for (const MeasuredPoint& p : run.points)
    if (p.errors.valid && p.point.direction != 0) targets[p.target];
  for (auto& [target, place] : targets) place = visits.groups.targets++;
  for (std::size_t j = 0; j < run.points.size(); ++j) {
    const MeasuredPoint& p = run.points[j];
    if (!p.errors.valid || p.point.direction == 0) continue;
    visits.groups.of_visit.push_back(2 * targets.at(p.target) + (p.point.direction > 0 ? 1 : 0));
    visits.measured.push_back(named_from_local(run.header.moving(), p.errors.local)[named]);
    const Covariance5 noise = named_from_local(run.header.axis, p.errors.covariance);
    visits.noise.push_back(std::sqrt(noise[(kErrorCount + 1) * named]));
    visits.point.push_back(j);
  }
  return visits;
}

std::vector<double> drawn_errors(const Visits& visits, const Run& run, std::size_t named,
                                 const std::vector<Contributor>& declared,
                                 const std::vector<std::vector<PointShifts>>& parts) {
  const std::size_t n = visits.measured.size();
  const std::size_t trials = std::clamp(kMostDrawn / n, kFewestTrials, kMostTrials);
  std::vector<double> errors(trials * n);
  BlockOfDraws draws({1, 1}, 0, trials);
  const UnitQuantity normal(std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < n; ++v) {
    const std::vector<double> drawn = draws.next(normal);
    for (std::size_t t = 0; t < trials; ++t) errors[t * n + v] = visits.noise[v] * drawn[t];
  }
  for (std::size_t c = 0; c < declared.size(); ++c) {
    const UnitQuantity quantity =
        parts[c].size() == 1 ? UnitQuantity(declared[c].declared) : normal;
    for (const PointShifts& part : parts[c]) {
      std::vector<double> shift;
      for (const std::size_t j : visits.point)
        shift.push_back(named_from_local(run.header.moving(), part[j])[named]);
      const std::vector<double> drawn = draws.next(quantity);
      for (std::size_t t = 0; t < trials; ++t)
        for (std::size_t v = 0; v < n; ++v) errors[t * n + v] += drawn[t] * shift[v];
    }
  }
  return errors;
}

}  // namespace

Result<RunPositioningUncertainty> run_positioning_uncertainty(const Rig& rig, const Run& run,
                                                              std::size_t named, bool keep_slope) {
  MDOF_TRY(const auto declared, contributors(rig, run));
  RunBudgets both(rig, run), apart(rig, with_separate_approaches(run));
  std::vector<std::vector<PointShifts>> parts;
  for (const Contributor& contributor : declared) {
    parts.push_back(contributor.parts());
    both.add(contributor, parts.back());
    apart.add(contributor, parts.back());
  }
  const Axis axis = run.header.axis;
  const bool without_line = !keep_slope && !error_names(axis)[named].angle;
  const Parameters of(apart, named, without_line);
  RunPositioningUncertainty found;
  found.B = of.range(&Approaches::signed_half_reversals);
  found.B_mean = of.mean(&Approaches::reversals);
  found.E_forward = of.range(&Approaches::forward);
  found.E_reverse = of.range(&Approaches::reverse);
  found.E = of.range(&Approaches::all);
  const Budget M =
      both.of(without_line ? straightness_figure(axis, named) : range_figure(axis, named));
  if (std::isfinite(found.B_mean)) found.M = M.U;
  found.noise_only = M.noise_only;
  found.covers = covers_text(M);
  found.not_declared = M.not_declared;
  const Visits visits = visits_of(run, named);
  const std::vector<double> errors = drawn_errors(visits, run, named, declared, parts);
  double* const R[] = {&found.R_forward, &found.R_reverse, &found.R};
  for (std::size_t i = 0; i < kRepeatabilities.size(); ++i)
    *R[i] = repeatability_U(visits.groups, visits.measured, errors, kRepeatabilities[i]);
  return found;
}

}  // namespace mdof::algo
