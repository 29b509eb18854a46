// Finds signals that are constant although the other signals show that the axis moves.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>

#include "algo/plausibility/plausibility.h"
#include "algo/points/flags.h"
#include "algo/points/median.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestSame = 6, kFewestPlaces = 3;
constexpr std::size_t kFewestClipped = 3;
// Largest difference of means of equal numbers, due to rounding.
constexpr double kExact_m = 1e-14;
constexpr double kWithinNoise = 8;            // times the u of the mean of a stop
constexpr double kOthersMove = 50;            // times the noise limit of the constant probe
constexpr double kRestlessNoiseFactor = 30;   // times the usual sd in the stops
constexpr std::size_t kFewestRestless = 3;    // probes
constexpr std::size_t kFewestUsualStops = 6;  // with fewer stops, the median of the sd is uncertain

using Stops = std::vector<const MeasuredPoint*>;

// Returns the stops at which the probe has a value.
Stops with_value(const std::vector<MeasuredPoint>& points, std::size_t probe) {
  Stops stops;
  for (const MeasuredPoint& p : points)
    if (std::isfinite(p.point.probe_m[probe])) stops.push_back(&p);
  return stops;
}

// Range of the means of a probe in several stops, and the range that its noise can cause.
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
    noise_m = std::max(noise_m, kWithinNoise * p.point.probe_u_m[probe]);
    targets.insert(p.target);
    ++stops;
  }
};

// Returns the index of the first stop from which on the reading is constant within its noise, up to
// the last stop.
std::size_t same_from(const Stops& stops, std::size_t probe) {
  Stretch stretch;
  std::size_t first = stops.size();
  while (first > 0) {
    stretch.take(*stops[first - 1], probe);
    if (stretch.range_m() > stretch.noise_m) break;
    --first;
  }
  return first;
}

// Returns the median of the changes (highest - lowest mean) of the other probes from this stop on.
double others_change_m(const RunToJudge& run, const MeasuredPoint& from, std::size_t probe) {
  std::vector<double> others_m;
  for (std::size_t k = 0; k < run.rig.probes.size(); ++k) {
    if (k == probe) continue;
    Stretch stretch;
    for (const MeasuredPoint& p : run.sequence.points)
      if (p.point.begin_ns >= from.point.begin_ns) stretch.take(p, k);
    others_m.push_back(stretch.range_m());
  }
  return median_of(others_m);
}

bool is_insensitive(const RunToJudge& run, const Stops& stops, std::size_t first,
                    std::size_t probe) {
  Stretch before, same;
  for (std::size_t i = 0; i < stops.size(); ++i) (i < first ? before : same).take(*stops[i], probe);
  const double moves_m = kOthersMove * same.noise_m;
  return same.stops >= std::max(kFewestSame, stops.size() / 4) &&
         same.targets.size() >= kFewestPlaces && (first == 0 || before.range_m() >= moves_m) &&
         others_change_m(run, *stops[first], probe) > moves_m;
}

void note_insensitive_probes(const RunToJudge& run, Notices& out) {
  for (std::size_t k = 0; k < run.rig.probes.size(); ++k) {
    const Stops stops = with_value(run.sequence.points, k);
    const std::size_t first = same_from(stops, k);
    if (first == stops.size() || !is_insensitive(run, stops, first, k)) continue;
    const std::int64_t since_ns =
        first == 0 ? 0 : stops[first]->point.begin_ns - run.sequence.points.front().point.begin_ns;
    out.push_back(notice(NoticeCode::probe_insensitive, run.rig.probes[k].id,
                         {{"stops", stops.size() - first},
                          {"from_s", ns_to_s(since_ns)},
                          {"reading_um", to_um(stops[first]->point.probe_m[k])}}));
  }
}

