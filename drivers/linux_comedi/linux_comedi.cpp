#include "drivers/linux_comedi/linux_comedi.h"

#include <algorithm>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"
#include "schema/base/number/number_text.h"

namespace mdof::drivers::linux_comedi {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::size_t kBuffer = 65536;
constexpr double kSilence_s = 2;
// Number of samples that a board may keep: half the size of a large FIFO.
constexpr double kHalfFifo_samples = 1024;

milliseconds remaining_time(steady_clock::time_point until) {
  return std::max(milliseconds(0), std::chrono::ceil<milliseconds>(until - steady_clock::now()));
}

}  // namespace

LinuxComedi::LinuxComedi(Settings settings)
    : settings_(std::move(settings)),
      rate_hz_(settings_.rate_hz),
      clock_(1e9 / rate_hz_),
      line_(settings_.inputs.size(), false),
      buffer_(kBuffer) {
  for (const InputSetting& input : settings_.inputs) channels_.push_back(input.channel);
  setup_.description = "Comedi board at " + settings_.device;
}

LinuxComedi::~LinuxComedi() {
  close();
}

DeviceInfo LinuxComedi::info() const {
  return {settings_.name, "linux_comedi", setup_.description, channels_,
          rate_hz_,       false,          clock_.state(),     "",
          setup_.notices};
}

std::string LinuxComedi::place() const {
  return "device \"" + settings_.name + "\" (" + settings_.device + ")";
}

Status LinuxComedi::open() {
  close();
  if (auto started = start(); !started) {
    close();
    return in_context(place(), std::move(started.error()));
  }
  return {};
}

void LinuxComedi::close() {
  board_.reset();
  codes_.clear();
  first_ = 0;
  broken_ = {};
  clock_.reset();
  loss_.close();
}

Status LinuxComedi::start() {
  MDOF_TRY(auto board, settings_.open(settings_.device));
  MDOF_TRY(setup_, set_up(*board, settings_));
  rate_hz_ = rate_of(setup_.command);
  clock_ = DeviceClock(1e9 / rate_hz_);
  line_ = CodeSplitter(settings_.inputs.size(), setup_.long_samples);
  MDOF_CHECK(board->start(setup_.command));
  received_ns_ = monotonic_ns();
  board_ = std::move(board);
  return {};
}

// An error is returned after all scans that precede it.
Result<ReadState> LinuxComedi::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, settings_.name, channels_);
  if (!board_) return io_error(place() + " is not open; call open() before read()");
  if (broken_) {
    if (auto received = receive(steady_clock::now() + timeout); !received)
      broken_ = in_context(place(), std::move(received.error()));
  }
  if (!broken_) return tl::unexpected(broken_.error());
  fill_block(block);
  return ReadState::more;
}

// Waits for scans until `until` at most.
Status LinuxComedi::receive(Time until) {
  do {
    MDOF_TRY(const Received received, board_->receive(buffer_, remaining_time(until)));
    if (received.bytes > 0) take(received.bytes);
    MDOF_CHECK(check(received.stream));
  } while (codes_.empty() && steady_clock::now() < until);
  return {};
}

void LinuxComedi::take(std::size_t bytes) {
  received_ns_ = monotonic_ns();
  line_.take({buffer_.data(), bytes}, codes_);
  const std::uint64_t scans = first_ + codes_.size() / channels_.size();
  if (!codes_.empty()) clock_.add(static_cast<std::int64_t>(scans) - 1, received_ns_);
}

Status LinuxComedi::check(StreamState stream) {
  if (stream == StreamState::overran)
    return io_error(
        "the buffer of the board, or of the kernel (" + plain_number(setup_.buffer_s) +
        " s), has overflowed; lower rate_hz, end programs that slow down this computer, or "
        "enlarge the buffer of the kernel (comedi_config --read-buffer)");
  if (stream == StreamState::ended)
    return io_error("the board has stopped scanning without a request; dmesg may show the reason");
  const double silent_s = static_cast<double>(monotonic_ns() - received_ns_) * 1e-9;
  const double kept_s = kHalfFifo_samples / rate_hz_ / static_cast<double>(channels_.size());
  if (silent_s > kSilence_s + kept_s)
    return io_error("no data for " + plain_number(kSilence_s + kept_s) +
                    " s although the board scans, because the interrupts of the board do not "
                    "arrive; dmesg may show the reason");
  return {};
}

void LinuxComedi::fill_block(SampleBlock& block) {
  const std::size_t scans = codes_.size() / channels_.size();
  for (std::size_t scan = 0; scan < scans; ++scan) append(block, scan);
  codes_.clear();
  first_ += scans;
}

void LinuxComedi::append(SampleBlock& block, std::size_t scan) {
  const std::int64_t time_ns = clock_.host_ns(static_cast<std::int64_t>(first_ + scan));
  block.lost += loss_.take(time_ns, rate_hz_);
  block.time_ns.push_back(time_ns);
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const std::uint32_t code = codes_[scan * channels_.size() + c];
    const Conversion& conversion = setup_.conversions[c];
    block.value[c].push_back(volts(code, conversion.to_volts));
    block.quality[c].push_back(at_rail(code, conversion.greatest_code) ? Quality::over_range
                                                                       : Quality::good);
  }
}

}  // namespace mdof::drivers::linux_comedi
