// Live rows of a probe log from a command's standard output, a FIFO, a TCP server or a serial line.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/csv_stream/protocol.h"
#include "drivers/driver.h"
#include "drivers/io/byte_stream.h"
#include "drivers/io/child_process.h"
#include "schema/notice/notice.h"

namespace mdof::drivers {

struct CsvStreamOptions {
  std::vector<std::string> command;  // exactly one of these four is set
  std::string fifo;
  std::optional<Endpoint> server;
  std::string port;  // device file of a serial line
  SerialSettings line{.baud = 115'200};
  std::string header;                     // of a source that sends no header line
  std::string folder;                     // working directory of the command
  std::chrono::milliseconds start{5000};  // longest wait for the header
  std::chrono::milliseconds silence{2000};
  std::size_t bad_lines = 100;        // of 10,000 lines
  std::vector<std::string> expected;  // channel ids; at least one column must be one of them
  bool absolute = false;              // positions keep their zero when the source is started again
  // Checks whether the rig can convert the columns of the header to lengths. Empty: no check.
  std::function<Status(const std::vector<Channel>&)> check_units;
};

// Thread-bound. With a column time_s the times are those of the device, converted by DeviceClock.
// Without it they are times of arrival. Rows that arrive together are then spread evenly over the
// time since the previous arrival, at most 50 ms; after a longer pause all rows except the newest
// are suspect, because their times are uncertain.
// A script may count positions from the position at which it was started. Therefore a datum that
// was set is lost when the source is opened or sends its header again.
class CsvStream final : public Driver {
 public:
  CsvStream(std::string name, CsvStreamOptions options);

  DeviceInfo info() const override;           // channels after open()
  const DeviceClock* clock() const override;  // of rows with time_s; else nullptr
  // Waits up to options.start for the header.
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  void trust_count() override;

  // Number since open().
  std::uint64_t bad_lines() const { return protocol_ ? protocol_->bad_lines() : 0; }
  Notices notices() const;

 private:
  struct Row {
    std::int64_t time_ns;  // time of the host
    std::vector<double> values;
    std::uint64_t lost;
    bool suspect, unplaced;  // unplaced: only the encoder is suspect
  };
  struct TimePair {
    std::int64_t device_ns, host_ns;
  };
  Status connect();
  Status begin_rows();
  Status wait_for_header();
  tl::unexpected<Error> no_header(Error why) const;
  Status check_columns() const;
  Status check_units() const;
  ByteStream& stream() { return child_ ? child_->output() : *stream_; }
  Status fetch(std::chrono::milliseconds timeout);
  tl::unexpected<Error> ended(const Error& why);
  void take(std::vector<CsvStreamRow>& rows, std::int64_t received_ns);
  static void mark_encoder_suspect(SampleBlock& block);
  void note_restart() { datum_lost_ = datum_lost_ || (datum_set_ && !options_.absolute); }
  static void spread(std::vector<CsvStreamRow>& rows, std::int64_t since_ns,
                     std::int64_t received_ns);
  void take_device_times(std::vector<CsvStreamRow>& rows, std::int64_t received_ns);
  Status check_pace(const std::vector<CsvStreamRow>& rows, std::int64_t received_ns);
  Status check_silence() const;

  std::string name_, source_;
  CsvStreamOptions options_;
  std::unique_ptr<ChildProcess> child_;
  std::optional<ByteStream> stream_;
  bool waits_for_writer_ = false;  // no program has written to the FIFO yet
  std::optional<CsvStreamProtocol> protocol_;
  DeviceClock clock_{1.0};  // a tick of time_s is 1 ns
  std::deque<Row> rows_;    // received, not yet returned
  Status status_;           // reported after rows_ is empty
  bool datum_set_ = false, datum_lost_ = false;
  bool in_first_line_ = false;  // of a serial line; reading may have begun in the middle of it
  std::optional<TimePair> pace_from_;
  std::int64_t last_row_ns_ = 0, last_received_ns_ = 0, last_time_ns_ = 0;
};

}  // namespace mdof::drivers
