#include "algo/points/dwell.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "algo/points/flags.h"
#include "algo/points/frame_rows.h"
#include "algo/points/median.h"
#include "schema/base/json_writer.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kAutoTolerance_m = 2e-6;
// For noise with the standard deviation σ, the range of the medians of three readings over a window
// is at most about 5 σ.
constexpr double kAutoNoiseFactor = 6;
// Range of a stop in tolerances; a stop with a larger range creeps.
constexpr double kCreepFactor = 5.0;
constexpr std::size_t kRowsForPeriod = 33;
constexpr std::size_t kMinScansPerSlot = 4;
constexpr std::int64_t kHolePeriods = 5;  // > kMinScansPerSlot: a hole is longer than a slot
constexpr std::int64_t kShortestUnobserved_ns = 500'000'000;  // the axis may reverse in this time
constexpr double kMostCreep_m = 50e-6;   // largest creep of a stop that becomes a point
constexpr std::size_t kDropRows = 4096;  // rows that are dropped together

double median3(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace

std::string DwellOptions::json() const {
  JsonWriter json;
  json.begin_object()
      .field("tolerance_um", to_um(tolerance_m))
      .field("window_s", window_s)
      .field("settle_s", settle_s)
      .field("min_length_s", min_length_s)
      .field("approach_um", to_um(approach_m))
      .field("max_scans", static_cast<std::uint64_t>(max_scans));
  if (leave_s != 0) json.field("leave_s", leave_s);
  if (max_speed_m_s != DwellOptions().max_speed_m_s)
    json.field("max_speed_mm_s", to_mm(max_speed_m_s));
  json.end_object();
  return json.take();
}

DwellDetector::DwellDetector(DwellOptions options, std::vector<std::string> probe_ids,
                             std::vector<double> probe_range_m)
    : options_(options),
      probe_ids_(std::move(probe_ids)),
      probe_range_m_(std::move(probe_range_m)),
      resolution_(probe_ids_.size()),
      places_(options_.max_speed_m_s),
      early_(empty_frames(probe_ids_.size())),
      buffer_(empty_frames(probe_ids_.size())),
      watch_(probe_ids_.size()) {
  assert(probe_ids_.size() == probe_range_m_.size());
  summary_.needed_s = options_.shortest_s();
}

void DwellDetector::push(const FrameBlock& frames, std::vector<Point>& out) {
  std::size_t from = 0;
  if (period_ns_ == 0) {
    from = gather_early(frames);
    if (early_.size() < kRowsForPeriod) return;
    start(out);
  }
  push_from(frames, from, out);
}

// Collects the first kRowsForPeriod rows that have a position. Returns the index of the first row
// that is not collected.
std::size_t DwellDetector::gather_early(const FrameBlock& frames) {
  std::size_t from = 0;
  while (from < frames.size() && early_.size() < kRowsForPeriod) {
    const std::size_t placed = places_.find_placed_end(frames, from);
    const std::size_t to = std::min(placed, from + kRowsForPeriod - early_.size());
    append_rows(early_, frames, from, to);
    from = early_.size() < kRowsForPeriod ? places_.find_unplaced_end(frames, to) : to;
  }
  summary_.unplaced = places_.left_out();
  return from;
}

// Starts at the median of the first rows, because the first row alone may be wrong.
void DwellDetector::start(std::vector<Point>& out) {
  const FrameBlock early = std::exchange(early_, empty_frames(probe_ids_.size()));
  const double middle_m = median_of(early.encoder_m);
  learn_period(early);
  places_.begin_at(early.time_ns.front() - static_cast<std::int64_t>(kRowsForPeriod) * period_ns_,
                   middle_m);
  const bool first = places_.is_placed(early.time_ns.front(), early.encoder_m.front());
  begin_travelled_range(first ? early.encoder_m.front() : middle_m);
  push_from(early, 0, out);
}

void DwellDetector::push_from(const FrameBlock& frames, std::size_t from, std::vector<Point>& out) {
  while (from < frames.size()) {
    const std::size_t to = places_.find_placed_end(frames, from);
    if (to > from) push_rows(frames, from, to, out);
    from = places_.find_unplaced_end(frames, to);
    summary_.unplaced = places_.left_out();
  }
}

// Pushes the rows from ... to - 1, which all have a valid position.
void DwellDetector::push_rows(const FrameBlock& frames, std::size_t from, std::size_t to,
                              std::vector<Point>& out) {
  append_rows(buffer_, frames, from, to);
  while (row_ < buffer_.size()) {
    if (buffer_.time_ns[row_] - last_ns_ > hole_ns_) pass_hole();
    if (!breaks_.empty() && buffer_.time_ns[row_] > breaks_.front()) pass_break(out);
    const std::int64_t index = (buffer_.time_ns[row_] - origin_ns_) / slot_ns_;
    if (slot_open_ && index != open_.index) close_slot(out);
    if (!slot_open_) open_slot(index);
    const auto begin = buffer_.time_ns.begin() + static_cast<std::ptrdiff_t>(row_);
    std::int64_t until_ns = origin_ns_ + (index + 1) * slot_ns_;
    if (!breaks_.empty()) until_ns = std::min(until_ns, breaks_.front() + 1);
    const auto end = std::lower_bound(begin, buffer_.time_ns.end(), until_ns);
    add_rows(row_ + static_cast<std::size_t>(end - begin));
  }
  if (dwelling_ && truncated_) drop_cut_rows();
}

void DwellDetector::open_slot(std::int64_t index) {
  open_ = Slot{};
  open_.index = index;
  open_.first_row = row_;
  open_.unplaced = summary_.unplaced;
  slot_open_ = true;
}

void DwellDetector::learn_period(const FrameBlock& frames) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    steps.push_back(frames.time_ns[i] - frames.time_ns[i - 1]);
  }
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  period_ns_ = std::max<std::int64_t>(1, steps[steps.size() / 2]);
  slot_ns_ = std::max<std::int64_t>(shortest_slot_ns(), kMinScansPerSlot * period_ns_);
  hole_ns_ = std::max(window_ns(), kHolePeriods * period_ns_);
  origin_ns_ = last_ns_ = frames.time_ns.front();
  summary_.period_s = ns_to_s(period_ns_);
  // A stop fills one slot less than it is long, because it begins and ends within a slot.
  summary_.needed_s =
      std::max(options_.shortest_s(), ns_to_s(slot_ns_) * static_cast<double>(kSlotsPerWindow + 1));
}

