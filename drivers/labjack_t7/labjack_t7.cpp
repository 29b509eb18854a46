#include "drivers/labjack_t7/labjack_t7.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/clock/monotonic.h"
#include "drivers/labjack_t7/setup.h"
#include "drivers/scan_block.h"

namespace mdof::drivers::labjack_t7 {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::int64_t kSilence_ns = 2'000'000'000;
constexpr double kEnable_s = 2;  // longest duration of writing STREAM_ENABLE
constexpr const char* kZeroLost = "the LabJack T7 lost power, and its counter restarted at 0";

std::size_t words_per_scan(const Settings& settings) {
  return scan_list(settings.inputs).size();
}

bool counts(const Input& input) {
  return input.ain < 0;
}

// Returns text with the highest speed that each counter can follow.
std::string speeds(const Settings& settings) {
  std::string text;
  for (const Input& input : settings.inputs)
    if (counts(input) && input.most_counts_per_s > 0)
      text += ", " + (input.channel.id == kEncoderChannel ? "" : input.channel.id + " ") +
              labjack::speed_text(input.most_counts_per_s, input.um_per_count);
  return text;
}

std::string describe(const Identity& id, const Settings& settings) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "LabJack T7 %u, firmware %.4f, at ", id.serial,
                static_cast<double>(id.firmware));
  return text.data() + settings.command.text() + speeds(settings);
}

}  // namespace

LabjackT7::LabjackT7(Settings settings)
    : settings_(std::move(settings)),
      description_("LabJack T7 at " + settings_.command.text()),
      line_(words_per_scan(settings_)),
      rate_hz_(settings_.rate_hz),
      clock_(1e9 / kCore_Hz),
      buffer_(1 << 14) {
  for (const Input& input : settings_.inputs) {
    channels_.push_back(input.channel);
    counters_.emplace_back(input.most_counts_per_s);
  }
}

LabjackT7::~LabjackT7() {
  close();
}

DeviceInfo LabjackT7::info() const {
  DeviceInfo info{settings_.name, "labjack_t7", description_,  channels_,
                  rate_hz_,       false,        clock_.state()};
  for (std::size_t i = 0; i < counters_.size(); ++i) {
    const std::string why = counters_[i].invalid_reason(kZeroLost);
    if (channels_[i].id == kEncoderChannel) {
      info.datum_lost = why;
    } else if (!why.empty()) {
      info.further_datum_lost[channels_[i].id] = why;
    }
  }
  return info;
}

void LabjackT7::trust_count() {
  trust_further_count(kEncoderChannel);
}

void LabjackT7::trust_further_count(const std::string& channel) {
  for (std::size_t i = 0; i < counters_.size(); ++i)
    if (channels_[i].id == channel) counters_[i].trust();
}

std::string LabjackT7::place() const {
  return "device \"" + settings_.name + "\" (LabJack T7 at " + settings_.command.text() + ")";
}

Status LabjackT7::open() {
  close();
  if (auto started = start(); !started) {
    close();
    return in_context(place(), std::move(started.error()));
  }
  return {};
}

// Stops the stream, so that other programs can use the device. Errors are ignored.
void LabjackT7::close() {
  if (registers_ && stream_) (void)registers_->write(reg::stream_enable, 0);
  registers_.reset();
  stream_.reset();
  reader_ = {};
  line_ = ScanNumbering(words_per_scan(settings_));
  received_.clear();
  clock_.reset();
  for (auto& counter : counters_) counter.interrupt();
  start_ticks_.reset();
  loss_.close();
}

Status LabjackT7::start() {
  MDOF_TRY(registers_, Registers::connect(settings_.command));
  MDOF_TRY(const Identity identity, identify(*registers_, settings_));
  description_ = describe(identity, settings_);
  MDOF_CHECK(stop_stream(*registers_));
  MDOF_TRY(calibrations_, set_up_ains(*registers_, settings_));
  MDOF_CHECK(start_counters());
  MDOF_TRY(rate_hz_, set_up_stream(*registers_, settings_));
  ticks_per_scan_ = kCore_Hz / rate_hz_;
  MDOF_TRY(stream_, connect_tcp(settings_.stream, kConnect));
  stream_->keep_arrival_times();
  return start_clock();
}

Status LabjackT7::start_counters() {
  for (std::size_t i = 0; i < counters_.size(); ++i) {
    if (!counts(settings_.inputs[i])) continue;
    MDOF_TRY(const bool kept_count, start_counter(*registers_, settings_.inputs[i].dio));
    counters_[i].resume_count(kept_count);
  }
  return {};
}

