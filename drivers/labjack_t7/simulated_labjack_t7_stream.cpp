// The data that the simulated T7 sends on port 702.
#include <algorithm>
#include <cmath>

#include "drivers/labjack_t7/simulated_labjack_t7.h"

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr std::int64_t kSlot_ns = 10'000;  // time between two entries of the scan list
constexpr int kRecoveryPackets = 3;

}  // namespace

std::string SimulatedLabjackT7::stream_packets(std::int64_t now_ns) {
  std::string bytes;
  while (stream_ && !stream_->hangs_up) {
    Stream& s = *stream_;
    const Faults& faults = options_.faults;
    const bool gap = s.packet == faults.recovery_at + kRecoveryPackets && faults.recovery_at >= 0;
    const std::uint64_t last = s.next_scan + s.scans_per_packet + (gap ? faults.dropped : 0);
    const std::int64_t since_ns = now_ns - options_.latency_ns - s.start_ns;
    if (static_cast<double>(since_ns) < static_cast<double>(last) * s.period_ns) break;
    if (faults.silent_at >= 0 && s.packet >= faults.silent_at) break;
    s.hangs_up = s.packet == faults.hang_up_at;
    if (s.hangs_up) break;
    const bool skipped = s.packet == faults.skip_at;
    const bool stop = s.packet == faults.stop_at;
    const std::string packet = encode(packet_of(s));
    if (!skipped) bytes += packet;
    if (stop) end_stream(now_ns);
  }
  return bytes;
}

StreamPacket SimulatedLabjackT7::packet_of(Stream& s) {
  const Faults& faults = options_.faults;
  StreamPacket packet;
  packet.transaction = static_cast<std::uint16_t>(s.packet);
  const int recovery = faults.recovery_at < 0 ? -1 : s.packet - faults.recovery_at;
  if (recovery >= 0 && recovery < kRecoveryPackets) packet.status = status::recovering;
  if (s.packet == faults.stop_at) packet.status = static_cast<std::uint16_t>(faults.stop_status);
  std::size_t scans = s.scans_per_packet;
  if (recovery == kRecoveryPackets) {
    packet.status = status::recovered;
    packet.info = faults.dropped;
    s.next_scan += faults.dropped;
    if (!faults.unmarked) packet.samples.assign(s.list.size(), 0xFFFF);
    if (!faults.unmarked) --scans;
  }
  for (; scans > 0; --scans) append_scan(packet, s, s.next_scan++);
  ++s.packet;
  return packet;
}

void SimulatedLabjackT7::append_scan(StreamPacket& packet, const Stream& s,
                                     std::uint64_t scan) const {
  std::int64_t t_ns = s.start_ns + std::llround(static_cast<double>(scan) * s.period_ns);
  std::uint32_t captured = 0;
  int counted = 0;
  for (const int entry : s.list) {
    if (entry == reg::capture_16.address) {
      const std::uint32_t count = options_.faults.no_capture ? count_at(counted, t_ns) : captured;
      packet.samples.push_back(words_of(count)[0]);
    } else if (const auto line = counter_line(entry)) {
      counted = *line;
      captured = count_at(counted, t_ns);
      packet.samples.push_back(words_of(captured)[1]);
    } else {
      packet.samples.push_back(ain_code(static_cast<std::size_t>(entry) / 2, t_ns));
    }
    t_ns += kSlot_ns;
  }
}

std::uint16_t SimulatedLabjackT7::ain_code(std::size_t ain, std::int64_t t_ns) const {
  const auto n = static_cast<int>(ain);
  const auto set = static_cast<double>(stored_f32(reg::ain_range.address + 2 * n));
  const AinCalibration c = calibration(range_index(set).value_or(0));
  const std::uint16_t against = registers_.at(reg::ain_negative_ch.address + n);
  const double v = senses_(ain, t_ns) - (against < kAins ? senses_(against, t_ns) : 0);
  const double slope = v < 0 ? -c.negative_slope : c.positive_slope;
  const double code = std::round(c.centre + v / slope);
  return static_cast<std::uint16_t>(std::clamp(code, 0.0, 65535.0));
}

// Returns 0 if the line is not configured as a counter.
std::uint32_t SimulatedLabjackT7::count_at(int line, std::int64_t t_ns) const {
  for (const int n : {line, line + 1})
    if (stored(reg::dio_ef_enable.address + 2 * n) != 1 ||
        stored(reg::dio_ef_index.address + 2 * n) != kQuadrature)
      return 0;
  const auto pair = std::find(kQuadratureLines.begin(), kQuadratureLines.end(), line);
  const auto input = kCounterInput + static_cast<std::size_t>(pair - kQuadratureLines.begin());
  const std::int64_t count = std::llround(senses_(input, t_ns));
  return static_cast<std::uint32_t>(count);
}

std::uint32_t SimulatedLabjackT7::core_at(std::int64_t t_ns) const {
  const double ticks =
      static_cast<double>(t_ns) * 1e-9 * kCore_Hz * (1 + options_.clock_ppm * 1e-6);
  return options_.core_start + static_cast<std::uint32_t>(std::llround(ticks));
}

}  // namespace mdof::drivers::labjack_t7
