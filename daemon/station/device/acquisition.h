// Reads one device. The thread "acq-<device>" creates the driver, opens the device and reads it.
// After an error, the thread waits and opens the device again; the waiting time increases with each
// error. The next block states the number of lost scans. A change of the state of the device (lost,
// back, suspect, slow) is reported at once.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "daemon/station/device/device_reader.h"
#include "daemon/station/device/position_watch.h"
#include "daemon/station/device/rate_watch.h"
#include "daemon/station/device/trouble.h"
#include "drivers/driver_spec.h"
#include "schema/sample.h"

namespace mdof::daemon {

class Acquisition final : public DeviceReader {
 public:
  using Sink = DeviceSink;

  Acquisition(drivers::DriverSpec spec, Sink sink);
  ~Acquisition() override;

  void start() override;
  void stop() override;  // joins the thread; this takes at most the time of one read and one open
  void request_stop() override { acquiring_ = false; }
  void trust_count() override { trust_encoder_count(kEncoderChannel); }
  // As trust_count(), for one encoder. `encoder`: id of its channel in the device.
  void trust_encoder_count(const std::string& encoder);
  void wake() override { woken_ = true; }

  std::uint64_t pass() const override { return pass_; }
  const drivers::DriverSpec& spec() const override { return spec_; }
  DeviceStatus status() const override;
  bool healthy(std::chrono::steady_clock::duration limit) const override;

 private:
  void acquire(std::uint64_t pass);
  bool open_and_read(drivers::Driver& driver, std::uint64_t pass);
  bool read_until_trouble(drivers::Driver& driver, std::uint64_t pass);
  void deliver(SampleBlock& block, std::uint64_t pass);
  void note_loss(SampleBlock& block);
  void measure_rate(const SampleBlock& block);
  void refresh_info(const drivers::Driver& driver);
  void pause();
  void set_state(const std::string& state);
  void fail(const std::string& error);
  bool recover(const SampleBlock& block);
  void watch_rate(std::uint64_t scans, std::uint64_t lost);
  void watch_datum(const drivers::DeviceInfo& info);
  void watch_mark(const drivers::Driver& driver);
  void forget_suspicion(const std::string& encoder);  // status_mutex_ must be locked
  void watch_clock(const drivers::Driver& driver, SampleBlock& block);
  void report_clock(const drivers::ClockState& clock);
  void report(Trouble::Kind kind, const std::string& text, const std::string& channel = "");
  void trust_counts(drivers::Driver& driver);

  const drivers::DriverSpec spec_;
  const Sink sink_;
  std::atomic<bool> acquiring_{false}, woken_{false};
  std::atomic<std::chrono::steady_clock::time_point> turn_;
  mutable std::mutex status_mutex_;
  DeviceStatus status_;            // protected by status_mutex_
  std::set<std::string> trusted_;  // encoders for which the thread must still call trust_count() of
                                   // the driver; protected by status_mutex_

  // Used by the acquisition thread only.
  std::chrono::milliseconds backoff_{0};
  std::optional<std::int64_t> last_ns_;  // time of the last scan that was read
  bool just_opened_ = false;             // true until the first block after the device was opened
  std::int64_t opened_ns_ = 0;           // time of the first scan after the device was opened
  std::uint64_t scans_since_opened_ = 0;
  std::chrono::steady_clock::time_point next_refresh_;
  std::uint64_t dropped_scans_ = 0;  // number of dropped scans; the next block reports this number
  std::optional<std::chrono::steady_clock::time_point> lost_since_;
  std::set<std::string> datum_lost_;  // channel ids of the encoders with a lost datum
  int marks_passed_ = 0;
  bool clock_is_uncertain_ = false;
  std::uint64_t clock_steps_ = 0;
  PositionWatch position_;
  RateWatch rate_;

  std::uint64_t pass_ = 0;  // number of the pass; only start() changes it
  std::thread thread_;
};

}  // namespace mdof::daemon
