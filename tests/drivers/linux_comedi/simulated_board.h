// A Comedi board without the kernel, with the interface of comedilib. The clock of the board is
// the clock of the host. By default, the code of an input is scan % 500 + 1000 · (channel + 1).
// The board tests commands as the kernel's comedi_test does (drivers/comedi/drivers/comedi_test.c,
// waveform_ai_cmdtest).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/clock/monotonic.h"
#include "drivers/linux_comedi/board.h"

namespace mdof::drivers::linux_comedi {

struct Simulated {
  std::string driver = "sim_driver", name = "sim-6221";
  std::vector<Subdevice> subdevices = {{false, true, false, false, 1, 4},
                                       {true, true, false, false, 0b101, 8}};
  std::vector<Range> ranges = {{-10, 10}, {-5, 5}, {0, 10}, {0, 20, false}};
  std::uint32_t greatest_code = 65535;
  std::size_t buffer_bytes = 65536;
  unsigned scan_sources = kTimer | kFollow, convert_sources = kTimer, stop_sources = kNone | kCount;
  unsigned tick_ns = 1000;           // all periods are multiples of tick_ns
  unsigned least_convert_ns = 1000;  // shortest time between the conversions of two inputs
  bool refuses_inputs = false;       // true: rejects any combination of inputs
  Calibration calibration{"/var/lib/comedi/calibrations/sim", false, "", {}};
  std::function<std::uint32_t(std::uint64_t scan, unsigned channel)> code = [](std::uint64_t scan,
                                                                               unsigned channel) {
    return static_cast<std::uint32_t>(scan % 500 + 1000 * (channel + 1));
  };
  // Faults; -1: the fault does not occur.
  std::string open_error, start_error;
  std::int64_t overrun_at = -1, end_at = -1, unplug_at = -1, silent_at = -1;  // numbers of scans
  std::size_t most_bytes = 65536;  // largest number of bytes that one read returns
  // Records of the calls that the driver made.
  int opened = 0, closed = 0;
  Command started;
};

class SimulatedBoard final : public Board {
 public:
  explicit SimulatedBoard(std::shared_ptr<Simulated> of) : of_(std::move(of)) { ++of_->opened; }
  ~SimulatedBoard() override { ++of_->closed; }
  SimulatedBoard(const SimulatedBoard&) = delete;
  SimulatedBoard& operator=(const SimulatedBoard&) = delete;

  static BoardOpener opener(const std::shared_ptr<Simulated>& of) {
    return [of](const std::string& device) -> Result<std::unique_ptr<Board>> {
      if (!of->open_error.empty()) return io_error(device + ": " + of->open_error);
      return std::make_unique<SimulatedBoard>(of);
    };
  }

  std::string driver() const override { return of_->driver; }
  std::string name() const override { return of_->name; }
  std::vector<Subdevice> subdevices() override { return of_->subdevices; }
  std::vector<Range> ranges(unsigned, unsigned) override { return of_->ranges; }
  std::uint32_t greatest_code(unsigned, unsigned) override { return of_->greatest_code; }
  std::size_t buffer_bytes(unsigned) override { return of_->buffer_bytes; }
  Calibration calibrate(unsigned, const std::vector<BoardInput>&) override {
    return of_->calibration;
  }
  Result<Command> sources(unsigned subdevice) override {
    Command all;
    all.subdevice = subdevice;
    all.start.source = kNow;
    all.scan_begin.source = of_->scan_sources;
    all.convert.source = of_->convert_sources;
    all.scan_end.source = kCount;
    all.stop.source = of_->stop_sources;
    return all;
  }
  Result<int> test(Command& command) override;
  Status start(const Command& command) override;
  Result<Received> receive(std::span<char> into, std::chrono::milliseconds timeout) override;

 private:
  std::uint64_t scans_by_now() const;
  bool due(std::int64_t scan) const {
    return scan >= 0 && static_cast<std::int64_t>(scans_by_now()) >= scan;
  }
  void sample();

  std::shared_ptr<Simulated> of_;
  std::int64_t start_ns_ = 0;
  double period_ns_ = 0;
  std::uint64_t sampled_ = 0;
  std::string waiting_;
};

inline Result<int> SimulatedBoard::test(Command& command) {
  const auto one_of = [](unsigned source, unsigned all) {
    return source != 0 && (source & (source - 1)) == 0 && (source & all) == source;
  };
  if (!one_of(command.start.source, kNow) ||
      !one_of(command.convert.source, of_->convert_sources) ||
      !one_of(command.scan_begin.source, of_->scan_sources) ||
      !one_of(command.stop.source, of_->stop_sources))
    return 1;
  const Command asked = command;
  const auto whole = [this](unsigned& ns) {
    ns = std::max(1U, (ns + of_->tick_ns / 2) / of_->tick_ns) * of_->tick_ns;
  };
  if (command.convert.source == kTimer) {
    command.convert.argument = std::max(command.convert.argument, of_->least_convert_ns);
    if (command.convert.argument != asked.convert.argument) return 3;
    whole(command.convert.argument);
  }
  if (command.scan_begin.source == kTimer) {
    whole(command.scan_begin.argument);
    if (command.convert.source == kTimer)
      command.scan_begin.argument =
          std::max(command.scan_begin.argument,
                   command.convert.argument * static_cast<unsigned>(command.inputs.size()));
  }
  if (command.convert.argument != asked.convert.argument ||
      command.scan_begin.argument != asked.scan_begin.argument)
    return 4;
  return of_->refuses_inputs ? 5 : 0;
}

inline Status SimulatedBoard::start(const Command& command) {
  if (!of_->start_error.empty()) return io_error(of_->start_error);
  of_->started = command;
  period_ns_ = command.scan_begin.source == kTimer
                   ? command.scan_begin.argument
                   : command.convert.argument * static_cast<double>(command.inputs.size());
  start_ns_ = monotonic_ns();
  return {};
}

inline std::uint64_t SimulatedBoard::scans_by_now() const {
  return static_cast<std::uint64_t>(static_cast<double>(monotonic_ns() - start_ns_) / period_ns_);
}

inline void SimulatedBoard::sample() {
  std::uint64_t until = scans_by_now();
  for (const std::int64_t last : {of_->overrun_at, of_->end_at, of_->silent_at})
    if (last >= 0) until = std::min(until, static_cast<std::uint64_t>(last));
  for (; sampled_ < until; ++sampled_) {
    for (const BoardInput& input : of_->started.inputs) {
      const std::uint32_t wide = of_->code(sampled_, input.channel);
      const auto narrow = static_cast<std::uint16_t>(wide);
      if (of_->subdevices[of_->started.subdevice].long_samples) {
        waiting_.append(reinterpret_cast<const char*>(&wide), sizeof wide);
      } else {
        waiting_.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
      }
    }
  }
}

inline Result<Received> SimulatedBoard::receive(std::span<char> into,
                                                std::chrono::milliseconds timeout) {
  const std::int64_t until_ns = monotonic_ns() + timeout.count() * 1'000'000;
  do {
    if (due(of_->unplug_at)) return io_error("the board is gone");
    sample();
    const std::size_t bytes = std::min({into.size(), waiting_.size(), of_->most_bytes});
    if (bytes > 0) {
      std::memcpy(into.data(), waiting_.data(), bytes);
      waiting_.erase(0, bytes);
      return Received{bytes, StreamState::runs};
    }
    if (due(of_->overrun_at)) return Received{0, StreamState::overran};
    if (due(of_->end_at)) return Received{0, StreamState::ended};
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  } while (monotonic_ns() < until_ns);
  return Received{};
}

}  // namespace mdof::drivers::linux_comedi
