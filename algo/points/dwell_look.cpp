// Finds the direction of approach of a stop, and events besides the stops: creeping, jumps, and
// probes that froze or stepped.
#include <algorithm>
#include <cmath>

#include "algo/points/dwell.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// The axis has reversed if it moved back by more than this and kLeastTurn_m: the tolerances are for
// the noise of the encoder.
constexpr double kTurnTolerances = 5;
constexpr double kGreatest_m_s2 = 10;  // a larger acceleration is an error of the encoder
constexpr double kJumpTolerances = 10;
constexpr std::size_t kReach = 6;  // rows that find_jump() needs before and after a jump
constexpr std::int64_t kGlitch_ns = 1'000'000'000;
constexpr double kSlowTravel_m = 200e-6;  // a longer travel is a motion, not a creeping stop
constexpr std::size_t kMostEvents = 10'000;
// In a slow log, also stops that are just long enough fill too few slots at times. Fewer than one
// stop in kBriefPart is not reported.
constexpr std::size_t kBriefPart = 4;

}  // namespace

double DwellDetector::turn_m() const {
  return std::max(kLeastTurn_m, kTurnTolerances * summary_.tolerance_m);
}

// If the encoder is too noisy for the last motion, or the axis was not observed, only the path is
// used.
int DwellDetector::direction_to(double position_m) const {
  if (turn_m() >= options_.approach_m || !travel_observed_)
    return motion_.by_path(position_m, options_.approach_m);
  return motion_.by_last_motion(position_m, options_.approach_m, travelled_range_.min_m,
                                travelled_range_.max_m);
}

// Returns whether the axis continues the last stop: it was disturbed for a short time, or vibrated.
// In a slow log the slots are so long that the axis can move past an end target and return within
// one slot.
bool DwellDetector::continues_stop(double position_m) const {
  if (left_ns_ == 0 || std::abs(position_m - left_m_) >= options_.approach_m) return false;
  const double up_m = range_since_stop_.max_m - left_m_, down_m = left_m_ - range_since_stop_.min_m;
  const double farther_m = std::max(up_m, down_m);
  if (is_slow() && farther_m > options_.approach_m) return false;
  const bool both_sides = 2 * std::min(up_m, down_m) >= farther_m;
  if (slots_.front().begin_ns - left_ns_ > 2 * slot_ns_)
    return both_sides && farther_m <= options_.approach_m && farther_m > turn_m();
  const double period_s = ns_to_s(period_ns_);
  const bool is_motion = sharp_since_stop_m_ <= kGreatest_m_s2 * period_s * period_s;
  return both_sides || farther_m <= turn_m() || !is_motion;
}

void DwellDetector::note(const DwellEvent& event) {
  if (events_.size() < kMostEvents) events_.push_back(event);
}

// Examines the window that ends with the newest slot.
void DwellDetector::examine_window(bool still) {
  const Slot& newest = slots_.back();
  resolution_.add(buffer_, newest.first_row, newest.first_row + newest.rows);
  watch_.take_newest(buffer_, newest.first_row, newest.first_row + newest.rows, newest.min_m,
                     newest.max_m);
  if (slots_.size() < kSlotsPerWindow) return;
  const auto creep = slow_.take({slots_.front().begin_ns, newest.begin_ns, slots_.front().middle(),
                                 newest.middle(), window_range(), still},
                                summary_.tolerance_m, options_.shortest_s(), kSlowTravel_m);
  if (creep) note(*creep);
  const std::size_t end = newest.first_row + newest.rows;
  for (std::size_t k = 0; k + 1 < slots_.size(); ++k)
    if (slots_[k].first_row + slots_[k].rows != slots_[k + 1].first_row)
      return;  // rows were dropped
  if (buffer_.time_ns[end - 1] - slots_.front().begin_ns > 8 * slot_ns_) return;  // a gap
  watch_.look_for_steps(
      {buffer_, slots_[0].first_row, slots_[1].first_row, slots_[2].first_row, end});
  find_encoder_jump();
}

