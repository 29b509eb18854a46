#include "drivers/qsb/qsb.h"

#include <array>
#include <cmath>
#include <utility>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kConnect{2000}, kAnswer{300}, kBannerWait{1000};
constexpr milliseconds kQuiet{50}, kDrain{500};
constexpr std::size_t kLongestLine = 256;
constexpr const char* kDatumLost = "the QSB was reset or lost power, and its count restarted at 0";
constexpr const char* kAtMark =
    "the index signal is always active. Either the key index_inverted of the channel is wrong, or "
    "the axis is at its reference mark";
// Largest difference by which a stamp may be ahead of the host's clock.
constexpr double kMaxStampLead_ns = 2e9;

}  // namespace

Qsb::Qsb(std::string name, QsbOptions options)
    : name_(std::move(name)), options_(std::move(options)) {}

std::string Qsb::place() const {
  return "QSB \"" + name_ + "\" at " +
         (options_.address ? options_.address->text() : options_.port);
}

DeviceInfo Qsb::info() const {
  std::string text = "US Digital " + (identity_.model.empty() ? "QSB" : identity_.model);
  if (!identity_.serial.empty())
    text += " " + identity_.serial + ", firmware " + std::to_string(identity_.firmware);
  if (power_was_lost_) text += "; the QSB lost power, so its count began at 0";
  const double rate_hz = 1e9 / (tick_.ns() * options_.interval);
  DeviceInfo info{name_,   "qsb", text,          {{options_.channel.id, Unit::um}},
                  rate_hz, false, clock_.state()};
  if (is_stuck_at_mark()) {
    info.datum_lost = kAtMark;
    info.datum_remedy = Remedy::move_off_reference_mark;
  } else if (datum_lost_) {
    info.datum_lost = kDatumLost;
    if (options_.channel.index_mm) info.datum_remedy = Remedy::pass_reference_mark;
  }
  return info;
}

bool Qsb::is_stuck_at_mark() const {
  const std::chrono::nanoseconds there(monotonic_ns() - at_mark_since_ns_);
  return mark_.state() == IndexMark::State::at_mark && there > options_.long_at_mark;
}

Status Qsb::open() {
  samples_.clear();
  received_.clear();
  status_ = {};
  clock_.reset();
  tick_.restart();
  stamp_.reset();
  last_stamp_.reset();
  device_ns_ = 0;
  malformed_in_a_row_ = 0;
  MDOF_CHECK(connect());
  MDOF_CHECK(stop_stream_and_set_format());
  MDOF_CHECK(check_identity());
  MDOF_CHECK(watch_for_reset());
  if (awaits_new_mark_) count_.reset();
  MDOF_CHECK(configure());
  MDOF_CHECK(await_mark());
  counted_ = true;
  last_sample_ns_ = monotonic_ns();
  return stream_->write(qsb_command('S', qsb::kCount), kAnswer);
}

Status Qsb::connect() {
  stream_.reset();
  if (options_.address) {
    MDOF_TRY(stream_, connect_tcp(*options_.address, kConnect));
  } else {
    MDOF_TRY(stream_, open_serial(options_.port, options_.line));
  }
  return {};
}

// Stops a running stream and sets the format of the replies. If the device does not reply, resets
// it once; the count of the device is then lost.
Status Qsb::stop_stream_and_set_format() {
  for (const bool reset : {false, true}) {
    if (reset && !options_.address) {
      if (counted_) mark_datum_lost();
      pulse_dtr(*stream_);
      MDOF_TRY(const auto banner, stream_->drain(kBannerWait / 2, kBannerWait));
      (void)banner;
    }
    // If an incomplete command was sent before, an empty line ends it.
    MDOF_CHECK(stream_->write(
        "\r\n" + qsb_command('W', qsb::kCommand, 1) + qsb_command('W', qsb::kEor, qsb::kFullLines),
        kAnswer));
    MDOF_TRY(const auto stale, stream_->drain(kQuiet, kDrain));
    (void)stale;
    received_.clear();
    MDOF_CHECK(stream_->write(qsb_command('R', qsb::kVersion), kAnswer));
    MDOF_TRY(const auto reply, one_reply(qsb::kVersion, kAnswer));
    if (!reply || reply->type != 'r') continue;
    identity_ = qsb_identity(reply->data);
    return {};
  }
  return io_error(place() + ": does not answer; check that the device is a QSB with baud rate " +
                  std::to_string(options_.line.baud) + ", and check the lines RTS and DTR");
}

Status Qsb::check_identity() {
  if (options_.serial.empty() || options_.serial == identity_.serial) return {};
  return io_error(place() + ": the serial number of the device is " + identity_.serial +
                  ", but the configuration has serial = " + options_.serial +
                  "; this port belongs to another device; give a port in /dev/serial/by-id");
}

