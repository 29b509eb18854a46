// Fills a SampleBlock, one scan at a time.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "schema/sample.h"

namespace mdof::drivers {

// Removes all scans of `block`; its memory is reused.
inline void start_block(SampleBlock& block, const std::string& device,
                        const std::vector<Channel>& channels) {
  block.device = device;
  block.channels = channels;
  block.lost = 0;
  block.time_ns.clear();
  block.value.resize(channels.size());
  block.quality.resize(channels.size());
  for (auto& column : block.value) column.clear();
  for (auto& column : block.quality) column.clear();
}

// Reserves memory for `scans` scans. Without it, a block would allocate memory several times while
// it grows.
inline void reserve_scans(SampleBlock& block, std::size_t scans) {
  block.time_ns.reserve(scans);
  for (auto& column : block.value) column.reserve(scans);
  for (auto& column : block.quality) column.reserve(scans);
}

// `values`: one value for each channel. A NaN gets Quality::missing; all other values get
// `quality`.
inline void add_scan(SampleBlock& block, std::int64_t time_ns, std::span<const double> values,
                     Quality quality = Quality::good) {
  assert(values.size() == block.channels.size());
  block.time_ns.push_back(time_ns);
  for (std::size_t i = 0; i < values.size(); ++i) {
    block.value[i].push_back(values[i]);
    block.quality[i].push_back(std::isnan(values[i]) ? Quality::missing : quality);
  }
}

}  // namespace mdof::drivers
