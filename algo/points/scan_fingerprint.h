// Recognises repeated scans.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/sample.h"

namespace mdof::algo {

// The smallest hash of all groups of eight consecutive scans (all probes and the encoder, to the
// last bit) in the rows `from` to `to` - 1 (min-wise hashing: Broder, On the resemblance and
// containment of documents, 1997). So two dwells over nearly the same scans have the same
// fingerprint, even if they begin at different scans. 0: fewer than eight rows.
std::uint64_t scan_fingerprint(const FrameBlock& frames, std::size_t from, std::size_t to);

}  // namespace mdof::algo