// CORE_TIMER shows to which stream STREAM_START_TIME_STAMP belongs. The clock is not fitted to this
// reading: packets arrive after the end of a scan, so its times would change during the first
// seconds from the beginning to the end of a scan.
Status LabjackT7::start_clock() {
  core_.reset();
  MDOF_TRY(const std::uint32_t ticks, registers_->u32(reg::core_timer));
  enabled_ticks_ = core_(ticks);
  MDOF_CHECK(registers_->write(reg::stream_enable, 1));
  last_packet_ns_ = monotonic_ns();
  return {};
}

// The first scan begins one period after STREAM_ENABLE was written; writing takes at most
// kEnable_s.
Status LabjackT7::read_start_stamp() {
  MDOF_TRY(const std::uint32_t stamp, registers_->u32(reg::stream_start_time));
  const std::int64_t start = core_(stamp);
  const double since = static_cast<double>(start - enabled_ticks_);
  if (!(since >= 0 && since < ticks_per_scan_ + kEnable_s * kCore_Hz))
    return io_error(
        "STREAM_START_TIME_STAMP is " + std::to_string(stamp) +
        ", which belongs to another stream; end the other program that starts or stops streams "
        "of this T7");
  start_ticks_ = start;
  return {};
}

Result<ReadState> LabjackT7::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, settings_.name, channels_);
  if (!stream_) return io_error(place() + " is not open; call open() before read()");
  MDOF_CHECK(received_.next(place(), [&] { return receive(timeout); }));
  received_.fill(block, [&](const Scan& scan) { append(block, scan); });
  return ReadState::more;
}

// Returns when scans have arrived, or after `timeout`.
Status LabjackT7::receive(milliseconds timeout) {
  const auto until = steady_clock::now() + timeout;
  do {
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    MDOF_TRY(const std::size_t n, stream_->read(buffer_, std::max(left, milliseconds(0))));
    const std::int64_t received_ns = n > 0 ? to_ns(stream_->arrival()) : monotonic_ns();
    reader_.append({buffer_.data(), n});
    MDOF_CHECK(take_packets(received_ns));
    const double packet_ns = 1e9 / rate_hz_ * static_cast<double>(settings_.samples_per_packet);
    if (static_cast<double>(received_ns - last_packet_ns_ - kSilence_ns) > packet_ns)
      return io_error("no packet for 2 s on port " + std::to_string(settings_.stream.port) +
                      "; check the power and the network of the T7, and end any other program that "
                      "uses the T7");
  } while (received_.scans().empty() && steady_clock::now() < until);
  return {};
}

Status LabjackT7::take_packets(std::int64_t received_ns) {
  StreamPacket packet;
  for (;;) {
    MDOF_TRY(const bool complete, reader_.next(packet));
    if (!complete) return {};
    last_packet_ns_ = received_ns;
    const std::size_t before = received_.scans().size();
    if (!start_ticks_) MDOF_CHECK(read_start_stamp());
    MDOF_CHECK(line_.take(packet, received_.scans()));
    if (received_.scans().size() > before)
      clock_.add(ticks_of(received_.scans().back().index), received_ns);
  }
}

std::int64_t LabjackT7::ticks_of(std::uint64_t scan) const {
  return *start_ticks_ + std::llround(static_cast<double>(scan) * ticks_per_scan_);
}

void LabjackT7::append(SampleBlock& block, const Scan& scan) {
  const std::int64_t time_ns = clock_.host_ns(ticks_of(scan.index));
  block.lost += scan.lost + loss_.take(time_ns, rate_hz_);
  block.time_ns.push_back(time_ns);
  std::size_t word = 0;
  for (std::size_t c = 0; c < settings_.inputs.size(); ++c) {
    const std::uint16_t first = scan.words[word++];
    if (!counts(settings_.inputs[c])) {
      append_ain(block, c, first);
    } else {
      append_count(block, c, u32_of(scan.words[word++], first),
                   static_cast<double>(scan.index) / rate_hz_);
    }
  }
}

void LabjackT7::append_ain(SampleBlock& block, std::size_t channel, std::uint16_t raw) const {
  block.value[channel].push_back(labjack::volts(calibrations_[channel], raw));
  block.quality[channel].push_back(labjack::at_rail(raw) ? Quality::over_range : Quality::good);
}

void LabjackT7::append_count(SampleBlock& block, std::size_t channel, std::uint32_t raw,
                             double time_s) {
  labjack::Counter& counter = counters_[channel];
  const std::int64_t count = counter.take(raw, time_s);
  block.value[channel].push_back(static_cast<double>(count) *
                                 settings_.inputs[channel].um_per_count);
  block.quality[channel].push_back(counter.sure() ? Quality::good : Quality::suspect);
}

}  // namespace mdof::drivers::labjack_t7