// A jump of the count that is reversed within a second is a glitch; the positions after a glitch
// are correct.
void DwellDetector::find_encoder_jump() {
  const std::size_t begin = slots_.front().first_row;
  const std::size_t rows = slots_.back().first_row + slots_.back().rows - begin;
  if (rows <= 2 * kReach) return;
  const std::int64_t until_ns = buffer_.time_ns[begin + rows - kReach - 1];
  const double least_m = kJumpTolerances * summary_.tolerance_m;
  const bool sharp = std::any_of(slots_.begin(), slots_.end(),
                                 [&](const Slot& slot) { return slot.sharp_m > least_m; });
  if (sharp) {
    const auto begin_row = buffer_.time_ns.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto from =
        std::upper_bound(begin_row, begin_row + static_cast<std::ptrdiff_t>(rows), jumps_until_ns_);
    const auto jump =
        find_jump({&buffer_.time_ns[begin], rows}, {&buffer_.encoder_m[begin], rows},
                  static_cast<std::size_t>(from - begin_row), rows - kReach, period_ns_, least_m);
    if (jump) {
      jumped_m_ += jump->size_m;
      last_jump_ = *jump;
      const bool back = !events_.empty() && events_.back().kind == DwellEventKind::jump &&
                        jump->time_ns - events_.back().time_ns < kGlitch_ns &&
                        std::abs(events_.back().size_m + jump->size_m) < 0.5 * least_m;
      if (back) {
        events_.pop_back();
      } else {
        note({DwellEventKind::jump, jump->time_ns, jump->position_m, jump->size_m, 0});
      }
    }
  }
  jumps_until_ns_ = std::max(jumps_until_ns_, until_ns);
}

bool DwellDetector::crept() const {
  return std::any_of(summary_.passed_over.begin(), summary_.passed_over.end(),
                     [](const Summary::PassedOver& stop) { return !stop.too_short; });
}

std::string DwellDetector::why_no_stop() const {
  const std::string tolerance = plain_number(to_um(summary_.tolerance_m)) + " um";
  const std::string longest = plain_number(summary_.longest_still_s) + " s";
  if (crept())
    return "the axis moved slowly for " + longest + ": by at most " + tolerance + " within each " +
           plain_number(options_.window_s) +
           " s, but in total too far for one stop, so mdof cannot separate the stops";
  const std::string needed =
      ", but a stop must last " + plain_number(summary_.needed_s, 3) + " s" +
      (is_slow() ? ", because the log has only " + plain_number(1 / summary_.period_s, 3) +
                       " scans per second"
                 : "");
  if (summary_.longest_still_s == 0)
    return "the axis never stayed within " + tolerance + " for " +
           plain_number(ns_to_s(slot_ns_) * static_cast<double>(kSlotsPerWindow), 3) + " s" +
           needed;
  return "the axis stayed within " + tolerance + " for at most " + longest + needed;
}

void DwellDetector::mark(std::vector<Point>& points) const {
  for (Point& point : points) {
    for (std::size_t k = 0; k < point.probe_u_m.size(); ++k)
      if (point.probe_u_m[k] == 0)
        point.probe_u_m[k] = with_resolution(0, 0, resolution_.step_m(k));
  }
  watch_.mark(points, probe_ids_);
}

Notices DwellDetector::notices(const std::vector<Point>& points) const {
  Notices all = event_notices(events_, points, origin_ns_, summary_.needed_s);
  if (kBriefPart * summary_.brief_points >= points.size() && summary_.brief_points > 0)
    all.push_back(notice(NoticeCode::stops_may_be_missed, "",
                         {{"stops", summary_.brief_points},
                          {"points", points.size()},
                          {"needed_s", summary_.needed_s},
                          {"rate_hz", 1 / summary_.period_s}}));
  append(all, places_.notices(origin_ns_));
  append(all, probe_notices(watch_, probe_ids_, origin_ns_));
  return all;
}

}  // namespace mdof::algo
