#include "algo/on_the_fly/target_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kMostBin_mm = 1;  // largest default length; a longer bin must be requested
constexpr double kLeastBin_mm = 1e-3;
constexpr double kMostTargets = 10'000;
constexpr double kAlike = 1e-9;      // tolerance of equal intervals, as share of an interval
constexpr double kPicometres = 1e9;  // per mm: rounds 3 times 0.1 mm to 0.3 mm

double least_distance_mm(const std::vector<double>& targets_m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < targets_m.size(); ++i)
    least_m = std::min(least_m, targets_m[i] - targets_m[i - 1]);
  return to_mm(least_m);
}

double apart_mm(const OnTheFlyOptions& options, const std::vector<double>& targets_m) {
  return options.interval_mm > 0 ? options.interval_mm : least_distance_mm(targets_m);
}

Status wrong(const char* key, const std::string& why) {
  return fail(ErrorCode::usage, std::string(key) + " " + why);
}

}  // namespace

std::string OnTheFlyOptions::json() const {
  JsonWriter json;
  json.begin_object().field("interval_mm", interval_mm).field("bin_mm", bin_mm);
  if (from_mm) json.field("from_mm", *from_mm);
  if (to_mm) json.field("to_mm", *to_mm);
  json.end_object();
  return json.take();
}

Status check_on_the_fly(const OnTheFlyOptions& o, const std::vector<double>& targets_m) {
  const auto finite = [](const std::optional<double>& x) { return !x || std::isfinite(*x); };
  if (!(o.interval_mm >= 0 && std::isfinite(o.interval_mm)))
    return wrong("interval_mm", "must be a finite number and not negative");
  if (o.interval_mm == 0 && targets_m.empty())
    return wrong("interval_mm", "must be greater than zero, because no targets are given");
  if (!finite(o.from_mm) || !finite(o.to_mm)) return wrong("from_mm, to_mm", "must be numbers");
  if (o.from_mm && o.to_mm && !(*o.to_mm > *o.from_mm))
    return wrong("to_mm", "must be greater than from_mm");
  if (o.interval_mm > 0 && o.from_mm && o.to_mm &&
      !((*o.to_mm - *o.from_mm) / o.interval_mm < kMostTargets))
    return wrong("interval_mm", "gives more than 10000 targets; give a larger interval");
  if (!(o.bin_mm >= 0 && std::isfinite(o.bin_mm)))
    return wrong("bin_mm", "must be 0 (automatic) or greater");
  const double apart = apart_mm(o, targets_m);
  if (o.bin_mm > apart * (1 + kAlike))
    return wrong("bin_mm", "must not exceed the interval of the targets, " + plain_number(apart) +
                               " mm; otherwise a reading would count at two targets");
  if (std::min(apart, o.bin_mm > 0 ? o.bin_mm : apart) < kLeastBin_mm)
    return wrong("interval_mm, bin_mm", "must be 0.001 or more");
  return {};
}

TargetGrid::TargetGrid(const OnTheFlyOptions& options, std::vector<double> targets_m)
    : options_(options), targets_m_(std::move(targets_m)) {
  const double bin_mm =
      options_.bin_mm > 0 ? options_.bin_mm : std::min(kMostBin_mm, apart_mm(options_, targets_m_));
  bin_m_ = from_mm(bin_mm);
}

TargetGrid::Target TargetGrid::at(std::int64_t place) const {
  if (options_.interval_mm == 0) return {place, targets_m_[static_cast<std::size_t>(place)]};
  const double at_mm =
      options_.from_mm.value_or(0) + static_cast<double>(place) * options_.interval_mm;
  return {place, from_mm(std::round(at_mm * kPicometres) / kPicometres)};
}

std::vector<TargetGrid::Target> TargetGrid::between(double low_m, double high_m,
                                                    std::size_t most) const {
  const double half_mm = to_mm(bin_m_) / 2;
  double low_mm = to_mm(low_m) + half_mm, high_mm = to_mm(high_m) - half_mm;
  if (options_.from_mm) low_mm = std::max(low_mm, *options_.from_mm);
  if (options_.to_mm) high_mm = std::min(high_mm, *options_.to_mm);
  std::vector<Target> targets;
  if (options_.interval_mm == 0) {
    for (std::size_t i = 0; i < targets_m_.size(); ++i)
      if (to_mm(targets_m_[i]) >= low_mm && to_mm(targets_m_[i]) <= high_mm)
        targets.push_back(at(static_cast<std::int64_t>(i)));
    return targets;
  }
  const double origin_mm = options_.from_mm.value_or(0);
  const double first = std::ceil((low_mm - origin_mm) / options_.interval_mm - kAlike);
  const double last = std::floor((high_mm - origin_mm) / options_.interval_mm + kAlike);
  if (!(last - first < static_cast<double>(most))) return targets;
  for (auto place = static_cast<std::int64_t>(first); static_cast<double>(place) <= last; ++place)
    targets.push_back(at(place));
  return targets;
}

std::vector<TargetGrid::Target> TargetGrid::known() const {
  if (options_.interval_mm > 0 && !(options_.from_mm && options_.to_mm)) return {};
  constexpr double kFar_m = 1e6;
  return between(-kFar_m, kFar_m, static_cast<std::size_t>(kMostTargets) + 1);
}

}  // namespace mdof::algo