// A reset clears the count and the settings. Therefore a changed interval shows that the device was
// reset.
Status Qsb::watch_for_reset() {
  if (!counted_) return {};
  MDOF_TRY(const QsbReply interval, ask('R', qsb::kInterval, std::nullopt));
  if (interval.data != options_.interval) mark_datum_lost();
  return {};
}

void Qsb::mark_datum_lost() {
  datum_lost_ = true;
  awaits_new_mark_ = true;
}

Status Qsb::configure() {
  const std::pair<std::uint8_t, std::uint32_t> settings[] = {
      {qsb::kMdr0, options_.counting},
      {qsb::kMdr1, options_.index_inverted ? qsb::kIndexInverted : 0},
      {qsb::kThreshold, 0},
      {qsb::kInterval, options_.interval},
      {qsb::kStamp, 1},
  };
  for (const auto& [reg, value] : settings) MDOF_CHECK(ask('W', reg, value));
  MDOF_TRY(const QsbReply status, ask('R', qsb::kStatus, std::nullopt));
  power_was_lost_ = (status.data & qsb::kPowerWasLost) != 0;
  return {};
}

// open() does not change the preset, because the axis may have passed the mark while the driver was
// closed.
Status Qsb::await_mark() {
  if (!options_.channel.index_mm) {
    awaits_new_mark_ = false;
    return {};
  }
  if (awaits_new_mark_) {
    MDOF_TRY(const QsbReply now, ask('R', qsb::kCount, std::nullopt));
    mark_.arm(count_(now.data));
    marks_found_ = marks_passed_;
    awaits_new_mark_ = false;
  }
  if (!mark_.armed()) return {};
  MDOF_CHECK(ask('W', qsb::kLoad, static_cast<std::uint32_t>(mark_.load())));
  MDOF_CHECK(ask('W', qsb::kMdr0, options_.counting | qsb::kIndexLoads | qsb::kIndexSynchronous));
  return {};
}

Result<QsbReply> Qsb::ask(char type, std::uint8_t reg, std::optional<std::uint32_t> data) {
  const std::string command = qsb_command(type, reg, data);
  const std::string what = place() + ": command " + command.substr(0, command.find('\r'));
  MDOF_CHECK(stream_->write(command, kAnswer));
  MDOF_TRY(const auto reply, one_reply(reg, kAnswer));
  if (!reply) return io_error(what + " was not answered; check the cable and the baud rate");
  if (reply->type == 'e')
    return io_error(what + " was refused (reply e); the firmware does not accept the value");
  if (reply->type == 'x')
    return io_error(what + " is not supported (reply x); a QSB-D or QSB-S is needed");
  return *reply;
}

// Returns the next reply that contains the register `reg`; ignores other lines. nullopt: no line
// arrived.
Result<std::optional<QsbReply>> Qsb::one_reply(std::uint8_t reg, milliseconds timeout) {
  const auto until = steady_clock::now() + timeout;
  for (;;) {
    while (const auto line = next_line()) {
      const auto reply = parse_qsb_line(*line);
      if (reply && reply->reg == reg) return reply;
    }
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    if (left.count() <= 0) return std::nullopt;
    std::array<char, 512> bytes;
    MDOF_TRY(const std::size_t n, stream_->read(bytes, left));
    received_.append(bytes.data(), n);
  }
}

std::optional<std::string> Qsb::next_line() {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos) {
    // The line is too long, so it is malformed.
    if (received_.size() > kLongestLine) return std::exchange(received_, "");
    return std::nullopt;
  }
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  while (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

Result<ReadState> Qsb::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, name_, {{options_.channel.id, Unit::um}});
  if (!stream_) return io_error(place() + ": is not open; call open() before read()");
  if (samples_.empty() && status_) status_ = fetch(timeout);
  if (samples_.empty()) MDOF_CHECK(status_);
  return_samples(block);
  const std::chrono::nanoseconds silent(monotonic_ns() - last_sample_ns_);
  if (block.scans() == 0 && silent > options_.silence)
    return io_error(place() + ": received no data for " + std::to_string(options_.silence.count()) +
                    " ms; check the power, and end any other program that uses the QSB");
  return ReadState::more;
}

