#include "drivers/qsb/simulated_qsb.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace mdof::drivers {
namespace {

constexpr std::uint32_t kFactoryEor = 0x0B, kNoOutput = 0xFFFF;
constexpr std::uint32_t kVersionOfTests = 0x00001201;  // serial 00001, QSB-S, firmware 01
// A count that neither a motion nor the preset of the mark explains.
constexpr std::uint32_t kFar = 0x3000'0000;
constexpr const char* kBanner = "QSB-S  0E!\r\n";

std::uint32_t hex(std::string_view text) {
  std::uint32_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

}  // namespace

SimulatedQsb::SimulatedQsb(Senses senses, const Options& options)
    : senses_(std::move(senses)), faults_(options.faults) {
  registers_[qsb::kEor] = kFactoryEor;
  registers_[qsb::kInterval] = kNoOutput;
}

void SimulatedQsb::opened(std::size_t, int, std::int64_t now_ns) {
  if (stamp_from_ns_ == 0) stamp_from_ns_ = now_ns;
  if (!std::exchange(faults_.streams_at_start, false)) return;
  registers_[qsb::kInterval] = 1;
  streaming_ = true;
  next_tick_ = tick_at(now_ns);
}

void SimulatedQsb::reset(std::int64_t now_ns) {
  registers_ = {};
  registers_[qsb::kEor] = kFactoryEor;
  registers_[qsb::kInterval] = kNoOutput;
  registers_[qsb::kStatus] = qsb::kPowerWasLost;
  stamp_from_ns_ = now_ns;
  count_from_ = senses_(0, now_ns);
  streaming_ = false;
}

std::int64_t SimulatedQsb::tick_at(std::int64_t now_ns) const {
  return static_cast<std::int64_t>(static_cast<double>(now_ns - stamp_from_ns_) / faults_.tick_ns);
}

std::uint32_t SimulatedQsb::count_at(std::int64_t t_ns) {
  const double position = senses_(0, t_ns);
  watch_mark(position);
  return static_cast<std::uint32_t>(std::llround(position - count_from_));
}

// If the index is set to load, the counter loads the number in DTR at the mark. With the wrong
// polarity it loads this number at every second count (where A and B are equal), except at the
// mark.
void SimulatedQsb::watch_mark(double position) {
  const double from = std::exchange(last_position_, position);
  const bool loads = (registers_[qsb::kMdr0] & 0x30) == qsb::kIndexLoads;
  if (!mark_ || !loads) return;
  const auto load = static_cast<double>(static_cast<std::int32_t>(registers_[qsb::kLoad]));
  const bool inverts = (registers_[qsb::kMdr1] & qsb::kIndexInverted) != 0;
  if (inverts != mark_->inverted)
    count_from_ = 2 * std::round(position / 2) - load;
  else
    for (const double at : {mark_->at, mark_->next_at})
      if (std::min(from, position) <= at && at <= std::max(from, position)) count_from_ = at - load;
}

std::uint32_t SimulatedQsb::read(std::uint8_t reg, std::int64_t now_ns) {
  if (reg == qsb::kVersion) return kVersionOfTests;
  if (reg == qsb::kCount) return count_at(now_ns);
  if (reg == qsb::kStamp) return static_cast<std::uint32_t>(tick_at(now_ns));
  return registers_[reg];
}

void SimulatedQsb::write(std::uint8_t reg, std::uint32_t data, std::int64_t now_ns) {
  if (reg == qsb::kMdr0) watch_mark(senses_(0, now_ns));  // uses the setting before this change
  if (reg == qsb::kCommand && data == 1) streaming_ = false;
  if (reg == qsb::kStamp && data == 1) stamp_from_ns_ = now_ns;
  registers_[reg] = data;
}

QsbReply SimulatedQsb::answer(char type, std::uint8_t reg, std::uint32_t data,
                              std::int64_t now_ns) {
  const auto stamp = [&] { return static_cast<std::uint32_t>(tick_at(now_ns)); };
  if (reg == faults_.refuse) return {'e', reg, data, stamp()};
  if (reg == faults_.unsupported) return {'x', reg, data, stamp()};
  if (type == 'W') {
    write(reg, data, now_ns);
    return {'w', reg, data, stamp()};
  }
  if (type == 'S') {
    streaming_ = true;
    line_ = 0;
    next_tick_ = tick_at(now_ns) + registers_[qsb::kInterval];
  }
  return {type == 'S' ? 's' : 'r', reg, read(reg, now_ns), stamp()};
}

std::string SimulatedQsb::execute(std::string_view command, std::int64_t now_ns) {
  if (command.size() < 3 || command.size() > 11 || faults_.mute) return "";
  const char type = command[0];
  const auto reg = static_cast<std::uint8_t>(hex(command.substr(1, 2)));
  if (type != 'R' && type != 'W' && type != 'S')
    return qsb_line({'x', reg, 0, std::nullopt}, registers_[qsb::kEor]);
  const QsbReply reply = answer(type, reg, hex(command.substr(3)), now_ns);
  return qsb_line(reply, registers_[qsb::kEor]);
}

std::string SimulatedQsb::exchange(std::size_t, int, std::string_view received,
                                   std::int64_t now_ns) {
  std::string out = stream(now_ns);
  received_ += received;
  for (std::size_t end; (end = received_.find_first_of("\r\n")) != std::string::npos;) {
    out += execute(received_.substr(0, end), now_ns);
    received_.erase(0, end + 1);
  }
  return out;
}

std::string SimulatedQsb::stream(std::int64_t now_ns) {
  std::string out;
  while (streaming_ && registers_[qsb::kInterval] != kNoOutput && next_tick_ <= tick_at(now_ns) &&
         line_ != faults_.silent_from) {
    if (line_++ == faults_.reset_at) {
      reset(now_ns);
      return out + kBanner;
    }
    out += stream_line(next_tick_);
    next_tick_ += registers_[qsb::kInterval];
  }
  return out;
}

std::string SimulatedQsb::stream_line(std::int64_t tick) {
  if (faults_.rubbish) return "s 0E ?\xff\x01 !\r\n";
  const std::int64_t t_ns =
      stamp_from_ns_ + std::llround(static_cast<double>(tick) * faults_.tick_ns);
  const std::uint32_t jump =
      faults_.jump_at >= 0 && line_ > faults_.jump_at ? faults_.jump_ticks : 0;
  const auto stamp = static_cast<std::uint32_t>(tick) + jump;
  const bool far =
      faults_.first_far_line >= 0 && line_ > faults_.first_far_line && faults_.far_line_count > 0;
  if (far) --faults_.far_line_count;
  const std::string line =
      qsb_line({'s', qsb::kCount, count_at(t_ns) + (far ? kFar : 0), stamp}, registers_[qsb::kEor]);
  return line_ - 1 == faults_.cut_at ? line.substr(0, line.size() / 2) : line;
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_qsb(SimulatedWiring& wiring) {
  return std::make_unique<SimulatedQsb>(wiring.senses({wiring.counts(wiring.first_or_encoder())}),
                                        SimulatedQsb::Options{});
}

}  // namespace mdof::drivers
