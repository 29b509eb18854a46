#include "drivers/labjack_u6/labjack_u6.h"

#include <algorithm>
#include <cmath>

#include "drivers/clock/monotonic.h"
#include "drivers/labjack_u6/setup.h"
#include "drivers/scan_block.h"

namespace mdof::drivers::labjack_u6 {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr double kSilence_s = 2;
constexpr const char* kZeroLost = "the LabJack U6 lost power, and its counter restarted at 0";

bool counts(const Input& input) {
  return input.ain < 0;
}

Result<std::string> query_serial(usb::Handle& handle) {
  MDOF_TRY(const Identity identity, identify(handle));
  return std::to_string(identity.serial);
}

// Returns the input with the counter; nullptr: no counter.
const Input* counter_of(const Settings& settings) {
  const auto at = std::find_if(settings.inputs.begin(), settings.inputs.end(), counts);
  return at == settings.inputs.end() ? nullptr : &*at;
}

std::string speed_of(const Settings& settings) {
  const Input* counter = counter_of(settings);
  const std::string speed =
      counter ? labjack::speed_text(counter->most_counts_per_s, counter->um_per_count) : "";
  return speed.empty() ? "" : ", " + speed;
}

std::string describe(const Identity& id, const std::string& where) {
  return std::string("LabJack U6") + (id.pro ? "-Pro " : " ") + std::to_string(id.serial) +
         ", firmware " + std::to_string(id.firmware_major) + "." +
         (id.firmware_minor < 10 ? "0" : "") + std::to_string(id.firmware_minor) + ", at " + where;
}

}  // namespace

LabjackU6::LabjackU6(Settings settings)
    : settings_(std::move(settings)),
      list_(scan_list(settings_.inputs)),
      scan_clock_(stream_clock(settings_.rate_hz).value()),
      samples_(static_cast<std::size_t>(
          samples_per_packet(scan_clock_.rate_hz * static_cast<double>(list_.size())))),
      description_("LabJack U6"),
      line_(list_.size()),
      clock_(1e9 / scan_clock_.rate_hz) {
  for (const Input& input : settings_.inputs) channels_.push_back(input.channel);
  if (const Input* counter = counter_of(settings_))
    counter_ = labjack::Counter(counter->most_counts_per_s);
}

LabjackU6::~LabjackU6() {
  close();
}

DeviceInfo LabjackU6::info() const {
  return {settings_.name,      "labjack_u6", description_,   channels_,
          scan_clock_.rate_hz, false,        clock_.state(), counter_.invalid_reason(kZeroLost)};
}

void LabjackU6::trust_count() {
  counter_.trust();
}

std::string LabjackU6::place() const {
  const std::string serial = settings_.serial.empty() ? "" : " " + settings_.serial;
  return "device \"" + settings_.name + "\" (LabJack U6" + serial + ")";
}

Status LabjackU6::open() {
  close();
  if (auto started = start(); !started) {
    close();
    return in_context(place(), std::move(started.error()));
  }
  return {};
}

// Stops the stream, so that other programs can use the device. Errors are ignored.
void LabjackU6::close() {
  if (handle_ && stream_ && !received_.has_error()) (void)ask(*handle_, stream_stop());
  stream_.reset();
  handle_.reset();
  line_ = ScanNumbering(list_.size());
  received_.clear();
  clock_.reset();
  counter_.interrupt();
  loss_.close();
}

Status LabjackU6::start() {
  MDOF_TRY(handle_,
           usb::Handle::open({"LabJack U6", kVendor, kProduct, settings_.serial, 0, query_serial}));
  MDOF_TRY(const Identity identity, identify(*handle_));
  description_ = describe(identity, handle_->where()) + speed_of(settings_);
  MDOF_CHECK(stop_stream(*handle_));
  MDOF_TRY(calibrations_, read_ain_calibrations(*handle_));
  MDOF_CHECK(start_or_keep_counter());
  const StreamSetup setup{static_cast<int>(samples_), settings_.resolution_index,
                          settings_.settling_10us, list_};
  MDOF_TRY(const std::string configured, ask(*handle_, stream_config(setup, scan_clock_)));
  MDOF_CHECK(read_stream_config(configured));
  const double samples_hz = scan_clock_.rate_hz * static_cast<double>(list_.size());
  MDOF_TRY(stream_, usb::InStream::start(*handle_, transfers_for(samples_hz)));
  MDOF_TRY(const std::string started, ask(*handle_, stream_start()));
  last_chunk_ns_ = monotonic_ns();
  return read_stream_start(started);
}

