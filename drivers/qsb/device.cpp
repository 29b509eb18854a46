#include "drivers/qsb/device.h"

#include <charconv>
#include <cmath>
#include <utility>

namespace mdof::drivers {
namespace {

constexpr std::uint32_t kFactoryEor = 0x0B, kNoOutput = 0xFFFF;
constexpr std::uint32_t kVersionOfTests = 0x00001201;  // serial 00001, QSB-S, firmware 01
constexpr const char* kBanner = "QSB-S  0E!\r\n";

std::uint32_t hex(std::string_view text) {
  std::uint32_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

}  // namespace

QsbDevice::QsbDevice(Senses senses, Faults faults) : senses_(std::move(senses)), faults_(faults) {
  registers_[qsb::kEor] = kFactoryEor;
  registers_[qsb::kInterval] = kNoOutput;
}

void QsbDevice::opened(std::size_t, int, std::int64_t now_ns) {
  if (stamp_from_ns_ == 0) stamp_from_ns_ = now_ns;
  if (!std::exchange(faults_.streams_at_start, false)) return;
  registers_[qsb::kInterval] = 1;
  streaming_ = true;
  next_tick_ = tick_at(now_ns);
}

void QsbDevice::reset(std::int64_t now_ns) {
  registers_ = {};
  registers_[qsb::kEor] = kFactoryEor;
  registers_[qsb::kInterval] = kNoOutput;
  registers_[qsb::kStatus] = qsb::kPowerWasLost;
  stamp_from_ns_ = now_ns;
  count_from_ = senses_(0, now_ns);
  streaming_ = false;
}

std::int64_t QsbDevice::tick_at(std::int64_t now_ns) const {
  return static_cast<std::int64_t>(static_cast<double>(now_ns - stamp_from_ns_) / faults_.tick_ns);
}

std::uint32_t QsbDevice::count_at(std::int64_t t_ns) const {
  return static_cast<std::uint32_t>(std::llround(senses_(0, t_ns) - count_from_));
}

std::uint32_t QsbDevice::read(std::uint8_t reg, std::int64_t now_ns) const {
  if (reg == qsb::kVersion) return kVersionOfTests;
  if (reg == qsb::kCount) return count_at(now_ns);
  if (reg == qsb::kStamp) return static_cast<std::uint32_t>(tick_at(now_ns));
  return registers_[reg];
}

void QsbDevice::write(std::uint8_t reg, std::uint32_t data, std::int64_t now_ns) {
  if (reg == qsb::kCommand && data == 1) streaming_ = false;
  if (reg == qsb::kStamp && data == 1) stamp_from_ns_ = now_ns;
  registers_[reg] = data;
}

QsbReply QsbDevice::answer(char type, std::uint8_t reg, std::uint32_t data, std::int64_t now_ns) {
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

std::string QsbDevice::execute(std::string_view command, std::int64_t now_ns) {
  if (command.size() < 3 || command.size() > 11 || faults_.mute) return "";
  const char type = command[0];
  const auto reg = static_cast<std::uint8_t>(hex(command.substr(1, 2)));
  if (type != 'R' && type != 'W' && type != 'S')
    return qsb_line({'x', reg, 0, std::nullopt}, registers_[qsb::kEor]);
  const QsbReply reply = answer(type, reg, hex(command.substr(3)), now_ns);
  return qsb_line(reply, registers_[qsb::kEor]);
}

std::string QsbDevice::exchange(std::size_t, int, std::string_view received, std::int64_t now_ns) {
  std::string out = stream(now_ns);
  received_ += received;
  for (std::size_t end; (end = received_.find_first_of("\r\n")) != std::string::npos;) {
    out += execute(received_.substr(0, end), now_ns);
    received_.erase(0, end + 1);
  }
  return out;
}

std::string QsbDevice::stream(std::int64_t now_ns) {
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

std::string QsbDevice::stream_line(std::int64_t tick) {
  if (faults_.rubbish) return "s 0E ?\xff\x01 !\r\n";
  const std::int64_t t_ns =
      stamp_from_ns_ + std::llround(static_cast<double>(tick) * faults_.tick_ns);
  const std::uint32_t jump =
      faults_.jump_at >= 0 && line_ > faults_.jump_at ? faults_.jump_ticks : 0;
  const auto stamp = static_cast<std::uint32_t>(tick) + jump;
  const std::string line =
      qsb_line({'s', qsb::kCount, count_at(t_ns), stamp}, registers_[qsb::kEor]);
  return line_ - 1 == faults_.cut_at ? line.substr(0, line.size() / 2) : line;
}

}  // namespace mdof::drivers
