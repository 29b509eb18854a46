// Does a signal stand still while the others say that the axis moves?
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "algo/median.h"
#include "algo/plausibility.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestSame = 6, kFewestPlaces = 3;
constexpr double kWithinNoise = 8;  // of u of a stop's mean
constexpr double kWithinSd = 2;     // of single readings
constexpr double kOthersMove = 50;  // times what the dead one may
constexpr double kRestless = 30;    // times the usual sd in stops

using Points = std::vector<MeasuredPoint>;

// The means of a probe in stops that follow each other, and what they may scatter by its noise.
struct Stretch {
  double low_m = 0, high_m = 0, noise_m = 0;
  std::size_t stops = 0;
  std::set<int> targets;

  double range_m() const { return high_m - low_m; }
  void take(const MeasuredPoint& p, std::size_t probe) {
    const double value_m = p.point.probe_m[probe];
    if (!std::isfinite(value_m)) return;
    low_m = stops == 0 ? value_m : std::min(low_m, value_m);
    high_m = stops == 0 ? value_m : std::max(high_m, value_m);
    double noise = kWithinNoise * p.point.probe_u_m[probe];
    if (probe < p.point.probe_sd_m.size())
      noise = std::max(noise, kWithinSd * p.point.probe_sd_m[probe]);
    noise_m = std::max(noise_m, noise);
    targets.insert(p.target);
    ++stops;
  }
};

Stretch stretch_of(const Points& points, std::size_t first, std::size_t last, std::size_t probe) {
  Stretch stretch;
  for (std::size_t i = first; i < last; ++i) stretch.take(points[i], probe);
  return stretch;
}

// The first stop from which the probe reads the same to the end, within its noise.
std::size_t same_from(const Points& points, std::size_t probe) {
  Stretch stretch;
  std::size_t first = points.size();
  while (first > 0) {
    stretch.take(points[first - 1], probe);
    if (stretch.range_m() > stretch.noise_m) break;
    --first;
  }
  return first;
}

bool is_deaf(const Points& points, std::size_t first, std::size_t probe, std::size_t probes) {
  const Stretch same = stretch_of(points, first, points.size(), probe);
  const Stretch before = stretch_of(points, 0, first, probe);
  const double moves_m = kOthersMove * same.noise_m;
  if (same.stops < std::max(kFewestSame, points.size() / 4) ||
      same.targets.size() < kFewestPlaces || (first > 0 && before.range_m() < moves_m))
    return false;
  std::vector<double> others_m;
  for (std::size_t k = 0; k < probes; ++k)
    if (k != probe) others_m.push_back(stretch_of(points, first, points.size(), k).range_m());
  return median_of(others_m) > moves_m;
}

void tell_deaf_probes(const RunToJudge& run, std::vector<std::string>& out) {
  const Points& points = run.sequence.points;
  const std::size_t probes = run.rig.probes.size();
  for (std::size_t k = 0; k < probes; ++k) {
    const std::size_t first = same_from(points, k);
    if (first == points.size() || !is_deaf(points, first, k, probes)) continue;
    std::array<char, 48> since{};
    if (first > 0)
      std::snprintf(since.data(), since.size(), " from %.3f s after the first on",
                    ns_to_s(points[first].point.begin_ns - points.front().point.begin_ns));
    std::array<char, 320> text{};
    std::snprintf(text.data(), text.size(),
                  "probe \"%s\" reads the same at all %zu stops%s (%.6g um, within its noise) "
                  "while the others change: it seems to measure nothing, and errors from it are "
                  "wrong; check its cable, gap and amplifier",
                  run.rig.probes[k].id.c_str(), points.size() - first, since.data(),
                  to_um(points[first].point.probe_m[k]));
    out.emplace_back(text.data());
  }
}

// A stop in which most probes change as they only do while the axis moves.
void tell_frozen_encoder(const RunToJudge& run, std::vector<std::string>& out) {
  const Points& points = run.sequence.points;
  const std::size_t probes = run.rig.probes.size();
  std::vector<double> usual_m(probes);
  for (std::size_t k = 0; k < probes; ++k) {
    std::vector<double> sd_m;
    for (const MeasuredPoint& p : points)
      if (k < p.point.probe_sd_m.size() && std::isfinite(p.point.probe_sd_m[k]))
        sd_m.push_back(p.point.probe_sd_m[k]);
    usual_m[k] = median_of(sd_m);
  }
  for (const MeasuredPoint& p : points) {
    std::size_t restless = 0;
    for (std::size_t k = 0; k < p.point.probe_sd_m.size() && k < probes; ++k)
      restless += p.point.probe_sd_m[k] > kRestless * usual_m[k];
    if (points.size() < kFewestSame || restless < kFewestPlaces || 2 * restless < probes) continue;
    std::array<char, 320> text{};
    std::snprintf(text.data(), text.size(),
                  "in the stop at %.4f mm, of %.3f s, %zu of %zu probes change as while the axis "
                  "moves: the encoder stood still, or something pushed the fixture; check the "
                  "encoder and its cable, and measure again",
                  to_mm(p.point.position_m), ns_to_s(p.point.end_ns - p.point.begin_ns), restless,
                  probes);
    out.emplace_back(text.data());
  }
}

}  // namespace

std::vector<std::string> warnings_of_signals(const RunToJudge& run) {
  std::vector<std::string> out;
  tell_deaf_probes(run, out);
  tell_frozen_encoder(run, out);
  return out;
}

}  // namespace mdof::algo