// The U6 does not report the mode of timers that another program has set. Therefore only a counter
// that this object has started is certain to count.
Status LabjackU6::start_or_keep_counter() {
  const Input* counter = counter_of(settings_);
  if (!counter) return {};
  if (counter_.used()) {
    MDOF_TRY(const bool runs, counter_runs(*handle_, counter->fio));
    counter_.resume_count(runs);
    if (runs) return {};
  }
  MDOF_CHECK(start_counter(*handle_, counter->fio));
  counter_.resume_count(false);
  return {};
}

Result<ReadState> LabjackU6::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, settings_.name, channels_);
  if (!stream_) return io_error(place() + " is not open; call open() before read()");
  MDOF_CHECK(received_.next(place(), [&] { return receive(timeout); }));
  received_.fill(block, [&](const Scan& scan) { append(block, scan); });
  return ReadState::more;
}

// Returns when scans have arrived, or after `timeout`.
Status LabjackU6::receive(milliseconds timeout) {
  const auto until = steady_clock::now() + timeout;
  const double packet_s =
      static_cast<double>(samples_) / (scan_clock_.rate_hz * static_cast<double>(list_.size()));
  do {
    MDOF_TRY(const usb::InStream::Chunk chunk, stream_->next(until));
    if (chunk.any) MDOF_CHECK(take(chunk));
    if (static_cast<double>(monotonic_ns() - last_chunk_ns_) * 1e-9 > kSilence_s + packet_s)
      return silence_error();
  } while (received_.scans().empty() && steady_clock::now() < until);
  return {};
}

// The packet that contains the reason may be in a transfer that is not full.
Status LabjackU6::silence_error() {
  stream_->cancel();
  if (const auto last = stream_->next(steady_clock::now())) MDOF_CHECK(take(*last));
  return io_error(
      "no data for 2 s; another program has stopped the stream, or the U6 does not respond; unplug "
      "the U6 and plug it in again");
}

Status LabjackU6::take(const usb::InStream::Chunk& chunk) {
  last_chunk_ns_ = chunk.received_ns;
  const std::size_t before = received_.scans().size(), size = stream_bytes(samples_);
  Status taken;
  for (std::size_t at = 0; taken && at < chunk.bytes.size(); at += size) {
    const auto packet = decode(chunk.bytes.substr(at, size), samples_);
    taken = packet ? line_.take(*packet, received_.scans()) : tl::unexpected(packet.error());
  }
  if (received_.scans().size() > before)
    clock_.add(static_cast<std::int64_t>(received_.scans().back().index), chunk.received_ns);
  return taken;
}

void LabjackU6::append(SampleBlock& block, const Scan& scan) {
  const std::int64_t time_ns = clock_.host_ns(static_cast<std::int64_t>(scan.index));
  block.lost += scan.lost + loss_.take(time_ns, scan_clock_.rate_hz);
  block.time_ns.push_back(time_ns);
  std::size_t word = 0;
  for (std::size_t c = 0; c < settings_.inputs.size(); ++c) {
    const Input& input = settings_.inputs[c];
    const std::uint16_t first = scan.words[word++];
    if (!counts(input)) {
      const auto gain = static_cast<std::size_t>(input.gain);
      block.value[c].push_back(labjack::volts(calibrations_[gain], first));
      block.quality[c].push_back(labjack::at_rail(first) ? Quality::over_range : Quality::good);
      continue;
    }
    const auto raw = static_cast<std::uint32_t>(scan.words[word++]) << 16 | first;
    const std::int64_t count =
        counter_.take(raw, static_cast<double>(scan.index) / scan_clock_.rate_hz);
    block.value[c].push_back(static_cast<double>(count) * input.um_per_count);
    block.quality[c].push_back(counter_.sure() ? Quality::good : Quality::suspect);
  }
}

std::vector<Entry> scan_list(const std::vector<Input>& inputs) {
  std::vector<Entry> list;
  for (const Input& input : inputs) {
    if (counts(input)) {
      list.insert(list.end(), {Entry{kTimer0}, Entry{kCapture}});
    } else {
      list.push_back({input.ain, input.gain, input.differential});
    }
  }
  return list;
}

int samples_per_packet(double samples_hz) {
  constexpr double kWait_s = 0.02;
  return static_cast<int>(std::clamp(samples_hz * kWait_s, 1.0, static_cast<double>(kMostSamples)));
}

usb::InStream::Options transfers_for(double samples_hz) {
  constexpr double kTransfer_s = 5e-3, kWaiting_s = 0.25;
  const double packets_hz = samples_hz / samples_per_packet(samples_hz);
  const double packets = std::clamp(std::floor(packets_hz * kTransfer_s), 1.0, 32.0);
  const double transfers = std::clamp(std::ceil(packets_hz / packets * kWaiting_s), 4.0, 64.0);
  return {kStreamIn, static_cast<std::size_t>(packets) * stream_bytes(kMostSamples),
          static_cast<std::size_t>(transfers)};
}

}  // namespace mdof::drivers::labjack_u6
