#include "drivers/capancdt/capancdt.h"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"

namespace mdof::drivers::capancdt {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

// Largest number of scans in one read(); a read() may exceed it by one packet.
constexpr std::size_t kBlockScans = 4096;
constexpr std::size_t kReadBytes = 1 << 16;  // largest number of bytes in one read() of the socket
// largest number of calls of read() before the data are processed
constexpr int kReads = 16;
// Largest permitted number of bytes without a valid packet. The largest packet has half this size.
constexpr std::uint64_t kMostGarbage = 1 << 18;
// If the missing frames cover a longer time, the counter was reset.
constexpr double kMostLost_ns = 10e9;

}  // namespace

Capancdt::Capancdt(Options options) : options_(std::move(options)) {
  for (const auto& channel : options_.channels) channels_.push_back({channel.input.id, Unit::um});
}

DeviceInfo Capancdt::info() const {
  DeviceInfo info{options_.name, "capancdt", "capaNCDT at " + options_.command.text(), channels_, 0,
                  false,         {}};
  if (!session_) return info;
  info.description = session_->setup.description + " at " + options_.command.text();
  info.rate_hz = 1e9 / session_->setup.frame_ns();
  info.clock = session_->clock.state();
  info.notices = session_->setup.notices;
  return info;
}

const DeviceClock* Capancdt::clock() const {
  return session_ ? &session_->clock : nullptr;
}

Status Capancdt::open() {
  session_.reset();
  auto setup = set_up_controller(options_);
  if (!setup) return with_device_name(setup.error());
  auto data = connect_tcp({options_.command.host, setup->data_port}, kConnect);
  if (!data) return with_device_name(data.error());
  data->keep_arrival_times();
  const double frame_ns = setup->frame_ns();
  const int averaged = setup->averaged;
  const auto most_lost = static_cast<std::uint64_t>(std::max(16.0, kMostLost_ns / frame_ns));
  session_ = std::make_unique<Session>(Session{
      .setup = std::move(*setup),
      .data = std::move(*data),
      .parser = {},
      .counter = FrameCounter(averaged, most_lost),
      .clock = DeviceClock(frame_ns),
      .rate = RateWatch(frame_ns),
      .waiting = {},
      .last_packet_time = steady_clock::now(),
      .newest_frame = std::nullopt,
      .first_ns = std::nullopt,
      .failed = std::nullopt,
  });
  return {};
}

Result<ReadState> Capancdt::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, options_.name, channels_);
  if (!session_) return with_device_name({ErrorCode::io, "is not open; call open() before read()"});
  Session& s = *session_;
  if ((s.waiting.empty() || !s.warm) && !s.failed)
    if (auto received = receive(timeout); !received) s.failed = std::move(received.error());
  if (s.warm || s.failed) fill_block(block);
  if (block.scans() == 0 && s.failed) return with_device_name(*s.failed);
  return ReadState::more;
}

Health Capancdt::health() const {
  if (!session_) return {};
  const Session& s = *session_;
  return {s.counter.lost(), s.counter.duplicates(), s.parser.skipped(), s.counter.unit(),
          s.clock.state()};
}

// Reads all received data. If no data were received, waits once.
Status Capancdt::receive(milliseconds timeout) {
  Session& s = *session_;
  bool came = false;
  const auto all = receive_all(timeout, came);
  if (came) {
    const auto arrival = s.data.arrival();
    auto placed = place_packets(arrival);
    // The clock is also updated for frames that arrived before an error.
    MDOF_CHECK(update_clock(to_ns(arrival), all.value_or(true)));
    MDOF_CHECK(std::move(placed));
  }
  if (!all) return in_context("the data connection", all.error());
  if (s.parser.skipped_now() > kMostGarbage)
    return io_error("the data from " + s.data.name() +
                    " are not data of a capaNCDT 6200; correct the key \"data_port\"");
  return check_silence();
}

// Returns false if more data are pending; the newest received frame is then not the newest frame of
// the controller.
Result<bool> Capancdt::receive_all(milliseconds timeout, bool& came) {
  std::array<char, kReadBytes> bytes;
  for (int i = 0; i < kReads; ++i) {
    MDOF_TRY(const std::size_t n, session_->data.read(bytes, came ? milliseconds(0) : timeout));
    if (n == 0) return true;
    came = true;
    session_->parser.add({bytes.data(), n});
    if (n < bytes.size()) return true;
  }
  return false;
}

