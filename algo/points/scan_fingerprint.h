// Recognises scans that come twice.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/sample.h"

namespace mdof::algo {

// A hash of eight consecutive scans, of all probes and the encoder to the last bit: of all such
// groups in the rows `from` to `to` - 1 the smallest hash (min-wise hashing: Broder, On the
// resemblance and containment of documents, 1997). So two dwells over nearly the same scans have
// the same, wherever each begins. 0: fewer than eight rows.
std::uint64_t scan_fingerprint(const FrameBlock& frames, std::size_t from, std::size_t to);

}  // namespace mdof::algo