void Qsb::return_samples(SampleBlock& block) {
  // Lost lines and passed marks apply to the beginning of a block. Therefore a sample with a loss
  // or a mark begins a new block.
  while (!samples_.empty()) {
    const Sample& sample = samples_.front();
    const bool at_mark = sample.marks_passed != marks_passed_;
    if (block.scans() > 0 && (sample.lost > 0 || at_mark)) return;
    if (at_mark) datum_lost_ = false;
    marks_passed_ = sample.marks_passed;
    block.lost += sample.lost;
    add_scan(block, clock_.host_ns(sample.device_ns), std::array{sample.um},
             datum_lost_ ? Quality::suspect : Quality::good);
    samples_.pop_front();
  }
}

Status Qsb::fetch(milliseconds timeout) {
  std::array<char, 4096> bytes;
  const auto n = stream_->read(bytes, timeout);
  if (!n)
    return io_error("QSB \"" + name_ + "\": " + n.error().message +
                    "; check that the QSB is plugged in");
  const std::int64_t received_ns = monotonic_ns();
  received_.append(bytes.data(), *n);
  Status status;
  while (const auto line = next_line())
    if (status = take_line(*line, received_ns); !status) break;
  if (samples_.empty()) return status;
  const double before_ns = tick_.ns();
  tick_.add(*last_stamp_, received_ns);
  // The line of the clock belongs to stamps with the old length of a tick. To keep this line would
  // make all packets late for a minute.
  if (tick_.ns() != before_ns) clock_.reset();
  clock_.add(samples_.back().device_ns, received_ns);
  return status;
}

Status Qsb::take_line(std::string_view line, std::int64_t received_ns) {
  if (is_qsb_banner(line))
    return io_error(place() + ": was reset during the stream (\"" +
                    std::string(line.substr(0, 20)) +
                    "\"), so its count began at 0; check the power, and reference the axis again");
  const auto reply = parse_qsb_line(line);
  if (reply && reply->type == 's' && reply->reg == qsb::kCount && reply->stamp)
    return take_sample(*reply, received_ns);
  // This line is the reply to the command that disables the index.
  if (reply && reply->type == 'w' && reply->reg == qsb::kMdr0) return {};
  return take_malformed();
}

Status Qsb::take_malformed() {
  ++malformed_;
  if (++malformed_in_a_row_ <= kMalformedAllowed) return {};
  return io_error(place() + ": " + std::to_string(malformed_in_a_row_) +
                  " malformed lines in a row; check the cable and the baud rate");
}

Status Qsb::take_sample(const QsbReply& reply, std::int64_t received_ns) {
  const std::int64_t stamp = stamp_(*reply.stamp);
  const std::int64_t step = last_stamp_ ? stamp - *last_stamp_ : 0;
  if (last_stamp_ && step == 0) {  // a repeated stamp means that the line has no new data
    malformed_in_a_row_ = 0;
    return {};
  }
  const double step_ns = static_cast<double>(step) * tick_.ns();
  const auto passed_ns = static_cast<double>(received_ns - last_sample_ns_);
  if (step < 0 || step_ns > 2 * passed_ns + kMaxStampLead_ns)
    return io_error(
        place() + ": the time stamps jumped by " + std::to_string(step) +
        " ticks; the QSB was reset, or the serial line is disturbed; reference the axis again");
  const std::int64_t count = count_(reply.data);
  MDOF_TRY(const IndexMark::State mark, watch_mark(count, received_ns));
  if (mark == IndexMark::State::unexplained) return take_malformed();
  malformed_in_a_row_ = 0;
  const auto lines = std::llround(static_cast<double>(step) / options_.interval);
  const std::uint64_t lost = lines > 1 ? static_cast<std::uint64_t>(lines - 1) : 0;
  last_stamp_ = stamp;
  last_sample_ns_ = received_ns;
  device_ns_ += step_ns;
  const std::int64_t from = mark == IndexMark::State::passed ? mark_.from_mark(count) : count;
  const double um = mark == IndexMark::State::at_mark
                        ? kNaN
                        : static_cast<double>(from) * options_.channel.um_per_count;
  samples_.push_back({std::llround(device_ns_), um, lost, marks_found_});
  return {};
}

// If one count is unexplained, its line was damaged. If many successive counts are unexplained, the
// count has a new zero.
Result<IndexMark::State> Qsb::watch_mark(std::int64_t count, std::int64_t received_ns) {
  using State = IndexMark::State;
  const State before = mark_.state();
  const State now = mark_.take(count);
  if (now == State::unexplained && malformed_in_a_row_ >= kMalformedAllowed) mark_datum_lost();
  if (now == State::at_mark && before != now) at_mark_since_ns_ = received_ns;
  if (now == State::passed && before != now) {
    ++marks_found_;
    MDOF_CHECK(stream_->write(qsb_command('W', qsb::kMdr0, options_.counting), kAnswer));
  }
  return now;
}

}  // namespace mdof::drivers
