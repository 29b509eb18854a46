// Driver of a simulated axis. The axis moves and has errors, noise and faults.
//
// All random numbers are hashes of seed, channel and scan number, and no transcendental function of
// the C library is used. Therefore the same seed and options produce the same bits with every
// compiler, both in the values and in the times since the first open(). The number of scans per
// read has no effect.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/simulator/clock.h"
#include "drivers/simulator/machine.h"
#include "drivers/simulator/options.h"

namespace mdof::drivers {

// Thread-bound. Channels: see Machine::channels(). Good samples have Quality::simulated.
//
// pace = "real-time": scans are returned in packets, when the clock has reached their times. During
// a disconnect open() fails, and the scans of this time are lost.
// pace = "fast": each read() returns scans immediately, and open() continues after the end of the
// disconnect.
class Simulator final : public Driver {
 public:
  // Error: the options do not fit the rig (fit_to_rig()).
  static Result<std::unique_ptr<Simulator>> make(std::string name, const Rig& rig,
                                                 SimulatorOptions options, ForwardModel model,
                                                 Clock clock = steady_clock());

  DeviceInfo info() const override;
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  // For tests: the machine with its true errors and its motion; the targets.
  const Machine& machine() const { return machine_; }
  const std::vector<double>& targets_mm() const { return options_.targets_mm; }

 private:
  Simulator(std::string name, const Rig& rig, SimulatorOptions options, ForwardModel model,
            Clock clock);

  std::int64_t time_of(std::uint64_t scan) const;        // ns since the first open()
  std::uint64_t first_scan_at(std::int64_t t_ns) const;  // first scan at t_ns or later
  std::int64_t now() const;                              // ns since the first open()
  std::int64_t wait_for_packet(std::chrono::milliseconds timeout) const;
  bool ended(std::int64_t t_ns) const;
  const Interval* disconnect_at(std::int64_t t_ns) const;
  void append(SampleBlock& block, std::int64_t t_ns);

  std::string name_, description_;
  SimulatorOptions options_;
  Machine machine_;
  Clock clock_;
  std::vector<Channel> channels_;
  std::optional<std::int64_t> start_ns_;  // time of the clock at the first open()
  const Interval* gone_ = nullptr;        // disconnect that read() has reached; open() clears it
  std::uint64_t next_ = 0;                // number of the next scan
  std::uint64_t lost_ = 0;                // number of lost scans since the last returned scan
};

}  // namespace mdof::drivers
