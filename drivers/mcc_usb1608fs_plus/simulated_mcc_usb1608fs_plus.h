// A simulated USB-1608FS-Plus. It implements the USB interface of the device.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/mcc_usb1608fs_plus/protocol.h"
#include "drivers/simulated_wiring.h"
#include "drivers/usb/simulated_usb.h"

namespace mdof::drivers::mcc_usb1608fs_plus {

// Senses: inputs 0 ... 7 are CH0 ... CH7 in V, all sampled at the time of the scan.
class SimulatedMccUsb1608fsPlus final : public usb::SimulatedUsb {
 public:
  // Possible faults. The scans of each run are numbered from 0. A fault `..._at` occurs at the
  // first scan whose number is equal to or greater than this value; -1: never.
  struct Faults {
    std::int64_t overrun_at = -1;  // the FIFO overflows: `overrun` scans are missing
    std::uint64_t overrun = 1000;
    bool stalls = false;  // the endpoint stalls at an overrun even if kNoStall is set
    // One scan is missing without a report (a real device does not do this).
    std::int64_t drop_at = -1;
    std::size_t short_packets = 0;  // number of bytes after which each transfer ends
    std::int64_t silent_at = -1;    // no more scans arrive, although the status is "running"
    std::int64_t unplug_at = -1;    // the device is unplugged before this scan
    bool running = false;  // a stream is already running at the start, as after a crash of the host
  };
  struct Options {
    std::string serial = "01A2B3C4";
    Calibrations calibrations = {};
    Faults faults = {};
  };
  SimulatedMccUsb1608fsPlus(Senses senses, const Options& options);

  const usb::Identity& identity() const override { return identity_; }
  usb::Reply control(const usb::Setup& setup, std::string_view out, std::int64_t now_ns) override;
  usb::Reply in(std::uint8_t endpoint, std::size_t max_bytes, std::int64_t now_ns) override;
  usb::Reply out(std::uint8_t endpoint, std::string_view bytes, std::int64_t now_ns) override;
  void clear_halt(std::uint8_t endpoint) override;
  bool gone() const override { return gone_; }

  void set_faults(const Faults& faults) { faults_ = faults; }
  void restart();  // power is switched off and on: all settings have their defaults
  // Replaces the calibration memory.
  void set_memory(const std::string& memory) { memory_ = memory; }
  std::uint64_t runs() const { return runs_; }  // number of runs that were started

 private:
  struct Run {
    ScanSetup setup;
    std::int64_t start_ns = 0;
    std::uint64_t next = 0;  // number of the next scan; lost scans are counted too
  };
  usb::Reply read_request(const usb::Setup& setup) const;
  usb::Reply start(std::string_view out, std::int64_t now_ns);
  void take_scans(std::int64_t now_ns);
  bool apply_due_fault();
  void sample(std::int64_t t_ns);

  Senses senses_;
  Faults faults_;
  usb::Identity identity_;
  Calibrations calibrations_;
  std::string memory_, ranges_ = std::string(kInputs, '\0');
  std::optional<Run> run_;
  std::string fifo_;  // data that the host has not read yet
  std::uint64_t runs_ = 0;
  bool overrun_ = false, halted_ = false, gone_ = false;
};

// Makes the twin from a plan of mdof-simulate. The inputs CH0 ... CH7 are in V.
Result<std::unique_ptr<SimulatedDevice>> make_simulated_mcc_usb1608fs_plus(SimulatedWiring& wiring);

}  // namespace mdof::drivers::mcc_usb1608fs_plus
