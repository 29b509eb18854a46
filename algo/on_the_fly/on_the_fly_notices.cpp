// Notices of a run in motion.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "algo/on_the_fly/bin_fit.h"
#include "algo/on_the_fly/on_the_fly.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kNmPerM = 1e9, kMicroseconds = 1e6, kMilliseconds = 1e3;
// Wavelength in bins; shorter waves are measured more than 1 % too small.
constexpr double kSeenWave = 2.5;
// Smallest difference of the speeds that is reported, as share of the smaller speed.
constexpr double kOtherSpeed = 0.1;
constexpr double kBriefDelay_s = 1e-6;
// Smallest shift that is reported. It is below 50 um, because the size of a jump has an error.
constexpr double kLeastShift_m = 40e-6;

struct Speeds {
  double min_m_s = INFINITY, max_m_s = 0, sum_m_s = 0, n = 0;
  double mean_m_s() const { return sum_m_s / n; }
};

Speeds speeds_of(const std::vector<PassBins>& passes) {
  Speeds speeds;
  for (const PassBins& pass : passes) {
    for (const BinPoint& bin : pass.bins) {
      speeds.min_m_s = std::min(speeds.min_m_s, bin.speed_m_s);
      speeds.max_m_s = std::max(speeds.max_m_s, bin.speed_m_s);
      speeds.sum_m_s += bin.speed_m_s;
      speeds.n += 1;
    }
  }
  return speeds;
}

std::string mm_s(double speed_m_s) {
  return plain_number(to_mm(speed_m_s), 4) + " mm/s";
}

// Returns the root mean square over all bins of the standard deviation of the readings of a probe.
double scatter_m(const std::vector<PassBins>& passes, std::size_t probe) {
  double square = 0, n = 0;
  for (const PassBins& pass : passes) {
    for (const BinPoint& bin : pass.bins) {
      const double sd = bin.point.probe_sd_m[probe];
      if (!std::isfinite(sd)) continue;
      square += sd * sd;
      n += 1;
    }
  }
  return std::sqrt(square / n);
}

std::string scatter_text(const std::vector<PassBins>& passes, const ProbesOfBins& probes) {
  std::string text;
  for (std::size_t k = 0; k < probes.ids.size(); ++k)
    text += (k == 0 ? "" : ", ") + probes.ids[k] + " " +
            plain_number(scatter_m(passes, k) * kNmPerM, 3);
  return text;
}

Notice delays_notice(const std::vector<ReadingLag>& lags, const ProbesOfBins& probes) {
  std::string found, unknown;
  double worst_1 = 0;
  for (std::size_t k = 0; k < lags.size(); ++k) {
    const ReadingLag& lag = lags[k];
    worst_1 = std::max(worst_1, lag.largest_slope_1 * lag.speed_m_s);
    if (std::isnan(lag.delay_s)) {
      unknown += (unknown.empty() ? "" : ", ") + probes.ids[k];
      continue;
    }
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s %+.1f ± %.1f µs", probes.ids[k].c_str(),
                  lag.delay_s * kMicroseconds, lag.u_delay_s * kMicroseconds);
    found += (found.empty() ? "" : ", ") + std::string(text.data());
  }
  return notice(NoticeCode::delays_by_motion, "",
                {{"delays_us", found},
                 {"unknown", unknown},
                 {"effect_nm", worst_1 * 100 / kMicroseconds * kNmPerM}});
}

Notice delay_notice(const std::string& id, const ReadingLag& lag) {
  return notice(NoticeCode::reading_delayed, id,
                {{"delay_ms", lag.delay_s * kMilliseconds},
                 {"u_delay_ms", lag.u_delay_s * kMilliseconds},
                 {"effect_nm", lag.effect_m * kNmPerM},
                 {"speed_mm_s", to_mm(lag.speed_m_s)},
                 {"backlash_um", to_um(2 * std::abs(lag.delay_s) * lag.speed_m_s)}});
}

