#include "algo/iso230/positioning/positioning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

struct Approaches {
  std::vector<double> forward, reverse;
};
using ByTarget = std::map<double, Approaches>;  // key: target_m

std::string place_of(double target_m) {
  return "target " + plain_number(to_mm(target_m), 9) + " mm";
}

constexpr double kMost = 1e6;  // m, rad: avoids overflow of squares

Status check_reading(const PositioningReading& reading) {
  if (!(std::abs(reading.target_m) <= kMost && std::abs(reading.deviation) <= kMost))
    return bad_input("run " + std::to_string(reading.run) +
                     ": a target or deviation is not a finite number below 1000 km; check the "
                     "unit, or leave out the reading");
  if (reading.direction == 1 || reading.direction == -1) return {};
  return bad_input(place_of(reading.target_m) + ", run " + std::to_string(reading.run) +
                   ": the direction is " + std::to_string(reading.direction) +
                   "; give 1 (target approached in the + direction) or -1 (in the - direction)");
}

Result<ByTarget> by_target(const std::vector<PositioningReading>& readings) {
  ByTarget targets;
  for (const PositioningReading& reading : readings) {
    MDOF_CHECK(check_reading(reading));
    Approaches& at = targets[reading.target_m];
    (reading.direction > 0 ? at.forward : at.reverse).push_back(reading.deviation);
  }
  if (targets.size() >= 2) return targets;
  return bad_input(std::to_string(targets.size()) +
                   " target(s), but the parameters of ISO 230-2 need at least two targets (the "
                   "test plan of ISO 230-2 needs five); measure at more targets");
}

// One reading has no standard deviation, so each target needs two readings. A single run with one
// reading at each target is allowed, because it determines the means.
Status check_count(double target_m, const char* approach, std::size_t count, bool wanted,
                   bool single_run) {
  if (wanted ? count >= 2 || (single_run && count == 1) : count == 0) return {};
  const std::string place = place_of(target_m) + ": ";
  if (count == 0)
    return bad_input(
        place + "no reading in " + approach +
        " direction, but other targets have readings in this direction; measure this target in "
        "this direction, leave out this target, or leave out all readings in this direction");
  return bad_input(place + "only one reading in " + approach +
                   " direction, but repeatability needs at least two runs (ISO 230-2 needs five); "
                   "measure more runs, or leave out this target");
}

Status check_counts(const ByTarget& targets) {
  bool any_forward = false, any_reverse = false, single_run = true;
  for (const auto& [target_m, at] : targets) {
    any_forward |= !at.forward.empty();
    any_reverse |= !at.reverse.empty();
    single_run = single_run && at.forward.size() <= 1 && at.reverse.size() <= 1;
  }
  for (const auto& [target_m, at] : targets) {
    MDOF_CHECK(check_count(target_m, "forward", at.forward.size(), any_forward, single_run));
    MDOF_CHECK(check_count(target_m, "reverse", at.reverse.size(), any_reverse, single_run));
  }
  return {};
}

TargetApproach approach_of(const std::vector<double>& deviations) {
  TargetApproach a;
  a.n = deviations.size();
  if (a.n < 1) return a;
  const auto n = static_cast<double>(a.n);
  double sum = 0, square = 0;
  for (const double x : deviations) sum += x;
  a.mean = sum / n;
  if (a.n < 2) return a;
  for (const double x : deviations) square += (x - a.mean) * (x - a.mean);
  a.s = std::sqrt(square / (n - 1));
  a.R = 4 * a.s;
  return a;
}

PositioningTarget target_of(double target_m, const Approaches& at) {
  PositioningTarget t;
  t.target_m = target_m;
  t.forward = approach_of(at.forward);
  t.reverse = approach_of(at.reverse);
  if (t.forward.n == 0 || t.reverse.n == 0) return t;
  t.mean = (t.forward.mean + t.reverse.mean) / 2;
  t.B = t.forward.mean - t.reverse.mean;
  t.R = std::max({2 * t.forward.s + 2 * t.reverse.s + std::abs(t.B), t.forward.R, t.reverse.R});
  return t;
}

// The range from the smallest to the largest value; NaN if there is no value or a value is NaN.
class Range {
 public:
  void take(double low, double high) {
    known_ = known_ && std::isfinite(low) && std::isfinite(high);
    low_ = std::min(low_, low);
    high_ = std::max(high_, high);
  }
  double span() const { return known_ ? high_ - low_ : kNoFigure; }

 private:
  bool known_ = true;
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

struct OneApproach {
  Range means, bands;
  double R = kNoFigure;

  void take(const TargetApproach& a) {
    means.take(a.mean, a.mean);
    bands.take(a.mean - 2 * a.s, a.mean + 2 * a.s);
    R = std::fmax(R, a.R);
  }
};

void set_ranges(Positioning& p) {
  OneApproach forward, reverse, both;
  Range mean;
  for (const PositioningTarget& t : p.targets) {
    forward.take(t.forward);
    reverse.take(t.reverse);
    both.take(t.forward);
    both.take(t.reverse);
    mean.take(t.mean, t.mean);
  }
  p.R_forward = forward.R;
  p.R_reverse = reverse.R;
  p.E_forward = forward.means.span();
  p.E_reverse = reverse.means.span();
  p.E = both.means.span();
  p.M = mean.span();
  p.A_forward = forward.bands.span();
  p.A_reverse = reverse.bands.span();
  p.A = both.bands.span();
}

void set_reversal(Positioning& p) {
  double sum = 0;
  for (const PositioningTarget& t : p.targets) {
    sum += t.B;
    p.B = std::fmax(p.B, std::abs(t.B));
    p.R = std::fmax(p.R, t.R);
  }
  p.B_mean = sum / static_cast<double>(p.targets.size());
}

}  // namespace

Result<Positioning> positioning(const std::vector<PositioningReading>& readings) {
  MDOF_TRY(const ByTarget targets, by_target(readings));
  MDOF_CHECK(check_counts(targets));
  Positioning p;
  for (const auto& [target_m, at] : targets) p.targets.push_back(target_of(target_m, at));
  set_ranges(p);
  set_reversal(p);
  return p;
}

}  // namespace mdof::algo
