// Reports an encoder that sends no positions. Without positions no stop is found, and no event of a
// run states the reason.
#pragma once

#include <cstdint>
#include <optional>

#include "daemon/station/device/trouble.h"
#include "schema/sample.h"

namespace mdof::daemon {

// Thread-bound. Uses the times of the samples and no clock.
class PositionWatch {
 public:
  // Takes each block of a device. Returns the trouble that begins or ends with this block. Only
  // kind, text and channel of the trouble are set.
  std::optional<Trouble> take(const SampleBlock& block);

 private:
  std::optional<std::int64_t> placed_ns_;  // time of the last scan with a position
  bool reported_ = false;
};

}  // namespace mdof::daemon
