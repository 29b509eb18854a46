// Live rows of a probe log: a command's standard output, a FIFO, a TCP server, a serial line.
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
  std::vector<std::string> command;  // or
  std::string fifo;                  // or
  std::optional<Endpoint> server;    // or
  std::string port;                  // of a serial line
  SerialSettings line{.baud = 115'200};
  std::string header;                     // of a source that sends none
  std::string folder;                     // in which the command runs
  std::chrono::milliseconds start{5000};  // the header must have come
  std::chrono::milliseconds silence{2000};
  std::size_t bad_lines = 100;        // of 10,000
  std::vector<std::string> expected;  // ids: one column at least must be of these
  bool absolute = false;  // a position means the same place after the source was started again
  // Whether the rig can make lengths of what the header names. Empty: it is not asked.
  std::function<Status(const std::vector<Channel>&)> check_units;
};

// Thread-bound. With time_s the times are the device's own, by DeviceClock; without it those of
// arrival. Rows that came together are then spread evenly over the time since the arrival before,
// at most 50 ms. After more than that they are suspect: their true times are not known so well.
// A script may count positions from where it was started: a datum that somebody has set is lost
// when the source is opened, or sends its header, again.
class CsvStream final : public Driver {
 public:
  CsvStream(std::string name, CsvStreamOptions options);

  DeviceInfo info() const override;           // channels after open()
  const DeviceClock* clock() const override;  // of rows that carry time_s
  // Waits up to options.start for the header.
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  void trust_count() override;

  std::uint64_t bad_lines() const { return protocol_ ? protocol_->bad_lines() : 0; }  // since open
  Notices notices() const;

 private:
  struct Row {
    std::int64_t time_ns;  // host's
    std::vector<double> values;
    std::uint64_t lost;
    bool suspect, unplaced;  // unplaced: the encoder alone is suspect
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
  static void mark_unplaced(SampleBlock& block);
  void start_again() { datum_lost_ = datum_lost_ || (datum_set_ && !options_.absolute); }
  static void spread(std::vector<CsvStreamRow>& rows, std::int64_t since_ns,
                     std::int64_t received_ns);
  void take_device_times(std::vector<CsvStreamRow>& rows, std::int64_t received_ns);
  Status check_pace(const std::vector<CsvStreamRow>& rows, std::int64_t received_ns);
  Status check_silence() const;

  std::string name_, source_;
  CsvStreamOptions options_;
  std::unique_ptr<ChildProcess> child_;
  std::optional<ByteStream> stream_;
  bool waits_for_writer_ = false;  // a FIFO that nobody has written to yet
  std::optional<CsvStreamProtocol> protocol_;
  DeviceClock clock_{1.0};  // ticks of time_s are nanoseconds
  std::deque<Row> rows_;    // received, not yet given out
  Status status_;           // what to say once rows_ is empty
  bool datum_set_ = false, datum_lost_ = false;
  bool in_first_line_ = false;  // of a serial line, which may have begun in the middle of it
  std::optional<TimePair> pace_from_;
  std::int64_t last_row_ns_ = 0, last_received_ns_ = 0, last_time_ns_ = 0;
};

}  // namespace mdof::drivers
