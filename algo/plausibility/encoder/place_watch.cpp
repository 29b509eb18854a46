#include "algo/plausibility/encoder/place_watch.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// Allowance for the noise of the encoder, and for spikes that the dwell detection removes.
constexpr double kNoise_m = 50e-6;
constexpr double kReturnRatio =
    0.1;  // ratio of the distances to the last place and to the stray position

}  // namespace

void PlaceWatch::begin_at(std::int64_t time_ns, double position_m) {
  begun_ = true;
  last_ = {time_ns, position_m};
}

// Returns a value above 0 if the axis cannot have moved from `from` to this position.
double PlaceWatch::out_of_reach_m(const Place& from, std::int64_t time_ns,
                                  double position_m) const {
  const double passed_s = 1e-9 * static_cast<double>(time_ns - from.time_ns);
  return std::abs(position_m - from.position_m) - max_speed_m_s_ * passed_s - kNoise_m;
}

bool PlaceWatch::is_placed(std::int64_t time_ns, double position_m) const {
  if (!std::isfinite(position_m)) return false;
  if (!begun_) return true;
  if (out_of_reach_m(last_, time_ns, position_m) > 0) return false;
  // After a long time the axis can have reached any position. So a position that the axis can have
  // reached from a stray position is also stray, unless it is near to the last place.
  return !is_stray_ || out_of_reach_m(stray_, time_ns, position_m) > 0 ||
         std::abs(position_m - last_.position_m) <
             kReturnRatio * std::abs(position_m - stray_.position_m);
}

std::size_t PlaceWatch::find_placed_end(const FrameBlock& frames, std::size_t from) {
  std::size_t i = from;
  for (; i < frames.size() && is_placed(frames.time_ns[i], frames.encoder_m[i]); ++i) {
    last_ = {frames.time_ns[i], frames.encoder_m[i]};
    is_stray_ = false;
  }
  return i;
}

void PlaceWatch::leave_out(std::int64_t time_ns, double position_m) {
  if (!std::isfinite(position_m)) {
    if (missing_++ == 0) first_missing_ns_ = time_ns;
    return;
  }
  if (too_fast_++ == 0) {
    first_too_fast_ns_ = time_ns;
    first_jump_m_ = position_m - last_.position_m;
    jumped_from_m_ = last_.position_m;
  }
  if (!is_stray_) astray_since_ns_ = time_ns;
  is_stray_ = true;
  stray_ = {time_ns, position_m};
}

std::size_t PlaceWatch::find_unplaced_end(const FrameBlock& frames, std::size_t from) {
  std::size_t i = from;
  for (; i < frames.size() && !is_placed(frames.time_ns[i], frames.encoder_m[i]); ++i)
    leave_out(frames.time_ns[i], frames.encoder_m[i]);
  return i;
}

Notices PlaceWatch::notices(std::int64_t start_ns) const {
  Notices all;
  if (missing_ > 0)
    all.push_back(
        notice(NoticeCode::position_missing, "",
               {{"scans", missing_}, {"first_s", ns_to_s(first_missing_ns_ - start_ns)}}));
  if (too_fast_ > 0)
    all.push_back(notice(NoticeCode::position_unreachable, "",
                         {{"scans", too_fast_},
                          {"jump_mm", to_mm(first_jump_m_)},
                          {"position_mm", to_mm(jumped_from_m_)},
                          {"first_s", ns_to_s(first_too_fast_ns_ - start_ns)},
                          {"max_speed_mm_s", to_mm(max_speed_m_s_)},
                          {"is_lost", is_stray_ ? 1 : 0}}));
  return all;
}

}  // namespace mdof::algo
