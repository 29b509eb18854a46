#include "drivers/linux_comedi/protocol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "schema/base/number/number_text.h"

namespace mdof::drivers::linux_comedi {
namespace {

constexpr std::array<const char*, 4> kReferences = {"ground", "common", "differential", "other"};
constexpr double kConvert_us = 20;  // settling time of the multiplexer on most boards
constexpr double kWakeEach_Hz = 1000;

unsigned period_ns(double period_s) {
  return static_cast<unsigned>(std::clamp(std::round(period_s * 1e9), 1.0, 4294967295.0));
}

bool can(const Event& event, Source source) {
  return (event.source & source) != 0;
}

Result<Event> conversion(const Command& sources, std::size_t inputs, const ScanTiming& timing) {
  if (!timing.convert_us && can(sources.convert, kNow)) return Event{kNow, 0};
  if (!can(sources.convert, kTimer)) {
    if (can(sources.convert, kNow))
      return bad_input("the board converts all inputs of a scan at once; remove convert_us");
    return bad_input(
        "the board cannot time its conversions by itself, so this driver cannot read the board");
  }
  const double scan_us = 1e6 / timing.rate_hz;
  const double each_us =
      std::min(timing.convert_us.value_or(kConvert_us), scan_us / static_cast<double>(inputs));
  return Event{kTimer, period_ns(each_us * 1e-6)};
}

// For boards without a timer for scans: the conversions follow each other without a pause, one scan
// after the other.
Result<Command> continuous_command(Command command, const Command& sources, double rate_hz) {
  if (!can(sources.scan_begin, kFollow) || !can(sources.convert, kTimer))
    return bad_input(
        "the board has no timer for scans, so this driver cannot read the board (external timers "
        "are not supported)");
  command.scan_begin = {kFollow, 0};
  command.convert = {kTimer, period_ns(1 / rate_hz / static_cast<double>(command.inputs.size()))};
  return command;
}

}  // namespace

const char* name_of(Reference reference) {
  return kReferences[static_cast<std::size_t>(reference)];
}

std::optional<Reference> reference_of(const std::string& name) {
  for (std::size_t n = 0; n < kReferences.size(); ++n)
    if (name == kReferences[n]) return static_cast<Reference>(n);
  return std::nullopt;
}

std::optional<unsigned> range_index(const std::vector<Range>& ranges, double low_v, double high_v) {
  const double slack = 1e-6 * (high_v - low_v);
  for (std::size_t n = 0; n < ranges.size(); ++n) {
    const Range& range = ranges[n];
    if (range.volts && std::abs(range.low - low_v) <= slack &&
        std::abs(range.high - high_v) <= slack)
      return static_cast<unsigned>(n);
  }
  return std::nullopt;
}

std::string text_of(const Range& range) {
  return plain_number(range.low) + " to " + plain_number(range.high) + (range.volts ? " V" : "");
}

Result<Command> timed_command(const Command& sources, unsigned subdevice,
                              const std::vector<BoardInput>& inputs, const ScanTiming& timing) {
  Command command;
  command.subdevice = subdevice;
  command.inputs = inputs;
  command.flags = timing.rate_hz <= kWakeEach_Hz ? kWakeEachScan : 0;
  if (!can(sources.start, kNow))
    return bad_input(
        "the board cannot be started by a program, so this driver cannot read the board");
  command.start = {kNow, 0};
  command.scan_end = {kCount, static_cast<unsigned>(inputs.size())};
  command.stop = can(sources.stop, kNone) ? Event{kNone, 0} : Event{kCount, UINT32_MAX};
  if (!can(sources.scan_begin, kTimer)) return continuous_command(command, sources, timing.rate_hz);
  command.scan_begin = {kTimer, period_ns(1 / timing.rate_hz)};
  MDOF_TRY(command.convert, conversion(sources, inputs.size(), timing));
  return command;
}

double rate_of(const Command& command) {
  if (command.scan_begin.source == kTimer) return 1e9 / command.scan_begin.argument;
  return 1e9 / command.convert.argument / static_cast<double>(command.inputs.size());
}

double convert_us(const Command& command) {
  return command.convert.source == kTimer ? command.convert.argument * 1e-3 : 0;
}

const char* failed_step(int test) {
  constexpr std::array<const char*, 6> kSteps = {"success",           "invalid source",
                                                 "source conflict",   "invalid argument",
                                                 "argument conflict", "invalid chanlist"};
  return test >= 0 && test < static_cast<int>(kSteps.size())
             ? kSteps[static_cast<std::size_t>(test)]
             : "unknown";
}

CodeSplitter::CodeSplitter(std::size_t inputs, bool long_samples)
    : inputs_(inputs), size_(long_samples ? 4 : 2) {}

void CodeSplitter::take(std::string_view bytes, std::vector<std::uint32_t>& codes) {
  begun_ += bytes;
  const std::size_t whole = begun_.size() - begun_.size() % (inputs_ * size_);
  for (std::size_t at = 0; at < whole; at += size_) {
    std::uint32_t wide = 0;
    std::uint16_t narrow = 0;
    if (size_ == sizeof wide) {
      std::memcpy(&wide, begun_.data() + at, sizeof wide);
    } else {
      std::memcpy(&narrow, begun_.data() + at, sizeof narrow);
    }
    codes.push_back(wide | narrow);
  }
  begun_.erase(0, whole);
}

Polynomial nominal(const Range& range, std::uint32_t greatest_code) {
  return {{range.low, (range.high - range.low) / greatest_code, 0, 0}, 0};
}

double volts(std::uint32_t code, const Polynomial& to_volts) {
  const double x = code - to_volts.origin;
  double sum = 0, power = 1;
  for (const double coefficient : to_volts.coefficients) {
    sum += coefficient * power;
    power *= x;
  }
  return sum;
}

}  // namespace mdof::drivers::linux_comedi
