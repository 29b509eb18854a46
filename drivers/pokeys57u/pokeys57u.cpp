#include "drivers/pokeys57u/pokeys57u.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"

namespace mdof::drivers::pokeys57u {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr milliseconds kTickEvery{1000}, kQuiet{10};
// Largest number of reports for requests of another program that may still arrive.
constexpr int kMostStale = 200;
// Tolerances for the difference between the device's tick and the host's clock.
constexpr double kTickSlack_ms = 500, kTickDrift = 0.001;
constexpr double kStepSlack_counts = 16;

bool has_our_ids(const HidEntry& entry) {
  const bool product = entry.product == kProduct || entry.product == kProduct + 1;
  return product && (entry.interface == kInterface || entry.interface == -1);
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

}  // namespace

PoKeys57u::PoKeys57u(Settings settings)
    : settings_(std::move(settings)),
      period_(std::llround(settings_.poll_ms * 1e6)),
      counters_(settings_.inputs.size()) {
  for (const Input& input : settings_.inputs) channels_.push_back(input.channel);
}

std::string PoKeys57u::place() const {
  return "device \"" + settings_.name + "\" (" + identity_.model() +
         (settings_.serial ? " " + std::to_string(settings_.serial) : "") +
         (device_ ? " at " + device_->path() : "") + ")";
}

DeviceInfo PoKeys57u::info() const {
  std::string text = "PoLabs " + identity_.model();
  if (identity_.serial) text += " " + std::to_string(identity_.serial);
  if (!identity_.firmware.empty()) text += ", firmware " + identity_.firmware;
  if (device_) text += ", at " + device_->path();
  return {settings_.name,           "pokeys57u", text, channels_,
          1000 / settings_.poll_ms, false,       {},   zero_problem_};
}

void PoKeys57u::trust_count() {
  for (Counter& counter : counters_) counter.sure = true;
  zero_problem_.clear();
}

Status PoKeys57u::open() {
  device_.reset();
  failing_ = false;
  if (auto found = connect(); !found) {
    device_.reset();
    return found;
  }
  MDOF_CHECK(set_up_encoders());
  MDOF_TRY(const auto reported, watch_for_restart());
  if (!reported) return no_answer_error("query for the time");
  next_ = last_ = steady_clock::now();
  return {};
}

// Finds the device by its serial number. The driver asks each device for its number, because the
// USB serial string has two formats.
Status PoKeys57u::connect() {
  std::vector<std::string> others;
  Status failed;
  std::vector<HidEntry> found;
  for (HidEntry& entry : list_hid(kVendor))
    if (has_our_ids(entry)) found.push_back(std::move(entry));
  if (settings_.serial == 0 && found.size() > 1) {
    for (const auto& entry : found) others.push_back(entry.serial);
    return io_error(place() + ": " + std::to_string(found.size()) +
                    " PoKeys are plugged in (serial numbers on the USB: " + joined(others) +
                    "); give one of these numbers with the key \"serial\"");
  }
  for (const auto& entry : found) {
    const bool may_be = settings_.serial == 0 || entry.serial.empty() ||
                        may_be_serial(entry.serial, settings_.serial);
    if (!may_be) {
      others.push_back(entry.serial);
    } else if (auto tried = try_candidate(entry, others); !tried) {
      failed = std::move(tried);
    } else if (device_) {
      return {};
    }
  }
  if (!failed) return failed;
  return io_error(place() + ": is not plugged in" +
                  (others.empty() ? "" : " (found: " + joined(others) + ")") +
                  "; check the cable, the power and the serial number");
}

Status PoKeys57u::try_candidate(const HidEntry& entry, std::vector<std::string>& others) {
  auto opened = HidDevice::open(entry.path);
  if (!opened) return in_context(place(), opened.error());
  device_.emplace(std::move(*opened));
  for (int stale = 0; stale < kMostStale; ++stale) {
    MDOF_TRY(const std::string waste, device_->read(kFrameBytes, kQuiet));
    if (waste.empty()) break;
  }
  MDOF_TRY(const Frame reply, need(request(kDeviceData), "query for the device data"));
  const Identity identity = identity_of(reply);
  if (settings_.serial != 0 && identity.serial != settings_.serial) {
    others.push_back(std::to_string(identity.serial));
    device_.reset();
    return {};
  }
  identity_ = identity;
  return {};
}

Result<Frame> PoKeys57u::need(const Frame& asked, const char* what) {
  MDOF_TRY(const auto reply, exchange(asked));
  if (reply) return reply->frame;
  return no_answer_error(what);
}

tl::unexpected<Error> PoKeys57u::no_answer_error(const char* what) const {
  return io_error(place() + ": no reply to the " + what +
                  "; check that the device is a PoKeys57U " +
                  "or 56U, and end any other program that uses the device");
}

Status PoKeys57u::set_up_encoders() {
  MDOF_TRY(const Frame is, need(request(kEncoderOptions), "query for the encoder settings"));
  Frame wanted = request(kEncoderOptions, 1);
  wanted.data = is.data;
  for (const Input& input : settings_.inputs)
    if (input.options) wanted.data[input.index] = *input.options;
  if (wanted.data == is.data) return check_enabled(is);
  MDOF_CHECK(need(wanted, "command that sets the encoders"));
  MDOF_TRY(const Frame now, need(request(kEncoderOptions), "query for the encoder settings"));
  for (const Input& input : settings_.inputs) {
    if (input.options && (now.data[input.index] & 7) != *input.options)
      return io_error(place() + ": " + input.name +
                      " does not accept the value of the key \"counting\"; set the encoder with "
                      "the program of the manufacturer, and remove this key");
  }
  return check_enabled(now);
}

// Encoders 1 to 3 are not checked, because they may be fast encoders, which are enabled in another
// setting.
Status PoKeys57u::check_enabled(const Frame& options) const {
  for (const Input& input : settings_.inputs) {
    if (input.index < 3 || input.index >= kEncoders) continue;
    if ((options.data[input.index] & kEnabled) == 0)
      return io_error(place() + ": " + input.name +
                      " is switched off; set counting = \"x4\" in the channel of this encoder, and "
                      "set the pins of the encoder with the program of the manufacturer");
  }
  return {};
}

// Compares the device's tick (milliseconds since the device was switched on) with the host's clock.
// If the tick and the clock do not agree, the power of the device has failed and its counts have
// started at 0 again. The difference is calculated modulo 2^32. Therefore after more than 24.9 days
// a restart appears as a tick that is too large; this is detected too.
Result<std::optional<PoKeys57u::Span>> PoKeys57u::watch_for_restart() {
  MDOF_TRY(const auto reply, exchange(request(kTick)));
  if (!reply) return std::nullopt;
  const Tick now{tick_of(reply->frame), reply->span.middle()};
  tick_due_ = now.at + kTickEvery;
  const auto before = std::exchange(tick_, now);
  if (!before) return reply->span;
  const double passed_ms = std::chrono::duration<double, std::milli>(now.at - before->at).count();
  const auto behind = static_cast<std::int32_t>(
      before->ms + static_cast<std::uint32_t>(std::llround(passed_ms)) - now.ms);
  if (std::abs(static_cast<double>(behind)) < kTickSlack_ms + passed_ms * kTickDrift)
    return reply->span;
  zero_problem_ = "the PoKeys lost power, and its encoders restarted at 0";
  for (Counter& counter : counters_) {
    counter = {};
    counter.sure = false;
  }
  return reply->span;
}

Result<std::optional<PoKeys57u::Reply>> PoKeys57u::exchange(Frame asked) {
  for (int sends = 0; sends < kSends; ++sends) {
    asked.id = ids_.next(monotonic_ns());
    const auto sent = steady_clock::now();
    MDOF_CHECK(device_->write(wrap(Way::request, asked)));
    MDOF_TRY(const auto frame, reply_to(asked.id, sent + settings_.response_timeout));
    if (frame) return Reply{*frame, {sent, steady_clock::now()}};
  }
  return std::nullopt;
}

// The command byte is not compared, because the specification states another byte for some replies.
// The request number and the checksum are sufficient.
Result<std::optional<Frame>> PoKeys57u::reply_to(std::uint8_t id, Time until) {
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - steady_clock::now());
    MDOF_TRY(const std::string report, device_->read(kFrameBytes, left));
    if (report.empty()) return std::nullopt;
    auto frame = unwrap(Way::reply, report);
    if (frame) ids_.answered(frame->id);
    if (frame && frame->id == id) return frame;
    ++rejected_;
  }
}

