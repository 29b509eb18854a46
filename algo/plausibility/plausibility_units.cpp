// Checks whether the values of each quantity are plausible in the stated unit.
#include <algorithm>
#include <cmath>
#include <string>

#include "algo/plausibility/plausibility.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kLongestAxis_m = 2;  // longest plausible travel
constexpr double kShortestAxis_m = 0.5e-3;
constexpr double kSlowest_hz = 2;  // at a lower rate, the time is probably not in seconds
constexpr double kFastest_hz = 2e6;
constexpr double kLargestFixture_m = 0.5;
constexpr double kSmallestFixture_m = 0.5e-3;
constexpr double kNarrowFixture_m = 5e-3;  // a smaller fixture has no space for five probes
constexpr double kWideFixture_m = 0.15, kWideByTravel = 5;
constexpr double kQuietest_m = 0.5e-9;  // sd; the noise of every amplifier is larger
constexpr double kNoisiest = 2.5e-3;    // sd as share of the range
constexpr double kNoisiest_m = 1e-6;
constexpr double kThousandth = 1e-3;
// Smallest gap (middle between the extremes), as share of the range, of a probe that reads a gap
// and has no offset.
constexpr double kLeastMeanGapShare = 0.1;

double largest(const ProbeFigures& p) {
  return std::max(std::abs(p.min_m), std::abs(p.max_m));
}

// Returns whether all readings of the probe are within a thousandth of half its range, and its
// noise is below the noise of any amplifier. False for constant readings.
bool looks_like_mm(const ProbeFigures& figures, const Probe& probe) {
  return figures.points > 0 && figures.travel_m > 0 && figures.sd_m < kQuietest_m &&
         largest(figures) <= kThousandth * probe.range_m / 2;
}

bool looks_like_nm(const ProbeFigures& figures, const Probe& probe) {
  return figures.points > 0 && figures.sd_m > std::max(kNoisiest_m, kNoisiest * probe.range_m);
}

// Returns whether the probe reads a gap and the offset is missing. Without an offset, the
// "displacement" is the whole gap, which is never 0.
bool lacks_offset(const ProbeFigures& figures, const Probe& probe) {
  const Calibration& c = probe.calibration;
  return c.reads_gap && c.offset_um == 0 && figures.points > 0 && figures.max_m < 0 &&
         -0.5 * (figures.min_m + figures.max_m) > kLeastMeanGapShare * probe.range_m;
}

void judge_probes(const Rig& rig, const Plausibility& figures, Notices& out) {
  for (std::size_t k = 0; k < figures.probes.size(); ++k) {
    const ProbeFigures& probe = figures.probes[k];
    if (looks_like_mm(probe, rig.probes[k]))
      out.push_back(
          notice(NoticeCode::reading_too_small, probe.id, {{"largest_um", to_um(largest(probe))}}));
    if (looks_like_nm(probe, rig.probes[k]))
      out.push_back(
          notice(NoticeCode::reading_too_noisy, probe.id, {{"noise_um", to_um(probe.sd_m)}}));
    if (lacks_offset(probe, rig.probes[k]))
      out.push_back(notice(NoticeCode::gap_without_offset, probe.id,
                           {{"gap_um", -0.5 * to_um(probe.min_m + probe.max_m)}}));
  }
}

void judge_fixture(const Rig& rig, double travel_m, Notices& out) {
  double size_m = 0, origin_m = 0;
  for (const Probe& a : rig.probes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_m = std::max(origin_m, std::abs(a.position_m[axis]));
      for (const Probe& b : rig.probes)
        size_m = std::max(size_m, std::abs(a.position_m[axis] - b.position_m[axis]));
    }
  }
  const double width_mm = to_mm(size_m);
  if (std::max(size_m, origin_m) > kLargestFixture_m)
    out.push_back(
        notice(NoticeCode::fixture_too_large, "", {{"reach_m", std::max(size_m, origin_m)}}));
  else if (size_m > std::max(kWideFixture_m, kWideByTravel * travel_m))
    out.push_back(notice(NoticeCode::fixture_too_wide, "",
                         {{"width_mm", width_mm}, {"travel_mm", to_mm(travel_m)}}));
  if (size_m < kNarrowFixture_m && size_m >= kSmallestFixture_m)
    out.push_back(notice(NoticeCode::fixture_too_narrow, "", {{"width_mm", width_mm}}));
  if (size_m < kSmallestFixture_m)
    out.push_back(notice(NoticeCode::fixture_too_small, "", {{"width_mm", width_mm}}));
}

void judge_time(const Plausibility& figures, Notices& out) {
  if (figures.rate_hz < kSlowest_hz)
    out.push_back(notice(NoticeCode::rate_too_low, "", {{"rate_hz", figures.rate_hz}}));
  if (figures.rate_hz > kFastest_hz)
    out.push_back(notice(NoticeCode::rate_too_high, "", {{"rate_hz", figures.rate_hz}}));
}

}  // namespace

std::optional<Notice> encoder_unit_notice(double travel_m) {
  if (travel_m > kLongestAxis_m)
    return notice(NoticeCode::travel_too_long, "", {{"travel_m", travel_m}});
  if (travel_m < kShortestAxis_m)
    return notice(NoticeCode::travel_too_short, "", {{"travel_mm", to_mm(travel_m)}});
  return std::nullopt;
}

Notices unit_notices(const Rig& rig, const Plausibility& figures) {
  Notices out;
  const double travel_m = figures.encoder_max_m - figures.encoder_min_m;
  if (auto encoder = encoder_unit_notice(travel_m)) out.push_back(std::move(*encoder));
  judge_time(figures, out);
  judge_probes(rig, figures, out);
  judge_fixture(rig, travel_m, out);
  return out;
}

}  // namespace mdof::algo
