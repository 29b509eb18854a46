// LabJack T7 over Ethernet: amplifier outputs and the quadrature encoders of one or more axes in
// one hardware-timed scan.
//
// Port 502 (Modbus TCP) configures and identifies the device, port 702 streams. The device times
// its scans with CORE_TIMER, 40 MHz: scan k was taken at STREAM_START_TIME_STAMP + k / rate.
// DeviceClock converts this time to the host's clock from the arrivals of packets; a few reads of
// CORE_TIMER start it. The stamp is read with the first packet, because until the first scan begins
// the register holds the stamp of the previous stream. Within a scan the inputs follow each other
// by about 10 us; the scan has one time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock/device_clock.h"
#include "drivers/counter/unwrap.h"
#include "drivers/driver.h"
#include "drivers/io/byte_stream.h"
#include "drivers/labjack/counter.h"
#include "drivers/labjack_t7/registers.h"
#include "drivers/labjack_t7/settings.h"

namespace mdof::drivers::labjack_t7 {

// Thread-bound. Channels: Unit::volt of an AIN, Unit::um of a counter.
//
// A counter keeps running when the driver is opened again, so its zero is kept. If the counter had
// stopped (the T7 lost power) or the count was faster than the limit, its zero is lost: its values
// are Quality::suspect until trust_count() or trust_further_count().
class LabjackT7 final : public Driver {
 public:
  explicit LabjackT7(Settings settings);
  ~LabjackT7() override;  // stops the stream

  DeviceInfo info() const override;
  const DeviceClock* clock() const override { return &clock_; }
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override;
  void trust_further_count(const std::string& channel) override;

 private:
  void close();
  Status start();
  Status start_counters();
  Status start_clock();
  Status read_start_stamp();
  Status next_scans(std::chrono::milliseconds timeout);
  Status receive(std::chrono::milliseconds timeout);
  Status take_packets(std::int64_t received_ns);
  std::int64_t ticks_of(std::uint64_t scan) const;
  void fill_block(SampleBlock& block);
  void append(SampleBlock& block, const Scan& scan);
  void append_ain(SampleBlock& block, std::size_t channel, std::uint16_t raw) const;
  void append_count(SampleBlock& block, std::size_t channel, std::uint32_t raw, double time_s);
  std::uint64_t lost_while_closed(std::int64_t time_ns) const;
  std::string place() const;

  Settings settings_;
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<Registers> registers_;
  std::optional<ByteStream> stream_;
  PacketReader reader_;
  PacketLine line_;
  std::vector<AinCalibration> calibrations_;  // one for each input
  double rate_hz_, ticks_per_scan_ = 0;

  DeviceClock clock_;
  Unwrap core_{32};                          // CORE_TIMER, since open()
  std::int64_t enabled_ticks_ = 0;           // taken shortly before STREAM_ENABLE
  std::optional<std::int64_t> start_ticks_;  // of scan 0; empty before the first packet
  std::int64_t last_packet_ns_ = 0;          // host time; initially the time of the start
  std::vector<Scan> scans_;                  // received
  Status broken_;                            // the error that ended the stream
  std::size_t returned_ = 0;                 // number of scans_ already returned
  std::vector<char> buffer_;

  std::vector<labjack::Counter> counters_;  // one for each input; unused for an AIN
  std::int64_t last_time_ns_ = 0;           // of the last returned scan
  bool reopened_ = false;                   // since the last returned scan
};

}  // namespace mdof::drivers::labjack_t7