Result<ReadState> PoKeys57u::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, settings_.name, channels_);
  if (!device_) return io_error(place() + ": is not open; call open() before read()");
  const auto until = steady_clock::now() + timeout;
  do {
    std::this_thread::sleep_until(std::min(next_, until));
    if (steady_clock::now() < next_) break;
    if (const Status polled = poll(block); !polled) {
      device_.reset();
      return in_context(place(), polled.error());
    }
  } while (block.scans() == 0 && steady_clock::now() < until);
  return ReadState::more;
}

Status PoKeys57u::poll(SampleBlock& block) {
  const auto start = steady_clock::now();
  std::optional<Span> span = Span{};
  if (start >= tick_due_ && !failing_) {
    MDOF_TRY(span, watch_for_restart());
  }
  const auto begin = steady_clock::now();
  if (span) {
    MDOF_TRY(span, fetch());
  }
  next_ = std::max(next_ + period_, start);
  if (span) {
    append(block, *span, span->to - begin);
    return {};
  }
  failing_ = true;
  if (steady_clock::now() - last_ < settings_.silence) return {};
  return io_error("no valid reply for " + std::to_string(settings_.silence.count()) +
                  " ms; check the cable, and end any other program that uses the device");
}

// Requests only those blocks of counts and analogue inputs that the channels use. Returns the times
// of the last request.
Result<std::optional<PoKeys57u::Span>> PoKeys57u::fetch() {
  std::array<bool, 3> needed{};
  for (const Input& input : settings_.inputs) needed[input.index / kCountersPerBlock] = true;
  std::optional<Span> last;
  for (std::size_t block = 0; block < needed.size(); ++block) {
    if (!needed[block]) continue;
    const bool counts = block < counts_.size();
    MDOF_TRY(const auto reply,
             exchange(counts ? request(kEncoderValues, static_cast<std::uint8_t>(block))
                             : request(kAnalogue, 1)));
    if (!reply) return std::nullopt;
    if (counts) counts_[block] = counts_of(reply->frame);
    if (!counts) analogue_ = analogue_of(reply->frame);
    last = reply->span;
  }
  return last;
}

