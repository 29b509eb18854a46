// A driver turns a device into SampleBlocks. Three calls and a destructor; simulator and replay are
// drivers like any other, so everything after a driver runs without hardware.
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
  std::string name;                 // from the configuration, unique
  std::string driver;               // of registry.cpp: "qsb"; of "replay": "csv" or "recording"
  std::string description;          // one line for people
  std::vector<Channel> channels;    // empty until open() where the device has to be asked
  double rate_hz = 0;               // scans a second; 0: not known
  bool simulated = false;           // no machine behind it: said on every result
  std::optional<ClockState> clock;  // of a device that counts or stamps its samples
  // Of an encoder that counts from where it was switched on, once it has been without power since
  // it was first opened: why. Its places are suspect from then on, for the life of
  // the driver. "": its datum holds, or it is absolute.
  std::string datum_lost = {};
  // Of its settings, that a result should carry: what it does to the readings by itself.
  Notices notices = {};
  // As datum_lost, of the encoders of further axes (DriverContext::further), by channel.
  std::map<std::string, std::string> further_datum_lost = {};
  Remedy datum_remedy = Remedy::set_encoder;  // where a datum is lost, of all its encoders
};

// What positions an encoder of a device shows.
struct EncoderOrigin {
  bool counts = false;              // from where it was switched on, wherever that was
  std::optional<double> offset_mm;  // to be added, by the configuration
  // Where the axis is at the encoder's reference mark, which the driver is to look for.
  std::optional<double> index_mm = std::nullopt;
  std::string index_where = {};  // "mdofd.toml:12: axis.device.channel.index_mm", for messages
};

enum class ReadState {
  more,  // block holds scans, or is empty because nothing came within the time-out
  end,   // the source has ended (a file); nothing more will come
};

// Thread-bound: made, used and destroyed on its reader's thread.
class Driver {
 public:
  virtual ~Driver() = default;  // releases the device; never throws
  virtual DeviceInfo info() const = 0;
  // The clock whose state is in info(); nullptr: none. Asked for at each block, as it costs
  // nothing.
  virtual const DeviceClock* clock() const { return nullptr; }
  // May be called again after an error of read().
  virtual Status open() = 0;
  // Replaces `block` (its capacity is reused). Waits at most `timeout`. An error means the device
  // is gone or its stream is not to be trusted; the caller closes, backs off and opens again.
  virtual Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) = 0;
  // Somebody has said where the axis stands: its encoder's count is to be trusted as it is now,
  // whatever DeviceInfo::datum_lost says.
  virtual void trust_count() {}
  // How often its encoder has passed the reference mark that EncoderOrigin::index_mm is of. It
  // grows with the block from whose first scan on positions are counted from the mark; what
  // datum_lost said is over then.
  virtual int marks_passed() const { return 0; }
  // The same of the encoder of another axis (DriverContext::further).
  virtual void trust_further_count(const std::string& /*channel*/) {}
};

}  // namespace mdof::drivers
