// Driver for rows of a probe log that arrive during the measurement: from the standard output of a
// command, a FIFO, a TCP server or a serial line.
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
  std::vector<std::string> command;  // exactly one of command, fifo, server and port is set
  std::string fifo;
  std::optional<Endpoint> server;
  std::string port;  // device file of a serial line
  SerialSettings line{.baud = 115'200};
  std::string header;                     // header line for a source that does not send one
  std::string folder;                     // working directory of the command
  std::chrono::milliseconds start{5000};  // longest wait for the header
  std::chrono::milliseconds silence{2000};
  std::size_t bad_lines = 100;        // largest permitted number of bad lines in 10,000 lines
  std::vector<std::string> expected;  // channel ids; at least one column must have one of these ids
  // True: the zero of the positions does not change when the source is started again.
  bool absolute = false;
  // Checks whether the rig can convert the units of the columns to lengths. Empty: no check.
  std::function<Status(const std::vector<Channel>&)> check_units;
};

// Thread-bound. If the rows have a column time_s, its times are converted by DeviceClock. Otherwise
// the times are the times of arrival. Rows that arrive together are then distributed evenly over
// the time since the previous arrival, but over at most 50 ms. After a longer pause and at the
// start, all of these rows except the newest are suspect, because their times are uncertain. A
// script may count positions from the position at which the script was started. Therefore, unless
// `absolute` is true, a datum that the user has set is lost when the source is opened again or
// sends its header again.
class CsvStream final : public Driver {
 public:
  CsvStream(std::string name, CsvStreamOptions options);

  DeviceInfo info() const override;           // channels: after open()
  const DeviceClock* clock() const override;  // nullptr if the rows have no time_s
  // Waits for the header, at most options.start.
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  void trust_count() override;

  // Number of bad lines since open().
  std::uint64_t bad_lines() const { return protocol_ ? protocol_->bad_lines() : 0; }
  Notices notices() const;

 private:
  struct Row {
    std::int64_t time_ns;  // time of the host's clock
    std::vector<double> values;
    std::uint64_t lost;
    bool suspect, unplaced;  // unplaced: only the position of the encoder is suspect
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
  void take(std::vector<CsvStreamRow>& rows, std::int64_t received_ns, bool more);
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
  bool waits_for_writer_ = false;  // true: no program has written to the FIFO yet
  std::optional<CsvStreamProtocol> protocol_;
  DeviceClock clock_{1.0};  // a tick of time_s is 1 ns
  std::deque<Row> rows_;    // rows that were received and not returned yet
  Status status_;           // error; read() returns it after all rows_
  bool datum_set_ = false, datum_lost_ = false;
  bool in_burst_ = false;       // true: more of the rows that waited together are pending
  bool in_first_line_ = false;  // serial line only: the first line may be incomplete
  std::optional<TimePair> pace_from_;
  std::int64_t last_row_ns_ = 0, last_received_ns_ = 0, last_time_ns_ = 0;
};

}  // namespace mdof::drivers
