// One device at work: its thread "acq-<device>" makes the driver, opens it, reads it, and opens it
// again after an error, with growing pauses. What was lost on the way is told with the next block;
// that a device is lost, back, suspect or slow is told at once.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "daemon/station/trouble.h"
#include "drivers/registry.h"
#include "schema/sample.h"

namespace mdof::daemon {

struct DeviceStatus {
  std::string state = "closed";  // "open", "closed", "failed: reopening", "ended"
  std::string error;             // of the failure that holds; "": it is well
  std::string last_error;        // of the last one that is mended, and when that was
  std::string mended_utc;
  std::vector<Trouble> standing;  // what holds now
  drivers::DeviceInfo info;
  double measured_hz = 0;      // scans a second since it was opened; 0: not known yet
  std::uint64_t scans = 0;     // since the start
  std::uint64_t lost = 0;      // scans that are known to have been lost
  std::uint64_t dropped = 0;   // blocks the measuring thread had no room for
  std::uint64_t reopened = 0;  // times
};

// Calls from the station's threads, one at a time, but for status(), healthy(), cease(), wake()
// and trust_count().
class Acquisition {
 public:
  // Both on the acquiring thread. `pass` counts the readings of a source that is read once a run.
  struct Sink {
    // True: taken over. False: there was no room within `wait`, the block is untouched.
    std::function<bool(SampleBlock& block, std::uint64_t pass, std::chrono::milliseconds wait)>
        samples;
    // The source has come to its end, or, with a reason, to one it will not recover from.
    std::function<void(std::uint64_t pass, const std::string& reason, const drivers::SourceInfo&)>
        ended;
    std::function<void(const Trouble&)> trouble;  // may be none
  };

  Acquisition(drivers::DriverSpec spec, Sink sink);
  ~Acquisition();  // stops

  void start();
  void stop();                          // joins: at most a read's time-out and an open later
  void cease() { acquiring_ = false; }  // without waiting for it
  // Somebody has said where the axis stands: the datum is no longer lost.
  void trust_count();
  void wake() { woken_ = true; }  // a device was plugged in: the pause under way ends

  std::uint64_t pass() const { return pass_; }
  const drivers::DriverSpec& spec() const { return spec_; }
  DeviceStatus status() const;
  // Came round within `limit`, or has nothing to do.
  bool healthy(std::chrono::steady_clock::duration limit) const;

 private:
  void acquire(std::uint64_t pass);
  bool open_and_read(drivers::Driver& driver, std::uint64_t pass);
  bool read_until_trouble(drivers::Driver& driver, std::uint64_t pass);
  void hand_over(SampleBlock& block, std::uint64_t pass);
  void note_loss(SampleBlock& block);
  void measure_rate(const SampleBlock& block);
  void refresh_info(const drivers::Driver& driver);
  void pause();
  void set_state(const std::string& state);
  void fail(const std::string& error);
  bool mend(const SampleBlock& block);
  void watch_rate(std::uint64_t scans, std::uint64_t lost);
  void watch_datum(const drivers::DeviceInfo& info);
  void watch_clock(const drivers::Driver& driver, SampleBlock& block);
  void tell_clock(const drivers::ClockState& clock);
  void tell(Trouble::Kind kind, const std::string& text);

  const drivers::DriverSpec spec_;
  const Sink sink_;
  std::atomic<bool> acquiring_{false}, woken_{false}, trust_{false};
  std::atomic<std::chrono::steady_clock::time_point> turn_;
  mutable std::mutex status_mutex_;
  DeviceStatus status_;  // guarded by status_mutex_

  // Acquiring thread only.
  std::chrono::milliseconds backoff_{0};
  std::optional<std::int64_t> last_ns_;  // of the last scan that was read
  bool just_opened_ = false;             // no block since
  std::int64_t opened_ns_ = 0;           // of the first scan since, and how many there were
  std::uint64_t scans_since_opened_ = 0;
  std::chrono::steady_clock::time_point next_refresh_;
  std::uint64_t dropped_scans_ = 0;  // to be told with the next block
  std::optional<std::chrono::steady_clock::time_point> lost_since_;
  bool datum_lost_ = false;
  bool clock_in_doubt_ = false;
  std::uint64_t clock_steps_ = 0;
  std::chrono::steady_clock::time_point window_end_;  // of watch_rate()
  std::uint64_t scans_in_window_ = 0, lost_in_window_ = 0;

  std::uint64_t pass_ = 0;  // by whoever calls start()
  std::thread thread_;
};

}  // namespace mdof::daemon
