// A driver, its simulated controller on real sockets, and the samples that the driver reads.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "drivers/capancdt/capancdt.h"
#include "drivers/capancdt/simulated_capancdt.h"
#include "tests/drivers/served_device.h"

namespace mdof::drivers::capancdt {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

// The input with index n shows a constant 100 (n + 1) µm.
inline double steady(std::size_t input, std::int64_t) {
  return 100.0 * static_cast<double>(input + 1);
}

inline Options options_for(const ServedDevice& served) {
  Options options;
  options.name = "probes";
  options.command = {"127.0.0.1", served.port(0)};
  for (const int number : {1, 3}) {
    const std::string text = std::to_string(number);
    options.channels.push_back(
        {{number == 1 ? "A" : "B", text, 0, "rig.toml:7: channel.id"}, number, 0});
  }
  options.sample_time_us = 512;
  options.reply_timeout = 2000ms;
  options.warm_up = 10ms;
  return options;
}

struct Rack {
  explicit Rack(const SimulatedCapancdt::Options& as = {}, const Senses& senses = steady) {
    SimulatedCapancdt::Options with_port = as;
    with_port.data_port = served.port(1);
    device = std::make_unique<SimulatedCapancdt>(senses, with_port);
    served.serve(*device);
    options = options_for(served);
  }
  std::unique_ptr<SimulatedCapancdt> device;  // must outlive `served`
  ServedDevice served{2};
  Options options;
};

struct Collected {
  SampleBlock all;
  std::uint64_t lost = 0;
  std::string error;  // the error that ended the reading

  std::size_t count(std::size_t channel, Quality quality) const {
    const auto& q = all.quality[channel];
    return static_cast<std::size_t>(std::count(q.begin(), q.end(), quality));
  }
};

inline void append(SampleBlock& all, const SampleBlock& block) {
  all.value.resize(block.channels.size());
  all.quality.resize(block.channels.size());
  all.time_ns.insert(all.time_ns.end(), block.time_ns.begin(), block.time_ns.end());
  for (std::size_t i = 0; i < block.channels.size(); ++i) {
    const auto& value = block.value[i];
    all.value[i].insert(all.value[i].end(), value.begin(), value.end());
    for (std::size_t k = 0; k < block.scans(); ++k)
      all.quality[i].push_back(block.quality_at(i, k));
  }
}

// Reads until `scans` scans have arrived or an error occurs.
inline Collected collect(Capancdt& driver, std::size_t scans) {
  Collected got;
  SampleBlock block;
  const auto until = steady_clock::now() + 20s;
  while (got.all.scans() < scans && steady_clock::now() < until) {
    const auto state = driver.read(block, 20ms);
    if (!state) {
      got.error = state.error().message;
      break;
    }
    got.lost += block.lost;
    append(got.all, block);
  }
  const auto& t = got.all.time_ns;
  // Less_equal: two equal times are not allowed.
  EXPECT_TRUE(std::is_sorted(t.begin(), t.end(), std::less_equal<>()));
  return got;
}

// True if the device clock had a step. If this computer stalls for 0.1 s, the clock has a step.
inline bool clock_stepped(const Capancdt& driver) {
  return driver.health().clock.steps > 0;
}
inline std::string error_of(const Status& status) {
  return status ? "" : status.error().message;
}
inline void expect_has(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text;
}

}  // namespace mdof::drivers::capancdt