// Reports probes whose amplifier is at the limit of its output. The reading is then constant during
// a stop and is the largest or the smallest reading of the run. Other stops have noise.
void note_clipped_probes(const RunToJudge& run, Notices& out) {
  for (std::size_t k = 0; k < run.rig.probes.size(); ++k) {
    const Stops stops = with_value(run.sequence.points, k);
    double low_m = HUGE_VAL, high_m = -HUGE_VAL;
    Stretch same;
    for (const MeasuredPoint* p : stops) {
      low_m = std::min(low_m, p->point.probe_m[k]);
      high_m = std::max(high_m, p->point.probe_m[k]);
      if (k < p->point.probe_sd_m.size() && p->point.probe_sd_m[k] <= kExact_m) same.take(*p, k);
    }
    const bool at_end = same.low_m <= low_m + kExact_m || same.high_m >= high_m - kExact_m;
    if (same.stops < kFewestClipped || same.stops == stops.size() || !at_end ||
        same.range_m() > kExact_m)
      continue;
    out.push_back(notice(NoticeCode::probe_clipped, run.rig.probes[k].id,
                         {{"stops", same.stops}, {"reading_um", to_um(same.high_m)}}));
  }
}

// Reports stops in which at least half of the probes (and at least three) change as much as during
// a motion of the axis.
void note_frozen_encoder(const RunToJudge& run, Notices& out) {
  const auto& points = run.sequence.points;
  const std::size_t probes = run.rig.probes.size();
  // Usual sd of each probe; 0: its readings are constant in stops. In few stops, one stop with a
  // false position changes the median too much, so the least sd is used.
  std::vector<double> usual_m(probes);
  for (std::size_t k = 0; k < probes; ++k) {
    std::vector<double> sd_m;
    for (const MeasuredPoint& p : points)
      if (k < p.point.probe_sd_m.size() && std::isfinite(p.point.probe_sd_m[k]))
        sd_m.push_back(p.point.probe_sd_m[k]);
    if (sd_m.empty()) continue;
    usual_m[k] = points.size() < kFewestUsualStops ? *std::min_element(sd_m.begin(), sd_m.end())
                                                   : median_of(sd_m);
  }
  for (const MeasuredPoint& p : points) {
    std::size_t restless = 0;
    for (std::size_t k = 0; k < p.point.probe_sd_m.size() && k < probes; ++k)
      restless += usual_m[k] > 0 && p.point.probe_sd_m[k] > kRestlessNoiseFactor * usual_m[k];
    if (restless < kFewestRestless || 2 * restless < probes) continue;
    out.push_back(notice(NoticeCode::encoder_stood_still, "",
                         {{"position_mm", to_mm(p.point.position_m)},
                          {"length_s", ns_to_s(p.point.end_ns - p.point.begin_ns)},
                          {"changing", restless},
                          {"probes", probes}}));
  }
}

// Reports points at which a probe has no value because it was out of range.
void note_saturated_probes(const RunToJudge& run, Notices& out) {
  const auto& points = run.sequence.points;
  for (const Probe& probe : run.rig.probes) {
    const auto lost = std::count_if(points.begin(), points.end(), [&](const MeasuredPoint& p) {
      return has_flag(p.point, Flag::saturated, probe.id) &&
             has_flag(p.point, Flag::lost, probe.id);
    });
    if (lost == 0) continue;
    const double range_um = to_um(probe.range_m);
    out.push_back(static_cast<std::size_t>(lost) == points.size()
                      ? notice(NoticeCode::probe_saturated, probe.id, {{"range_um", range_um}})
                      : notice(NoticeCode::probe_beyond_range, probe.id,
                               {{"points", lost}, {"of", points.size()}, {"range_um", range_um}}));
  }
}

}  // namespace

Notices signal_notices(const RunToJudge& run) {
  Notices out;
  note_insensitive_probes(run, out);
  note_clipped_probes(run, out);
  note_frozen_encoder(run, out);
  note_saturated_probes(run, out);
  return out;
}

}  // namespace mdof::algo
