// The driver, and a simulated T7 on real sockets.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "drivers/labjack_t7/labjack_t7.h"
#include "drivers/labjack_t7/simulated_labjack_t7.h"
#include "tests/drivers/served_device.h"

namespace mdof::drivers::labjack_t7::test {

using namespace std::chrono_literals;

inline constexpr double kRate_Hz = 4000;

// True values of the inputs. AIN0 rises by 1 V/s from 0 V at construction. AIN1 is outside of its
// range. The counter is (ns since construction) / 1000 - 40.
struct Truth {
  std::int64_t zero_ns =
      std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  double operator()(std::size_t input, std::int64_t t_ns) const {
    if (input == 0) return static_cast<double>(t_ns - zero_ns) * 1e-9;
    if (input == 1) return 20;
    if (input == 4) return 0.9;
    if (input == 5) return 0.25;
    if (input < SimulatedLabjackT7::kCounterInput) return -1.5;
    const double per_count_ns = input == SimulatedLabjackT7::kCounterInput + 1 ? 4000 : 1000;
    return std::floor(static_cast<double>(t_ns - zero_ns) / per_count_ns);
  }
};

inline std::vector<Input> inputs() {
  std::vector<Input> all = {{{"A", Unit::volt}, 0, 0},
                            {{"B", Unit::volt}, 1, 0},
                            {{"C", Unit::volt}, 2, 0},
                            {{"encoder", Unit::um}, -1, -0.5}};
  return all;
}

class LabjackT7Driver : public testing::Test {
 protected:
  void serve(const SimulatedLabjackT7::Faults& faults, SimulatedLabjackT7::Options options = {}) {
    options.faults = faults;
    options.core_start = core_start;
    device = std::make_unique<SimulatedLabjackT7>(truth, options);
    served = std::make_unique<ServedDevice>(*device);
    settings.name = "daq";
    settings.command = {"127.0.0.1", served->port(0)};
    settings.stream = {"127.0.0.1", served->port(1)};
    settings.rate_hz = kRate_Hz;
    settings.inputs = inputs();
    settings.inputs.back().dio = dio;
    settings.samples_per_packet = quick_packet(kRate_Hz, 5);
  }
  LabjackT7& driver() {
    if (!made) made = std::make_unique<LabjackT7>(settings);
    return *made;
  }
  std::string refusal() {
    const Status opened = driver().open();
    return opened ? "opened" : opened.error().message;
  }
  // Reads until `scans` scans have arrived. Returns the error that ended the reading, or "".
  std::string read(std::size_t scans) {
    SampleBlock block;
    const auto until = std::chrono::steady_clock::now() + 20s;
    while (time_ns.size() < scans && std::chrono::steady_clock::now() < until) {
      const auto state = driver().read(block, 50ms);
      if (!state) return state.error().message;
      if (block.scans() > 0) losses.push_back(block.lost);
      time_ns.insert(time_ns.end(), block.time_ns.begin(), block.time_ns.end());
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t s = 0; s < block.scans(); ++s) {
          value[c].push_back(block.value[c][s]);
          quality[c].push_back(block.quality_at(c, s));
        }
    }
    return time_ns.size() < scans ? "too few scans" : "";
  }
  std::uint64_t lost() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : losses) sum += n;
    return sum;
  }

  // Sets CORE_TIMER so that it now reads about `ticks`, to within some seconds.
  void core_reads(std::uint32_t ticks) {
    // 40 MHz; the number may wrap.
    core_start = ticks - static_cast<std::uint32_t>(truth.zero_ns / 25);
  }

  Truth truth;
  std::uint32_t core_start = 0xFFF00000;
  int dio = 0;  // DIO number of the encoder
  std::unique_ptr<SimulatedLabjackT7> device;
  std::unique_ptr<ServedDevice> served;
  Settings settings;
  std::unique_ptr<LabjackT7> made;
  std::vector<std::int64_t> time_ns;
  std::vector<double> value[4];
  std::vector<Quality> quality[4];
  std::vector<std::uint64_t> losses;
};

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace mdof::drivers::labjack_t7::test