// Returns whether the omitted bin is between accepted bins of its pass. Outside the accepted bins
// the axis accelerates or decelerates.
bool is_within(const PassBins& pass, const BinLeftOut& left) {
  const auto beyond = [&](const BinPoint& bin) {
    return (bin.point.position_m - left.position_m) * pass.direction > 0;
  };
  const auto n = std::count_if(pass.bins.begin(), pass.bins.end(), beyond);
  return n > 0 && n < static_cast<std::ptrdiff_t>(pass.bins.size());
}

Notice left_out_notice(const BinLeftOut& left, std::int64_t begin_ns) {
  const NoticeCode code = left.fault == BinFault::speed_changes ? NoticeCode::bin_of_changing_speed
                          : left.fault == BinFault::gap         ? NoticeCode::bin_with_gap
                                                                : NoticeCode::bin_with_few_scans;
  return notice(
      code, "",
      {{"position_mm", to_mm(left.position_m)}, {"time_s", ns_to_s(left.begin_ns - begin_ns)}});
}

std::size_t count_left_out(const std::vector<PassBins>& passes, BinFault fault) {
  std::size_t n = 0;
  for (const PassBins& pass : passes)
    for (const BinLeftOut& left : pass.left_out) n += left.fault == fault;
  return n;
}

struct Stretch {
  double way_m = 0, passed_s = 0;
};

// The stretch from the first to the last bin that was left out, so without the pauses and ramps at
// both ends of the pass. Without such bins, the whole pass.
Stretch stretch_of(const PassBins& pass) {
  if (pass.left_out.size() < 2)
    return {std::abs(pass.to_m - pass.from_m), ns_to_s(pass.end_ns - pass.begin_ns)};
  const BinLeftOut &first = pass.left_out.front(), &last = pass.left_out.back();
  return {std::abs(last.position_m - first.position_m), ns_to_s(last.begin_ns - first.begin_ns)};
}

// After a jump, all positions are shifted.
Notices jump_notices(const std::vector<EncoderJump>& jumps, std::int64_t begin_ns) {
  Notices all;
  double shift_m = 0;
  std::int64_t shifted_ns = 0;
  for (const EncoderJump& jump : jumps) {
    all.push_back(notice(NoticeCode::encoder_jump, "",
                         {{"jump_um", to_um(jump.size_m)},
                          {"position_mm", to_mm(jump.position_m)},
                          {"time_s", ns_to_s(jump.time_ns - begin_ns)}}));
    shift_m += jump.size_m;
    if (shifted_ns == 0 && std::abs(shift_m) > kLeastShift_m) shifted_ns = jump.time_ns;
  }
  Notices found;
  append_first(found, std::move(all));
  if (shifted_ns != 0)
    found.push_back(
        notice(NoticeCode::targets_shifted, "",
               {{"time_s", ns_to_s(shifted_ns - begin_ns)}, {"shift_mm", to_mm(shift_m)}}));
  return found;
}

}  // namespace

