// A moving axis with errors, noise and faults: an ordinary driver without a machine.
//
// All randomness is a hash of seed, channel and scan number, and no transcendental function of the
// C library takes part: the same seed and options give the same bits from every compiler, in
// values and in times since the first open(), in whatever portions they are read.
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

// Thread-bound. Channels: see Machine. Good samples are Quality::simulated.
//
// pace = "real-time": a scan comes when the clock has reached its time, in packets; after a
// disconnect open() fails until it is over, and what was due meanwhile is lost.
// pace = "fast": each read() gives scans at once, and open() after a disconnect goes on behind it.
class Simulator final : public Driver {
 public:
  // Errors: options that do not fit the rig (see fit_to_rig).
  static Result<std::unique_ptr<Simulator>> make(std::string name, const Rig& rig,
                                                 SimulatorOptions options, ForwardModel model,
                                                 Clock clock = steady_clock());

  DeviceInfo info() const override;
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  // For tests: the truth, its motion, and its targets.
  const Machine& machine() const { return machine_; }
  const std::vector<double>& targets_mm() const { return options_.targets_mm; }

 private:
  Simulator(std::string name, const Rig& rig, SimulatorOptions options, ForwardModel model,
            Clock clock);

  std::int64_t time_of(std::uint64_t scan) const;        // ns since the first open()
  std::uint64_t first_scan_at(std::int64_t t_ns) const;  // its time is t_ns or later
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
  std::optional<std::int64_t> start_ns_;  // clock at the first open()
  const Interval* gone_ = nullptr;        // the disconnect that read() ran into, until open()
  std::uint64_t next_ = 0;                // scan
  std::uint64_t lost_ = 0;                // since the last scan that was handed out
};

}  // namespace mdof::drivers