void DwellDetector::begin_travelled_range(double position_m) {
  encoder_before_ = {position_m, position_m};
  summary_.encoder_min_m = summary_.encoder_max_m = position_m;
  travelled_range_ = {position_m, position_m};
}

// Adds the rows row_ ... to - 1 to the open slot.
void DwellDetector::add_rows(std::size_t to) {
  double low = open_.rows ? open_.min_m : std::numeric_limits<double>::infinity();
  double high = open_.rows ? open_.max_m : -low;
  double bend = open_.bend_m, sharp = open_.sharp_m;
  const double turn = turn_m();
  auto [before2, before1] = encoder_before_;
  for (std::size_t i = row_; i < to; ++i) {
    const double encoder = buffer_.encoder_m[i];
    const double voted = median3(before2, before1, encoder);
    low = std::min(low, voted);
    high = std::max(high, voted);
    motion_.follow(voted, turn);
    const double bent = std::abs(encoder - 2 * before1 + before2);
    bend += bent;
    sharp = std::max(sharp, bent);
    before2 = before1;
    before1 = encoder;
  }
  encoder_before_ = {before2, before1};
  for (std::size_t i = row_; i < to; ++i) {
    summary_.gaps += buffer_.time_ns[i] - last_ns_ > kGapPeriods * period_ns_;
    last_ns_ = buffer_.time_ns[i];
  }
  if (open_.rows == 0) open_.begin_ns = buffer_.time_ns[row_];
  open_.min_m = low;
  open_.max_m = high;
  open_.bend_m = bend;
  open_.sharp_m = sharp;
  open_.rows += to - row_;
  summary_.scans += to - row_;
  row_ = to;
}

double DwellDetector::window_range() const {
  double low = slots_.front().min_m, high = slots_.front().max_m;
  for (const Slot& slot : slots_) {
    low = std::min(low, slot.min_m);
    high = std::max(high, slot.max_m);
  }
  return high - low;
}

void DwellDetector::extend_travelled_range(const Slot& slot) {
  travelled_range_.min_m = std::min(travelled_range_.min_m, slot.min_m);
  travelled_range_.max_m = std::max(travelled_range_.max_m, slot.max_m);
  range_since_stop_.min_m = std::min(range_since_stop_.min_m, slot.min_m);
  range_since_stop_.max_m = std::max(range_since_stop_.max_m, slot.max_m);
  sharp_since_stop_m_ = std::max(sharp_since_stop_m_, slot.sharp_m);
}

