#include "daemon/measure/points/suspect_encoder.h"

#include <algorithm>
#include <utility>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::daemon {

void SuspectEncoder::push(const SampleBlock& raw) {
  const auto is_encoder = [](const Channel& channel) { return channel.id == kEncoderChannel; };
  const auto at = std::find_if(raw.channels.begin(), raw.channels.end(), is_encoder);
  if (raw.scans() == 0 || at == raw.channels.end()) return;
  const auto channel = static_cast<std::size_t>(at - raw.channels.begin());
  if (!raw.quality.empty() && !raw.quality[channel].empty())
    take(raw, raw.quality[channel]);
  else if (std::exchange(now_, false))
    end_stretch();
}

void SuspectEncoder::end_stretch() {
  const double length_s =
      ns_to_s(suspect_intervals_.back().end_ns - suspect_intervals_.back().begin_ns);
  if (length_s < shortest_s_) suspect_intervals_.pop_back();
}

void SuspectEncoder::take(const SampleBlock& raw, const std::vector<Quality>& quality) {
  const auto suspect = [](Quality q) { return q == Quality::suspect; };
  if (!now_ && std::none_of(quality.begin(), quality.end(), suspect)) return;
  device_ = raw.device;
  for (std::size_t i = 0; i < quality.size(); ++i) {
    const bool was = std::exchange(now_, suspect(quality[i]));
    if (was && !now_) end_stretch();
    if (!now_) continue;
    if (!was) suspect_intervals_.push_back({raw.time_ns[i], raw.time_ns[i]});
    suspect_intervals_.back().end_ns = raw.time_ns[i];
  }
}

bool SuspectEncoder::covers(const Point& point) const {
  return std::any_of(suspect_intervals_.begin(), suspect_intervals_.end(),
                     [&](const Stretch& stretch) {
                       return stretch.begin_ns <= point.begin_ns && point.end_ns <= stretch.end_ns;
                     });
}

bool SuspectEncoder::touches(const Point& point) const {
  return std::any_of(suspect_intervals_.begin(), suspect_intervals_.end(),
                     [&](const Stretch& stretch) {
                       return stretch.begin_ns <= point.end_ns && point.begin_ns <= stretch.end_ns;
                     });
}

Notice SuspectEncoder::left_out(std::size_t points, double from_s) const {
  return notice(NoticeCode::stops_not_placed, device_, {{"points", points}, {"from_s", from_s}});
}

}  // namespace mdof::daemon
