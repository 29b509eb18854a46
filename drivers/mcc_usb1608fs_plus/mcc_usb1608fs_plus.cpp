#include "drivers/mcc_usb1608fs_plus/mcc_usb1608fs_plus.h"

#include <algorithm>
#include <bit>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kReply{500}, kQuiet{20};
constexpr milliseconds kStatusEvery{100};
constexpr double kSilence_s = 2;

// Position of each channel in a scan. The device sends the inputs in the order of their numbers.
std::vector<std::size_t> words_of(const std::vector<Input>& inputs) {
  std::vector<std::size_t> words;
  const unsigned mask = mask_of(inputs);
  for (const Input& input : inputs)
    words.push_back(static_cast<std::size_t>(std::popcount(mask & ((1U << input.input) - 1))));
  return words;
}

const char* const kOverrun =
    "the FIFO of the device has overflowed, because this computer did not read the USB for 80 ms. "
    "An unknown number of scans is missing, so the times of later scans are unknown; lower "
    "rate_hz, or end programs that slow down this computer";

}  // namespace

MccUsb1608fsPlus::MccUsb1608fsPlus(Settings settings)
    : settings_(std::move(settings)),
      setup_(scan_setup(settings_)),
      rate_hz_(rate_of(setup_.period)),
      word_(words_of(settings_.inputs)),
      description_("MCC USB-1608FS-Plus"),
      clock_(1e9 / rate_hz_),
      line_(settings_.inputs.size()) {
  for (const Input& input : settings_.inputs) channels_.push_back(input.channel);
}

MccUsb1608fsPlus::~MccUsb1608fsPlus() {
  close();
}

DeviceInfo MccUsb1608fsPlus::info() const {
  return {settings_.name, "mcc_usb1608fs_plus", description_, channels_, rate_hz_,
          false,          clock_.state()};
}

std::string MccUsb1608fsPlus::place() const {
  const std::string serial = settings_.serial.empty() ? "" : " " + settings_.serial;
  return "device \"" + settings_.name + "\" (MCC USB-1608FS-Plus" + serial + ")";
}

Status MccUsb1608fsPlus::open() {
  close();
  if (auto started = start(); !started) {
    close();
    return in_context(place(), std::move(started.error()));
  }
  return {};
}

// Stops the scan, so that other programs can use the device. Errors are ignored.
void MccUsb1608fsPlus::close() {
  if (handle_ && stream_) (void)handle_->vendor_out(kScanStop, 0, 0, "", kReply);
  stream_.reset();
  handle_.reset();
  line_ = ScanSplitter(settings_.inputs.size());
  words_.clear();
  first_ = confirmed_ = 0;
  clock_.reset();
  loss_.close();
}

Status MccUsb1608fsPlus::start() {
  MDOF_TRY(handle_,
           usb::Handle::open({"MCC USB-1608FS-Plus", kVendor, kProduct, settings_.serial, 0, {}}));
  MDOF_CHECK(stop_scan());
  MDOF_TRY(const std::string serial, handle_->vendor_in(kSerial, 0, 0, kSerialBytes, kReply));
  description_ = "MCC USB-1608FS-Plus " + serial + ", at " + handle_->where();
  MDOF_CHECK(read_calibrations());
  MDOF_CHECK(handle_->vendor_out(kConfig, 0, 0, config(settings_.range.code), kReply));
  const double samples_hz = rate_hz_ * static_cast<double>(settings_.inputs.size());
  MDOF_TRY(stream_, usb::InStream::start(*handle_, transfers_for(samples_hz)));
  MDOF_CHECK(handle_->vendor_out(kScanStart, 0, 0, scan_start(setup_), kReply));
  last_chunk_ns_ = monotonic_ns();
  next_status_ = steady_clock::now() + kStatusEvery;
  return {};
}