void DwellDetector::close_slot(std::vector<Point>& out) {
  slot_open_ = false;
  slots_.push_back(open_);
  if (slots_.size() > kSlotsPerWindow) slots_.pop_front();
  summary_.encoder_min_m = std::min(summary_.encoder_min_m, open_.min_m);
  summary_.encoder_max_m = std::max(summary_.encoder_max_m, open_.max_m);
  if (open_.rows >= kMinScansPerSlot)
    encoder_noise_.add(open_.bend_m / static_cast<double>(open_.rows), open_.rows);
  summary_.tolerance_m = options_.tolerance_m > 0
                             ? options_.tolerance_m
                             : std::max(kAutoTolerance_m, kAutoNoiseFactor * encoder_noise_.sd());
  motion_.remember(open_.middle(), options_.approach_m);
  const bool still = window_still();
  examine_window(still);
  if (still && !dwelling_) begin_dwell();
  if (!still && dwelling_) end_dwell(out);
  if (!dwelling_) extend_travelled_range(slots_.back());
  if (dwelling_) {
    truncated_ = truncated_ || slots_.back().first_row >= cut_row_;
  } else {
    drop_rows_before(slots_.front().first_row);
  }
}

void DwellDetector::begin_dwell() {
  dwelling_ = true;
  truncated_ = false;
  still_since_ns_ = slots_.front().begin_ns;
  unplaced_before_ = slots_.front().unplaced;
  const double position_m = slots_.back().middle();
  const bool same_stop = continues_stop(position_m);
  if (!same_stop) direction_ = direction_to(position_m);
  // A larger range would be that of a wrong count.
  const bool is_short = slots_.front().begin_ns - left_ns_ <= 2 * slot_ns_;
  if (same_stop && is_short && !last_stop_is_point_) travelled_range_ = range_to_stop_;
  if (same_stop && is_short && last_stop_is_point_ &&
      range_since_stop_.max_m - range_since_stop_.min_m > turn_m())
    travelled_range_ = {left_m_, left_m_};
  range_to_stop_ = travelled_range_;
  drop_rows_before(slots_.front().first_row);
  cut_row_ = slots_.front().first_row + options_.max_scans;
}

// Call it when the newest slot has left the tolerance. The slot before it may contain the start of
// the motion.
void DwellDetector::end_dwell(std::vector<Point>& out) {
  dwelling_ = false;
  last_stop_is_point_ = false;
  left_ns_ = slots_.back().begin_ns;
  left_m_ = slots_[slots_.size() - 3].middle();
  range_since_stop_ = {left_m_, left_m_};
  sharp_since_stop_m_ = 0;
  const std::size_t end_row = std::min(find_rest_end(slots_[slots_.size() - 2]), cut_row_);
  const double still_s = ns_to_s(slots_[slots_.size() - 2].begin_ns - still_since_ns_);
  const auto settled_ns = still_since_ns_ + static_cast<std::int64_t>(options_.settle_s * 1e9);
  const auto first = std::lower_bound(buffer_.time_ns.begin(), buffer_.time_ns.end(), settled_ns);
  const auto first_row = static_cast<std::size_t>(first - buffer_.time_ns.begin());
  const bool long_enough = still_s >= options_.shortest_s() && end_row >= first_row + kMinScans;
  if (long_enough) {
    Point point = average(first_row, end_row);
    if (slots_[slots_.size() - 2].unplaced > unplaced_before_)
      add_flag(point, Flag::missing, "encoder");
    last_stop_is_point_ = keep_or_report(std::move(point), first_row, end_row, out);
  } else if (still_s >= options_.min_length_s) {
    note({DwellEventKind::short_stop, still_since_ns_, left_m_, 0, still_s});
  }
  if (last_stop_is_point_ || !long_enough) take_rest(still_s);
  if (last_stop_is_point_) {
    // The last slot at rest is not in still_s.
    summary_.brief_points += still_s + ns_to_s(slot_ns_) < summary_.needed_s ? 1 : 0;
    travel_observed_ = true;
    travelled_range_ = {left_m_, left_m_};
  } else if (summary_.passed_over.size() < kMaxPassedOver) {
    summary_.passed_over.push_back({left_m_, still_s, still_since_ns_, !long_enough});
  }
  extend_travelled_range(slots_[slots_.size() - 2]);
}

