// LabJack T7 over Ethernet. One hardware-timed scan contains the outputs of the amplifiers and the
// quadrature encoders of one or more axes.
//
// Port 502 (Modbus TCP) is for commands, port 702 for the stream. The device times its scans with
// CORE_TIMER, 40 MHz: scan k began at STREAM_START_TIME_STAMP + k / rate. DeviceClock converts this
// time to the host's clock. It uses the times at which packets arrive, so that the time of a scan
// is the time of its last input plus the shortest time of a packet on the network. The driver reads
// the time stamp of the start together with the first packet, because the register contains the
// stamp of the previous stream until the first scan begins. In a scan, two successive inputs are
// sampled about 10 us apart; the whole scan has one time.
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
#include "drivers/labjack/received_scans.h"
#include "drivers/labjack_t7/registers.h"
#include "drivers/labjack_t7/settings.h"
#include "drivers/loss_while_closed.h"

namespace mdof::drivers::labjack_t7 {

// Thread-bound. Unit of the channels: Unit::volt for an AIN, Unit::um for a counter.
//
// A counter continues when the driver opens the device again, and keeps its zero. The zero is lost
// if the counter has stopped (the power of the T7 failed) or if the counting rate was above the
// limit. The values of the counter are then Quality::suspect until trust_count() or
// trust_further_count() is called.
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
  Status receive(std::chrono::milliseconds timeout);
  Status take_packets(std::int64_t received_ns);
  std::int64_t ticks_of(std::uint64_t scan) const;
  void append(SampleBlock& block, const Scan& scan);
  void append_ain(SampleBlock& block, std::size_t channel, std::uint16_t raw) const;
  void append_count(SampleBlock& block, std::size_t channel, std::uint32_t raw, double time_s);
  std::string place() const;

  Settings settings_;
  std::string description_;
  std::vector<Channel> channels_;
  std::optional<Registers> registers_;
  std::optional<ByteStream> stream_;
  PacketReader reader_;
  ScanNumbering line_;
  std::vector<AinCalibration> calibrations_;  // one for each input
  double rate_hz_, ticks_per_scan_ = 0;

  DeviceClock clock_;
  Unwrap core_{32};                          // CORE_TIMER, extended over its overflows since open()
  std::int64_t enabled_ticks_ = 0;           // CORE_TIMER shortly before STREAM_ENABLE was written
  std::optional<std::int64_t> start_ticks_;  // CORE_TIMER at scan 0; empty before the first packet
  // Host time at which the last packet arrived; before the first packet, the time of the start.
  std::int64_t last_packet_ns_ = 0;
  labjack::ReceivedScans received_;
  std::vector<char> buffer_;

  std::vector<labjack::Counter> counters_;  // one for each input; not used for an AIN
  LossWhileClosed loss_;
};

}  // namespace mdof::drivers::labjack_t7
