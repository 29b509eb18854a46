// A driver turns the data of a device into SampleBlocks. The simulator and the replay are drivers
// too, so all later code runs without hardware.
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
  std::string description;        // one line, for users
  std::vector<Channel> channels;  // empty until open(), if only the device knows its channels
  double rate_hz = 0;             // scans a second; 0: not known
  bool simulated = false;         // no machine behind it; every result is marked as simulated
  std::optional<ClockState> clock;  // if the device counts or stamps its samples
  // Reason why an incremental encoder has lost its datum after the driver first opened it: the
  // encoder lost power, its source restarted, or counts may have been lost. Its positions are then
  // suspect for the life of the driver, unless trust_count() is called or marks_passed() increases.
  // "": the datum is valid, or the encoder is absolute.
  std::string datum_lost = {};
  // Settings of the device that change the readings; results must state them.
  Notices notices = {};
  // As datum_lost, for the encoders of further axes (DriverContext::further), by channel.
  std::map<std::string, std::string> further_datum_lost = {};
  Remedy datum_remedy = Remedy::set_encoder;  // for a lost datum of any of its encoders
};

// How the positions of an encoder are referred to the axis.
struct EncoderOrigin {
  bool counts = false;              // counts from the position at which it was switched on
  std::optional<double> offset_mm;  // added to its position, from the configuration
  // Axis position at the encoder's reference mark, which the driver must detect.
  std::optional<double> index_mm = std::nullopt;
  std::string index_where = {};  // "mdofd.toml:12: axis.device.channel.index_mm", for messages
};

enum class ReadState {
  more,  // block holds scans, or is empty because none arrived before the time-out
  end,   // the source has ended (a file); no more scans follow
};

// Thread-bound: created, used and destroyed on the thread of its reader.
class Driver {
 public:
  virtual ~Driver() = default;  // releases the device; never throws
  virtual DeviceInfo info() const = 0;
  // The clock whose state is in info(); nullptr: no clock. Must be cheap: it is called for each
  // block.
  virtual const DeviceClock* clock() const { return nullptr; }
  // May be called again after an error of read().
  virtual Status open() = 0;
  // Replaces `block` (its capacity is reused). Waits at most `timeout`. An error means that the
  // device is gone or that its stream is invalid; the caller closes the driver, waits and opens it
  // again.
  virtual Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) = 0;
  // The user has set the position of the axis: the present count of the encoder is valid, even if
  // DeviceInfo::datum_lost gives a reason.
  virtual void trust_count() {}
  // How often the encoder has passed the reference mark of EncoderOrigin::index_mm. The number
  // increases with a block: from the first scan of this block on, positions are counted from the
  // mark, and DeviceInfo::datum_lost is cleared.
  virtual int marks_passed() const { return 0; }
  // As trust_count(), for the encoder of a further axis (DriverContext::further).
  virtual void trust_further_count(const std::string& /*channel*/) {}
};

}  // namespace mdof::drivers
