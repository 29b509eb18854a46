#include "algo/plausibility/probe/probe_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "algo/plausibility/probe/probe_step.h"
#include "algo/points/dwell_event.h"
#include "algo/points/flags.h"
#include "algo/points/median.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestRows = 128, kLongerThanEver = 8, kFewestStops = 3;
constexpr std::size_t kFewestChanges = 16;  // necessary to determine the resolution
constexpr double kShareOfTravel = 0.8, kLeastTravel_m = 1e-3;
constexpr double kSteps = 4;          // times the resolution: more than rounding
constexpr double kNoise = 12;         // times the noise in the stops
constexpr double kNoNoise_m = 1e-12;  // rounding errors of exact numbers
constexpr std::size_t kMostSteps = 256;

bool all_usable(const FrameBlock& frames, std::size_t probe, std::size_t first, std::size_t last) {
  const auto& quality = frames.probe_quality[probe];
  return quality.empty() ||
         std::all_of(quality.begin() + static_cast<std::ptrdiff_t>(first),
                     quality.begin() + static_cast<std::ptrdiff_t>(last), usable);
}

}  // namespace

void ProbeWatch::take_newest(const FrameBlock& frames, std::size_t first, std::size_t last,
                             double low_m, double high_m) {
  axis_low_m_ = moved_ ? std::min(axis_low_m_, low_m) : low_m;
  axis_high_m_ = moved_ ? std::max(axis_high_m_, high_m) : high_m;
  moved_ = true;
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    Probe& probe = probes_[k];
    const double* const x = &frames.probe_m[k][first];
    const std::size_t n = last - first;
    std::size_t i = 0;
    while (probe.begun && i < n && x[i] == probe.held_m) ++i;
    if (i == n && all_usable(frames, k, first, last)) {
      probe.rows += n;
      hold(probe, k, low_m, high_m);
      continue;
    }
    const double newest = x[n - 1];
    release(probe, newest, frames.time_ns[last - 1]);
    std::size_t same = 0;
    while (same < n && x[n - 1 - same] == newest) ++same;
    probe.rows = same;
    probe.since_ns = frames.time_ns[last - std::max<std::size_t>(same, 1)];
    probe.axis_low_m = low_m;
    probe.axis_high_m = high_m;
  }
}

void ProbeWatch::hold(Probe& probe, std::size_t index, double low_m, double high_m) {
  probe.axis_low_m = std::min(probe.axis_low_m, low_m);
  probe.axis_high_m = std::max(probe.axis_high_m, high_m);
  if (probe.is_frozen || (!noise_says_frozen(probe) && !travel_says_frozen(probe))) return;
  probe.is_frozen = true;
  probe.frozen.push_back({index, probe.since_ns, INT64_MAX, probe.held_m});
}

void ProbeWatch::release(Probe& probe, double reading_m, std::int64_t time_ns) {
  if (probe.is_frozen) {
    probe.frozen.back().end_ns = time_ns;
  } else if (probe.begun) {
    probe.longest = std::max(probe.longest, probe.rows);
  }
  const double held_m = probe.begun ? probe.held_m : reading_m;
  if (std::isfinite(held_m)) {
    probe.low_m = probe.changed ? std::min(probe.low_m, held_m) : held_m;
    probe.high_m = probe.changed ? std::max(probe.high_m, held_m) : held_m;
    probe.changed = probe.begun;
  }
  probe.is_frozen = false;
  ++probe.changes;
  probe.begun = true;
  probe.held_m = reading_m;
}

bool ProbeWatch::noise_says_frozen(const Probe& probe) const {
  return probe.rows >= std::max(kFewestRows, kLongerThanEver * probe.longest) &&
         probe.stops >= kFewestStops && probe.noisy_stops == probe.stops;
}

bool ProbeWatch::travel_says_frozen(const Probe& probe) const {
  const double travel_m = axis_high_m_ - axis_low_m_;
  return probe.rows >= kFewestRows && probe.changes >= kFewestChanges &&
         travel_m >= kLeastTravel_m &&
         probe.axis_high_m - probe.axis_low_m >= kShareOfTravel * travel_m &&
         probe.high_m - probe.low_m >= std::max(kSteps * probe.resolution_m, kNoNoise_m);
}

// A stop in which the probe freezes is ignored.
void ProbeWatch::take_stop(std::size_t probe, const RobustMean& mean, double resolution_m) {
  Probe& p = probes_[probe];
  p.resolution_m = resolution_m;
  if (p.is_frozen || (mean.sd == 0 && p.noisy_stops == p.stops && p.stops >= kFewestStops)) return;
  ++p.stops;
  p.noisy_stops += mean.sd > std::max(kNoNoise_m, resolution_m);
  p.sd_m.push_back(mean.sd);
}

