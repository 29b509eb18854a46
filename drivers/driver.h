// A driver turns the data of a device into SampleBlocks. The simulator and the replay are drivers
// too. Therefore all later code also runs without hardware.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/sample.h"

namespace mdof::drivers {

struct DeviceInfo {
  std::string name;               // from the configuration, unique
  std::string driver;             // name in registry.cpp: "qsb"; for "replay": "csv" or "recording"
  std::string description;        // one line of text for users
  std::vector<Channel> channels;  // empty until open() if only the device itself knows its channels
  double rate_hz = 0;             // scans per second; 0: not known
  bool simulated = false;  // true: there is no real machine; every result is marked as simulated
  std::optional<ClockState> clock;  // set if the device counts its samples or sends time stamps
  // Reason why an incremental encoder has lost its datum, that is, the relation between its count
  // and the position of the axis. Reasons: the power of the encoder failed, the source of the
  // counts restarted, or counts may have been lost. Only losses after the first open() are known.
  // All later positions are suspect until trust_count() is called or marks_passed() increases. "":
  // no loss is known, or the encoder is absolute.
  std::string datum_lost = {};
  // Settings of the device that change its readings. Results must state these settings.
  Notices notices = {};
  // As datum_lost, for the encoders of further axes (DriverContext::further), by the name of the
  // channel.
  std::map<std::string, std::string> further_datum_lost = {};
  // Remedy for the user if an encoder of this device has lost its datum.
  Remedy datum_remedy = Remedy::set_encoder;
};

// Relation between the positions of an encoder and the positions of its axis.
struct EncoderOrigin {
  bool counts = false;  // true: the encoder counts from the position at which it was switched on
  std::optional<double> offset_mm;  // added to the measured position; from the configuration
  // Position of the axis at the reference mark of the encoder. The driver must detect this mark.
  std::optional<double> index_mm = std::nullopt;
  std::string index_where = {};  // "mdofd.toml:12: axis.device.channel.index_mm", for messages
};

enum class ReadState {
  more,  // `block` contains scans, or is empty because no scan arrived before the time-out
  end,   // the source (a file) has ended; no more scans follow
};

// Thread-bound: the thread that reads the driver creates, uses and destroys it.
class Driver {
 public:
  virtual ~Driver() = default;  // releases the device; never throws
  virtual DeviceInfo info() const = 0;
  // The clock whose state info() returns; nullptr: no clock. This function is called for each
  // block, so it must be fast.
  virtual const DeviceClock* clock() const { return nullptr; }
  // The caller may call open() again after an error of read().
  virtual Status open() = 0;
  // Replaces the contents of `block` and reuses its memory. Waits at most `timeout`. An error means
  // that the device is disconnected or that its data stream is invalid. The caller then waits and
  // calls open() again.
  virtual Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) = 0;
  // Call this after the user has set the position of the axis: the present count of the encoder is
  // then valid, even if DeviceInfo::datum_lost gave a reason before.
  virtual void trust_count() {}
  // Number of times that the encoder has passed the reference mark of EncoderOrigin::index_mm. When
  // this number increases with a block, the positions from the first scan of that block on are
  // counted from the mark, and DeviceInfo::datum_lost is cleared.
  virtual int marks_passed() const { return 0; }
  // As trust_count(), for the encoder of a further axis (DriverContext::further).
  virtual void trust_further_count(const std::string& /*channel*/) {}
};

}  // namespace mdof::drivers
