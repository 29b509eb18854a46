// A fingerprint of the scans of a dwell, to find two dwells with the same scans.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/sample.h"

namespace mdof::algo {

// Returns the smallest hash of all groups of eight consecutive scans in the rows `from` to `to` -
// 1; 0 if there are fewer than eight rows. A hash contains all bits of all probes and of the
// encoder. Two dwells over nearly the same scans have the same fingerprint, even if they begin at
// different scans. Method: min-wise hashing (Broder, On the resemblance and containment of
// documents, 1997).
std::uint64_t scan_fingerprint(const FrameBlock& frames, std::size_t from, std::size_t to);

}  // namespace mdof::algo
