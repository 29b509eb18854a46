#include "daemon/station/device/position_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mdof::daemon {

constexpr std::int64_t kPatience_ns = 1'000'000'000;

std::optional<Trouble> PositionWatch::take(const SampleBlock& block) {
  const auto encoder =
      std::find_if(block.channels.begin(), block.channels.end(),
                   [](const Channel& channel) { return channel.id == kEncoderChannel; });
  if (encoder == block.channels.end() || block.scans() == 0) return std::nullopt;
  const auto& position = block.value[static_cast<std::size_t>(encoder - block.channels.begin())];
  if (std::any_of(position.begin(), position.end(), [](double x) { return std::isfinite(x); })) {
    placed_ns_ = block.time_ns.back();
    if (!std::exchange(reported_, false)) return std::nullopt;
    return Trouble{Trouble::Kind::back, "", "the encoder sends positions again", "",
                   kEncoderChannel};
  }
  if (!placed_ns_) placed_ns_ = block.time_ns.front();
  if (reported_ || block.time_ns.back() - *placed_ns_ < kPatience_ns) return std::nullopt;
  reported_ = true;
  return Trouble{Trouble::Kind::position, "",
                 "the encoder has sent no position for 1 s, so no stop is found; check the "
                 "encoder, its cable and its channel",
                 "", kEncoderChannel};
}

}  // namespace mdof::daemon