Status OnTheFly::check_has_points() const {
  const bool any = std::any_of(passes_.begin(), passes_.end(),
                               [](const PassBins& pass) { return !pass.bins.empty(); });
  if (any) return {};
  const double travel_m = summary_.encoder_max_m - summary_.encoder_min_m;
  const std::string travel = plain_number(to_mm(summary_.encoder_min_m), 6) + " to " +
                             plain_number(to_mm(summary_.encoder_max_m), 6) + " mm";
  if (summary_.scans == 0) return bad_input("no scan has an encoder position");
  if (passes_.empty())
    return bad_input("the axis travels from " + travel +
                         ", but this range contains no complete bin of " +
                         plain_number(to_mm(grid_.bin_m())) + " mm around a target",
                     Remedy::smaller_bins);
  std::size_t bins = 0;
  double way_m = 0, passed_s = 0;
  bool dense = false;
  for (const PassBins& pass : passes_) {
    dense = dense || pass.too_dense;
    const Stretch stretch = stretch_of(pass);
    way_m += stretch.way_m;
    passed_s += stretch.passed_s;
    bins += pass.left_out.size();
  }
  const double speed_m_s = way_m / passed_s, rate_hz = 1 / summary_.period_s;
  const double needed_m = static_cast<double>(kLeastReadingsPerBin + 1) * speed_m_s / rate_hz;
  // If the mean speed allows enough scans in a bin, the axis stops between the bins and passes the
  // bins fast. Larger bins would then contain the stops.
  const bool too_small = needed_m > grid_.bin_m();
  if (too_small && (dense || count_left_out(passes_, BinFault::too_few) > 0)) {
    return bad_input("at " + mm_s(speed_m_s) + " and " + plain_number(rate_hz) + " Hz, a bin of " +
                         plain_number(to_mm(grid_.bin_m())) + " mm has " +
                         plain_number(grid_.bin_m() / speed_m_s * rate_hz, 3) +
                         " scans, but needs " + std::to_string(kLeastReadingsPerBin),
                     Remedy::larger_bins, plain_number(to_mm(needed_m), 3));
  }
  return bad_input("the axis does not move at a steady speed in any of the " +
                       std::to_string(bins) + " bins from " + travel + " (" +
                       plain_number(to_mm(travel_m), 4) +
                       " mm of travel): in each bin, the axis stops or changes its speed",
                   Remedy::replay_with_stops);
}

Notices OnTheFly::notices() const {
  Notices all, within;
  for (const PassBins& pass : passes_)
    for (const BinLeftOut& left : pass.left_out)
      if (left.fault != BinFault::speed_changes || is_within(pass, left))
        within.push_back(left_out_notice(left, begin_ns_));
  append_first(all, std::move(within));
  const Speeds speeds = speeds_of(passes_);
  if (speeds.max_m_s > (1 + kOtherSpeed) * speeds.min_m_s)
    all.push_back(
        notice(NoticeCode::speed_varies, "",
               {{"from_mm_s", to_mm(speeds.min_m_s)}, {"to_mm_s", to_mm(speeds.max_m_s)}}));
  append(all, jump_notices(jumps_.jumps(), begin_ns_));
  // After a jump, the difference between forward and reverse is no delay.
  const auto found = jumps_.jumps().empty() ? lags() : std::vector<ReadingLag>{};
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k].significant && std::abs(found[k].delay_s) > kBriefDelay_s)
      all.push_back(delay_notice(probes_.ids[k], found[k]));
  append(all, places_.notices(begin_ns_));
  append(all, probe_notices(watch_, probes_.ids, begin_ns_));
  return all;
}

Notices OnTheFly::statements() const {
  const Speeds speeds = speeds_of(passes_);
  if (speeds.n == 0) return {};
  const auto passes = std::count_if(passes_.begin(), passes_.end(),
                                    [](const PassBins& pass) { return !pass.bins.empty(); });
  const double bin_mm = to_mm(grid_.bin_m());
  return {notice(NoticeCode::measured_on_the_fly, "",
                 {{"passes", passes},
                  {"speed_mm_s", to_mm(speeds.mean_m_s())},
                  {"from_mm_s", to_mm(speeds.min_m_s)},
                  {"to_mm_s", to_mm(speeds.max_m_s)},
                  {"bin_mm", bin_mm},
                  {"left_out", count_left_out(passes_, BinFault::speed_changes)},
                  {"seen_mm", kSeenWave * bin_mm}}),
          notice(NoticeCode::motion_scatter, "",
                 {{"scatter_nm", scatter_text(passes_, probes_)},
                  {"slowest_hz", 2 * speeds.mean_m_s() / grid_.bin_m()}}),
          delays_notice(lags(), probes_)};
}

}  // namespace mdof::algo
