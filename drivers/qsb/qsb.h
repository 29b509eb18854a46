// Driver of a US Digital QSB-D/QSB-S. The device sends the count of one incremental encoder with
// time stamps, over a serial port or through a TCP bridge.
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/channels.h"
#include "drivers/clock/device_clock.h"
#include "drivers/counter/index_mark.h"
#include "drivers/counter/unwrap.h"
#include "drivers/driver.h"
#include "drivers/io/byte_stream.h"
#include "drivers/qsb/protocol.h"
#include "drivers/qsb/tick_length.h"

namespace mdof::drivers {

struct QsbOptions {
  std::string port;                 // device file of the serial port; empty: use `address`
  std::optional<Endpoint> address;  // address of a TCP bridge
  SerialSettings line{.baud = 230'400};
  std::uint32_t counting = 3;   // 1: x1, 2: x2, 3: x4
  std::uint32_t interval = 1;   // number of ticks between two lines
  std::string serial;           // serial number of the device; empty: any device
  ChannelInput channel;         // its input is "count"
  bool index_inverted = false;  // polarity of the index signal
  // If the count stays at the mark for this time, the driver reports it.
  std::chrono::milliseconds long_at_mark{5000};
  std::chrono::milliseconds silence{2000};  // longest time without a line
};

// Thread-bound. The driver does not reset a device that replies. Therefore the count continues when
// the device is opened again. If the device was reset meanwhile, the datum of the encoder is lost:
// its values are Quality::suspect until trust_count() is called, or until the axis passes the
// reference mark, if there is one.
//
// If there is a reference mark, the index signal sets the count to a number that the driver has
// chosen (counter/index_mark.h). The driver disables this after the axis has passed the mark: a
// later loss of counts must be visible and must not be corrected silently during a run.
class Qsb final : public Driver {
 public:
  // largest permitted number of successive malformed lines
  static constexpr int kMalformedAllowed = 10;

  Qsb(std::string name, QsbOptions options);

  DeviceInfo info() const override;
  const DeviceClock* clock() const override { return &clock_; }
  Status open() override;
  // A gap in the stamps means that lines were lost. Errors: the device was reset during the stream;
  // impossible stamps; more than 10 malformed lines in succession; silence.
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override { datum_lost_ = false; }
  int marks_passed() const override { return marks_passed_; }

  // Number of malformed lines since the start.
  std::uint64_t malformed_lines() const { return malformed_; }
  double tick_ns() const { return tick_.ns(); }

 private:
  struct Sample {
    std::int64_t device_ns;
    double um;
    std::uint64_t lost;
    int marks_passed;
  };
  std::string place() const;
  Status connect();
  Status stop_stream_and_set_format();
  Status check_identity();
  Status watch_for_reset();
  Status configure();
  Status await_mark();
  void mark_datum_lost();
  Result<QsbReply> ask(char type, std::uint8_t reg, std::optional<std::uint32_t> data);
  Result<std::optional<QsbReply>> one_reply(std::uint8_t reg, std::chrono::milliseconds timeout);
  std::optional<std::string> next_line();
  Status fetch(std::chrono::milliseconds timeout);
  Status take_line(std::string_view line, std::int64_t received_ns);
  Status take_sample(const QsbReply& reply, std::int64_t received_ns);
  Status take_malformed();
  Result<IndexMark::State> watch_mark(std::int64_t count, std::int64_t received_ns);
  bool is_stuck_at_mark() const;
  void return_samples(SampleBlock& block);

  std::string name_;
  QsbOptions options_;
  std::optional<ByteStream> stream_;
  QsbIdentity identity_;
  bool power_was_lost_ = false;
  bool counted_ = false;  // true: this object has opened the device before
  // true: the zero of the count may have changed since the datum was set
  bool datum_lost_ = false;
  std::string received_;  // bytes that are not yet divided into lines
  TickLength tick_{qsb::kTick_ns};
  DeviceClock clock_{1.0};  // a tick is 1 ns of device time
  Unwrap count_{32, true}, stamp_{32};
  std::optional<std::int64_t> last_stamp_;
  double device_ns_ = 0;
  std::deque<Sample> samples_;  // samples that were not returned yet
  Status status_;               // error; read() returns it after all samples_
  std::int64_t last_sample_ns_ = 0;
  IndexMark mark_{32};
  bool awaits_new_mark_ = true;  // the count has a new zero, so the mark must be awaited
  std::int64_t at_mark_since_ns_ = 0;
  // Number of passed marks in the received samples, and in the returned samples.
  int marks_found_ = 0, marks_passed_ = 0;
  std::uint64_t malformed_ = 0;
  int malformed_in_a_row_ = 0;
};

}  // namespace mdof::drivers