Status Capancdt::place_packets(steady_clock::time_point received) {
  Session& s = *session_;
  Packet packet;
  while (s.parser.next(packet)) {
    s.last_packet_time = received;
    MDOF_CHECK(s.counter.add(std::move(packet), s.waiting));
    packet = {};
  }
  return {};
}

// Adds only the newest frame to the clock. Earlier frames may have waited in this computer; with
// these frames, the device's clock would appear to jump. Also checks the frame rate.
Status Capancdt::update_clock(std::int64_t received_ns, bool all) {
  Session& s = *session_;
  if (s.waiting.empty() || (!all && s.newest_frame)) return {};
  const PlacedPacket& last = s.waiting.back();
  const std::int64_t newest = last.first_frame + last.packet.frames() - 1;
  if (newest == s.newest_frame) return {};  // only a part of a new packet has arrived
  s.newest_frame = newest;
  s.first_ns = s.first_ns.value_or(received_ns);
  s.warm = s.warm || nanoseconds(received_ns - *s.first_ns) >= options_.warm_up;
  s.clock.add(*s.newest_frame, received_ns);
  const auto measured_ns = s.rate.add(*s.newest_frame, received_ns);
  if (!measured_ns) return {};
  return io_error("the controller sends a frame every " + std::to_string(*measured_ns / 1e3) +
                  " us, but it reported an interval of " +
                  std::to_string(s.setup.frame_ns() / 1e3) +
                  " us; end any other program that changes the settings of the controller");
}

Status Capancdt::check_silence() const {
  const auto frames = nanoseconds(static_cast<std::int64_t>(8 * session_->setup.frame_ns()));
  const auto limit = options_.silence + frames;
  if (steady_clock::now() - session_->last_packet_time < limit) return {};
  return io_error(session_->data.name() + " is connected, but has sent no data for " +
                  std::to_string(std::chrono::duration_cast<milliseconds>(limit).count()) +
                  " ms; another client uses the data port, or the controller waits for a trigger: "
                  "end the other client, or set the trigger to continuous");
}

tl::unexpected<Error> Capancdt::with_device_name(const Error& error) const {
  const std::string place = options_.command.text();
  const bool named = error.message.find(place) != std::string::npos;
  return in_context("device \"" + options_.name + "\"" + (named ? "" : " at " + place), error);
}

// A block ends before lost frames. The next block then contains their number in `lost`.
void Capancdt::fill_block(SampleBlock& block) {
  auto& waiting = session_->waiting;
  if (waiting.empty()) return;
  const auto frames = static_cast<std::size_t>(waiting.front().packet.frames());
  reserve_scans(block, std::min(kBlockScans, waiting.size() * frames));
  while (!waiting.empty() && block.scans() < kBlockScans) {
    if (waiting.front().lost > 0 && block.scans() > 0) break;
    append(block, waiting.front());
    waiting.pop_front();
  }
}

void Capancdt::append(SampleBlock& block, const PlacedPacket& placed) {
  const Packet& packet = placed.packet;
  const int frames = packet.frames();
  block.lost += placed.lost;
  for (int frame = 0; frame < frames; ++frame)
    block.time_ns.push_back(session_->clock.host_ns(placed.first_frame + frame));
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto position = packet.position(options_.channels[i].number);
    for (int frame = 0; frame < frames; ++frame) {
      std::optional<std::int32_t> raw;
      if (position) raw = packet.value(frame, *position);
      append_value(block, i, raw);
    }
    if (packet.after_garbage)
      for (auto q = block.quality[i].end() - frames; q != block.quality[i].end(); ++q)
        *q = std::max(*q, Quality::suspect);
  }
}

void Capancdt::append_value(SampleBlock& block, std::size_t channel,
                            std::optional<std::int32_t> raw) const {
  const Setup::Input& input = session_->setup.inputs[channel];
  Quality quality = Quality::good;
  if (!raw)
    quality = Quality::missing;
  else if (!input.maths && at_end_of_range(*raw, options_.guard_counts))
    quality = Quality::over_range;
  block.value[channel].push_back(raw ? to_um(*raw, input.range_um) : kNaN);
  block.quality[channel].push_back(quality);
}

}  // namespace mdof::drivers::capancdt