void ProbeWatch::look_for_steps(const Rows& rows) {
  for (const ProbeStep& step :
       find_steps(rows.frames, rows.begin, rows.first, rows.last, rows.end)) {
    auto& steps = probes_[step.probe].steps;
    if (steps.size() < kMostSteps)
      steps.push_back({step.probe, rows.frames.time_ns[step.row], step.size_m});
  }
}

std::vector<FrozenProbe> ProbeWatch::frozen() const {
  std::vector<FrozenProbe> all;
  const auto noisy = [](const Probe& p) {
    return p.stops >= kFewestStops && p.noisy_stops == p.stops;
  };
  const auto alive = std::count_if(probes_.begin(), probes_.end(), noisy);
  for (std::size_t k = 0; k < probes_.size(); ++k) {
    const Probe& p = probes_[k];
    for (const FrozenProbe& f : p.frozen) {
      all.push_back(f);
      all.back().at_limit = is_at_limit(p, f.value_m);
    }
    if (never_changed(p) && 2 * alive >= static_cast<std::ptrdiff_t>(probes_.size()) - 1)
      all.push_back({k, p.since_ns, INT64_MAX, p.held_m});
  }
  return all;
}

bool ProbeWatch::is_at_limit(const Probe& p, double value_m) {
  const bool came_back = std::any_of(p.frozen.begin(), p.frozen.end(), [&](const FrozenProbe& f) {
    return f.value_m == value_m && f.end_ns != INT64_MAX;
  });
  return came_back &&
         (value_m <= std::min(p.low_m, p.held_m) || value_m >= std::max(p.high_m, p.held_m));
}

bool ProbeWatch::never_changed(const Probe& p) const {
  return p.begun && !p.changed && p.frozen.empty() && p.rows >= kFewestRows &&
         axis_high_m_ - axis_low_m_ >= kLeastTravel_m;
}

bool ProbeWatch::is_dead() const {
  const auto dead = std::count_if(probes_.begin(), probes_.end(),
                                  [this](const Probe& p) { return never_changed(p); });
  return probes_.size() > 1 && dead + 1 >= static_cast<std::ptrdiff_t>(probes_.size());
}

// Many small steps are a property of the probe, so they are not reported.
std::vector<SteppedProbe> ProbeWatch::steps() const {
  std::vector<SteppedProbe> all;
  for (const Probe& p : probes_) {
    if (p.steps.empty()) continue;
    const double noise_m = p.sd_m.empty() ? 0 : median_of(p.sd_m);
    const double least_m = std::max(kNoise * noise_m, kSteps * p.resolution_m);
    std::vector<SteppedProbe> large;
    for (const SteppedProbe& s : p.steps)
      if (std::abs(s.size_m) > std::max(least_m, kNoNoise_m)) large.push_back(s);
    if (large.size() < kMostSteps / 2) all.insert(all.end(), large.begin(), large.end());
  }
  return all;
}

void ProbeWatch::mark(std::vector<Point>& points, const std::vector<std::string>& ids) const {
  for (const FrozenProbe& f : frozen()) {
    for (Point& p : points) {
      if (p.end_ns < f.begin_ns || p.begin_ns > f.end_ns) continue;
      p.probe_m[f.probe] = p.probe_u_m[f.probe] = kNaN;
      add_flag(p, Flag::frozen, ids[f.probe]);
    }
  }
  for (const SteppedProbe& s : steps())
    for (Point& p : points)
      if (p.end_ns >= s.time_ns) add_flag(p, Flag::step, ids[s.probe]);
}

Notices probe_notices(const ProbeWatch& watch, const std::vector<std::string>& ids,
                      std::int64_t start_ns) {
  Notices frozen, stepped, all;
  for (const FrozenProbe& f : watch.frozen()) {
    const bool to_the_end = f.end_ns == INT64_MAX;
    frozen.push_back(notice(
        f.at_limit ? NoticeCode::probe_at_limit : NoticeCode::probe_frozen, ids[f.probe],
        {{"from_s", ns_to_s(f.begin_ns - start_ns)},
         {"to_s", to_the_end ? NoticeValue("the end") : NoticeValue(ns_to_s(f.end_ns - start_ns))},
         {"reading_um", to_um(f.value_m)}}));
  }
  for (const SteppedProbe& s : watch.steps())
    stepped.push_back(
        notice(NoticeCode::probe_stepped, ids[s.probe],
               {{"step_um", to_um(s.size_m)}, {"time_s", ns_to_s(s.time_ns - start_ns)}}));
  if (watch.is_dead()) all.push_back(notice(NoticeCode::probes_dead));
  append_first(all, std::move(frozen));
  append_first(all, std::move(stepped));
  return all;
}

}  // namespace mdof::algo
