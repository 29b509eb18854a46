#include "daemon/station/unrecorded.h"

#include <algorithm>

#include "drivers/scan_block.h"

namespace mdof::daemon {

void Unrecorded::add(const SampleBlock& block) {
  // Typical number of scans of a device between two calls of take().
  constexpr std::size_t kReservedScans = 256;
  const auto last = std::find_if(blocks_.rbegin(), blocks_.rend(),
                                 [&](const auto& b) { return b.device == block.device; });
  if (last != blocks_.rend() && last->channels == block.channels && block.lost == 0)
    return append_scans(*last, block, 0, block.scans());
  SampleBlock& fresh = blocks_.emplace_back();
  drivers::start_block(fresh, block.device, block.channels);
  drivers::reserve_scans(fresh, std::max(kReservedScans, block.scans()));
  append_scans(fresh, block, 0, block.scans());
  fresh.lost = block.lost;
}

}  // namespace mdof::daemon