// Returns the first row of a stop whose reading may contain the next motion. `last` is the slot
// that may contain the start of this motion.
std::size_t DwellDetector::find_rest_end(const Slot& last) const {
  if (!(options_.leave_s > 0)) return last.first_row;
  const auto until_ns = last.begin_ns - std::llround(options_.leave_s * 1e9);
  const auto end = std::lower_bound(buffer_.time_ns.begin(), buffer_.time_ns.end(), until_ns);
  return static_cast<std::size_t>(end - buffer_.time_ns.begin());
}

// A stop that creeps by at most kMostCreep_m becomes a point at its mean position. A stop that
// creeps farther is a slow motion and becomes no point.
bool DwellDetector::keep_or_report(Point point, std::size_t first_row, std::size_t end_row,
                                   std::vector<Point>& out) {
  const auto begin = buffer_.encoder_m.begin() + static_cast<std::ptrdiff_t>(first_row);
  const auto end = buffer_.encoder_m.begin() + static_cast<std::ptrdiff_t>(end_row);
  const auto [low, high] = std::minmax_element(begin, end);
  const double crept_m = *high - *low;
  const bool spiky = has_flag(point, Flag::spike, "encoder");
  if (crept_m > kCreepFactor * summary_.tolerance_m && !spiky) {
    const bool kept = crept_m <= kMostCreep_m;
    const double length_s = ns_to_s(point.end_ns - point.begin_ns);
    note({kept ? DwellEventKind::crept : DwellEventKind::creep, point.begin_ns, point.position_m,
          std::copysign(crept_m, *(end - 1) - *begin), length_s});
    if (!kept) take_rest(length_s * summary_.tolerance_m / crept_m);
    if (!kept) return false;
    add_flag(point, Flag::creep);
  }
  if (travel_observed_)
    point.travel_min_m = range_to_stop_.min_m, point.travel_max_m = range_to_stop_.max_m;
  out.push_back(std::move(point));
  return true;
}

void DwellDetector::drop_rows_before(std::size_t row) {
  if (row >= kDropRows) drop_rows(row);
}

void DwellDetector::drop_rows(std::size_t row) {
  erase_rows(buffer_, 0, row);
  for (Slot& slot : slots_) slot.first_row -= std::min(slot.first_row, row);
  row_ -= row;
}

// The dwell continues, but max_scans is reached. Drops the rows of closed slots after the cut.
void DwellDetector::drop_cut_rows() {
  const std::size_t end = slot_open_ ? open_.first_row : row_;
  erase_rows(buffer_, cut_row_, end);
  for (Slot& slot : slots_) slot.first_row = std::min(slot.first_row, cut_row_);
  row_ -= end - cut_row_;
  open_.first_row -= end - cut_row_;
}

void DwellDetector::break_after(std::int64_t time_ns) {
  breaks_.push_back(time_ns);
}

// The axis was not observed for some time. Reports this; after a longer time the approach is
// unknown, too.
void DwellDetector::pass_hole() {
  const std::int64_t length_ns = buffer_.time_ns[row_] - last_ns_;
  const double before_m = encoder_before_[1];
  note({DwellEventKind::hole, last_ns_, before_m, buffer_.encoder_m[row_] - before_m,
        ns_to_s(length_ns)});
  const bool reported = !breaks_.empty() && breaks_.front() <= last_ns_;
  if (length_ns > std::max(kShortestUnobserved_ns, 2 * hole_ns_) && !reported) {
    breaks_.push_front(last_ns_);
  }
}

void DwellDetector::pass_break(std::vector<Point>& out) {
  breaks_.pop_front();
  end_visible_rows(out);
  slots_.clear();
  motion_.clear();
  left_ns_ = 0;
  travel_observed_ = false;
  encoder_before_.fill(buffer_.encoder_m[row_]);
}

void DwellDetector::flush(std::vector<Point>& out) {
  if (period_ns_ == 0 && early_.size() >= 2) start(out);
  end_visible_rows(out);
}

// The axis may still be at rest. Two empty slots replace the slots that would follow after the end
// of the rest.
void DwellDetector::end_visible_rows(std::vector<Point>& out) {
  if (slot_open_) close_slot(out);
  if (!dwelling_) return;
  Slot after = slots_.back();
  after.first_row = row_;
  after.begin_ns = last_ns_;
  after.unplaced = summary_.unplaced;
  slots_.push_back(after);
  slots_.push_back(after);
  end_dwell(out);
}

}  // namespace mdof::algo
