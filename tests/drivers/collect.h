// Collects the samples that a driver reads.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "drivers/driver.h"

namespace mdof::drivers {

struct Collected {
  std::vector<std::int64_t> time_ns;
  std::vector<std::vector<double>> scans;     // [scan][channel]
  std::vector<std::vector<Quality>> quality;  // [scan][channel]
  std::uint64_t lost = 0;
  std::string error;
  Quality first_quality(std::size_t scan) const { return quality.at(scan).at(0); }
};

// Reads until `scans` scans have arrived, an error occurs, or 20 s have elapsed.
inline Collected collect(Driver& driver, std::size_t scans) {
  Collected all;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  SampleBlock block;
  while (all.scans.size() < scans && std::chrono::steady_clock::now() < until) {
    const auto state = driver.read(block, std::chrono::milliseconds(20));
    if (!state) {
      all.error = state.error().message;
      break;
    }
    all.lost += block.lost;
    for (std::size_t i = 0; i < block.scans(); ++i) {
      all.time_ns.push_back(block.time_ns[i]);
      all.scans.emplace_back();
      all.quality.emplace_back();
      for (std::size_t k = 0; k < block.channels.size(); ++k) {
        all.scans.back().push_back(block.value[k][i]);
        all.quality.back().push_back(block.quality_at(k, i));
      }
    }
  }
  return all;
}

inline void expect_growing(const std::vector<std::int64_t>& times) {
  for (std::size_t i = 1; i < times.size(); ++i) ASSERT_LT(times[i - 1], times[i]);
}

}  // namespace mdof::drivers