// Stops a running scan, even if another program has started it, and discards its remaining data.
Status MccUsb1608fsPlus::stop_scan() {
  MDOF_CHECK(handle_->vendor_out(kScanStop, 0, 0, "", kReply));
  MDOF_CHECK(handle_->vendor_out(kClearFifo, 0, 0, "", kReply));
  MDOF_CHECK(handle_->clear_halt(kSamplesIn));
  return handle_->drain(kSamplesIn, kQuiet);
}

Status MccUsb1608fsPlus::read_calibrations() {
  for (const Input& input : settings_.inputs) {
    const std::uint16_t address = calibration_address(settings_.range.code, input.input);
    MDOF_TRY(const std::string pair,
             handle_->vendor_in(kCalibrationMemory, address, 0, kPairBytes, kReply));
    auto read = read_calibration(pair);
    if (!read) return in_context("CH" + std::to_string(input.input), std::move(read.error()));
    calibrations_[input.input] = *read;
  }
  return {};
}

Result<ReadState> MccUsb1608fsPlus::read(SampleBlock& block, milliseconds timeout) {
  start_block(block, settings_.name, channels_);
  if (!stream_) return io_error(place() + " is not open; call open() before read()");
  if (auto received = receive(steady_clock::now() + timeout); !received)
    return in_context(place(), std::move(received.error()));
  fill_block(block);
  return ReadState::more;
}

// Returns when scans were confirmed, or at the time `until`.
Status MccUsb1608fsPlus::receive(Time until) {
  do {
    MDOF_CHECK(take_chunk(std::min(until, next_status_)));
    if (steady_clock::now() >= next_status_) MDOF_CHECK(check_status());
  } while (confirmed_ == 0 && steady_clock::now() < until);
  return {};
}

Status MccUsb1608fsPlus::take_chunk(Time until) {
  auto chunk = stream_->next(until);
  if (!chunk) return io_error(stream_->stalled() ? kOverrun : chunk.error().message);
  if (!chunk->any) return {};
  last_chunk_ns_ = chunk->received_ns;
  line_.take(chunk->bytes, words_);
  const std::uint64_t scans = first_ + words_.size() / channels_.size();
  if (scans > 0) clock_.add(static_cast<std::int64_t>(scans) - 1, chunk->received_ns);
  return {};
}

Status MccUsb1608fsPlus::check_status() {
  const std::size_t scans = words_.size() / channels_.size();
  MDOF_TRY(const std::string reply, handle_->vendor_in(kStatus, 0, 0, 2, kReply));
  MDOF_TRY(const DeviceStatus status, read_status(reply));
  if (status.overrun) return io_error(kOverrun);
  if (!status.running)
    return io_error(
        "the scan has stopped, because another program has stopped the scan or the device was "
        "reset");
  const double silent_s = static_cast<double>(monotonic_ns() - last_chunk_ns_) * 1e-9;
  if (silent_s > kSilence_s + static_cast<double>(kPacket) / 2 / rate_hz_)
    return io_error(
        "no data for 2 s although the device reports that it scans; unplug the device and plug it "
        "in again");
  confirmed_ = scans;
  next_status_ = steady_clock::now() + kStatusEvery;
  return {};
}

void MccUsb1608fsPlus::fill_block(SampleBlock& block) {
  const std::size_t n = channels_.size();
  for (std::size_t scan = 0; scan < confirmed_; ++scan) {
    const std::int64_t time_ns = clock_.host_ns(static_cast<std::int64_t>(first_ + scan));
    block.lost += loss_.take(time_ns, rate_hz_);
    block.time_ns.push_back(time_ns);
    for (std::size_t c = 0; c < n; ++c) {
      const std::uint16_t raw = words_[scan * n + word_[c]];
      const Calibration& calibration = calibrations_[settings_.inputs[c].input];
      block.value[c].push_back(volts(raw, calibration, settings_.range.volts));
      block.quality[c].push_back(at_rail(raw) ? Quality::over_range : Quality::good);
    }
  }
  words_.erase(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(confirmed_ * n));
  first_ += std::exchange(confirmed_, 0);
}

}  // namespace mdof::drivers::mcc_usb1608fs_plus
