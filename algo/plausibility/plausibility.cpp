#include "algo/plausibility/plausibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/points/median.h"
#include "algo/sequence/sequence_stops.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr double kSamePlace_m = 50e-6;

ProbeFigures figures_of(const std::string& id, std::size_t probe,
                        const std::vector<MeasuredPoint>& points) {
  ProbeFigures figures;
  figures.id = id;
  std::vector<double> sd;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const MeasuredPoint& p : points) {
    const double value = p.point.probe_m[probe];
    if (!std::isfinite(value)) continue;
    ++figures.points;
    low = std::min(low, value);
    high = std::max(high, value);
    if (probe < p.point.probe_sd_m.size()) sd.push_back(p.point.probe_sd_m[probe]);
  }
  const bool known = figures.points > 0;
  figures.sd_m = median_of(sd);
  figures.min_m = known ? low : kNaN;
  figures.max_m = known ? high : kNaN;
  figures.travel_m = known ? high - low : kNaN;
  return figures;
}

std::vector<TargetVisits> count_visits(const Sequence& sequence) {
  std::vector<TargetVisits> n_ij;
  const std::vector<int> none(static_cast<std::size_t>(sequence.runs), 0);
  for (const double target_m : sequence.targets_m) n_ij.push_back({target_m, none, none});
  for (const MeasuredPoint& p : sequence.points) {
    TargetVisits& visits = n_ij[static_cast<std::size_t>(p.target) - 1];
    auto& of_runs = p.point.direction > 0 ? visits.forward : visits.reverse;
    of_runs[static_cast<std::size_t>(p.run) - 1] += p.errors.valid;
  }
  return n_ij;
}

}  // namespace

std::vector<DwellDetector::Summary::PassedOver> lost_stops(const RunToJudge& run) {
  const auto& points = run.sequence.points;
  const auto& targets_m = run.sequence.targets_m;
  std::vector<DwellDetector::Summary::PassedOver> lost;
  if (targets_m.empty()) return lost;
  const auto near = [](double a, double b) { return std::abs(a - b) < kSamePlace_m; };
  for (const auto& stop : run.dwells.passed_over) {
    if (!near(targets_m[nearest_target(targets_m, stop.position_m)], stop.position_m)) continue;
    const auto after = std::upper_bound(
        points.begin(), points.end(), stop.begin_ns,
        [](std::int64_t t, const MeasuredPoint& p) { return t < p.point.begin_ns; });
    const bool found =
        (after != points.end() && near(after->point.position_m, stop.position_m)) ||
        (after != points.begin() && near((after - 1)->point.position_m, stop.position_m));
    if (!found) lost.push_back(stop);
  }
  return lost;
}

Plausibility plausibility(const RunToJudge& run) {
  Plausibility figures;
  figures.cycle = to_string(run.sequence.cycle);
  figures.runs = run.sequence.runs;
  figures.n_ij = count_visits(run.sequence);
  figures.left_out = run.sequence.left_out;
  figures.short_stops = lost_stops(run).size();
  figures.rate_hz = run.dwells.period_s > 0 ? 1 / run.dwells.period_s : kNaN;
  figures.encoder_min_m = run.dwells.encoder_min_m;
  figures.encoder_max_m = run.dwells.encoder_max_m;
  figures.scans = run.dwells.scans;
  figures.scans_lost = run.scans_lost;
  figures.gaps = run.dwells.gaps;
  for (std::size_t k = 0; k < run.rig.probes.size(); ++k)
    figures.probes.push_back(figures_of(run.rig.probes[k].id, k, run.sequence.points));
  return figures;
}

}  // namespace mdof::algo
