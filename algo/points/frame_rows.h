// Appends and erases rows of a frame block.
#pragma once

#include <cstddef>

#include "schema/sample.h"

namespace mdof::algo {

FrameBlock empty_frames(std::size_t probes);
// Appends rows `first` to `last` - 1 of `from` to `to`.
void append_rows(FrameBlock& to, const FrameBlock& from, std::size_t first, std::size_t last);
void erase_rows(FrameBlock& frames, std::size_t first, std::size_t last);

}  // namespace mdof::algo