void PoKeys57u::append(SampleBlock& block, const Span& span, nanoseconds duration) {
  const Time time = span.middle();
  const double missed = std::round(std::chrono::duration<double>(time - last_) / period_) - 1;
  if (std::exchange(failing_, false))
    block.lost = static_cast<std::uint64_t>(std::max(1.0, missed));
  block.time_ns.push_back(nanoseconds(time.time_since_epoch()).count());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    Quality quality = duration > settings_.slow ? Quality::suspect : Quality::good;
    block.value[i].push_back(value_of(i, time, quality));
    block.quality[i].push_back(quality);
  }
  last_ = time;
}

double PoKeys57u::value_of(std::size_t i, Time time, Quality& quality) {
  const Input& input = settings_.inputs[i];
  if (!input.counts()) {
    const std::uint16_t code = analogue_[input.index - kCounters];
    if (code == 0 || code >= kAnalogueTop) quality = Quality::over_range;
    return code * kAnalogueTop_V / kAnalogueTop;
  }
  const std::int32_t raw =
      counts_[input.index / kCountersPerBlock][input.index % kCountersPerBlock];
  Counter& counter = counters_[i];
  const std::int64_t count = counter.unwrap(static_cast<std::uint32_t>(raw));
  const std::chrono::duration<double> passed = time - counter.at;
  const double most = input.most_counts_per_s * passed.count();
  const auto step = static_cast<double>(count - counter.last.value_or(count));
  if (counter.sure && std::abs(step) > most + kStepSlack_counts) {
    counter.sure = false;
    zero_problem_ = input.name + " jumped by " + std::to_string(std::llround(step)) +
                    " counts, which is faster than the input can count";
  }
  counter.last = count;
  counter.at = time;
  if (!counter.sure) quality = Quality::suspect;
  return static_cast<double>(count) * input.um_per_count;
}

}  // namespace mdof::drivers::pokeys57u
