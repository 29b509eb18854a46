#include "drivers/modbus/readings.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <tuple>

namespace mdof::drivers::modbus {
namespace {

double number_of(Type type, std::uint32_t bits) {
  switch (type) {
    case Type::u16:
    case Type::u32:
      return bits;
    case Type::i16:
      return static_cast<std::int16_t>(bits);
    case Type::i32:
      return static_cast<std::int32_t>(bits);
    case Type::f32:
      return static_cast<double>(std::bit_cast<float>(bits));
  }
  return kNaN;
}

bool concerns(const StatusBits& status, const Value& value) {
  const auto& names = status.values;
  return names.empty() || std::find(names.begin(), names.end(), value.name) != names.end();
}

bool is_signed(Type type) {
  return type == Type::i16 || type == Type::i32;
}

}  // namespace

std::vector<Block> plan_reads(std::vector<Span> wanted, int join_gap) {
  std::sort(wanted.begin(), wanted.end(), [](const Span& a, const Span& b) {
    return std::tie(a.from.function, a.from.address) < std::tie(b.from.function, b.from.address);
  });
  std::vector<Block> blocks;
  for (const Span& span : wanted) {
    const int end = span.from.address + span.count;
    if (!blocks.empty()) {
      Block& last = blocks.back();
      const bool near = span.from.address <= last.from.address + last.count + join_gap;
      const int joined = std::max(last.count, end - last.from.address);
      if (last.from.function == span.from.function && near && joined <= kMostRegisters) {
        last.count = joined;
        continue;
      }
    }
    blocks.push_back({span.from, span.count});
  }
  return blocks;
}

Readings::Readings(const Profile& profile, const std::vector<Use>& uses) {
  std::vector<Span> wanted;
  for (const auto& [value, um_per_count] : uses) {
    const bool counts = value.unit == Unit::other;
    const int ring = value.ring_bits > 0 ? value.ring_bits : 1;
    Counter counter{value, counts ? um_per_count : 1, Unwrap(ring, is_signed(value.type)), {}};
    for (const StatusBits& status : profile.statuses) {
      if (!concerns(status, value)) continue;
      counter.statuses.push_back(status);
      wanted.push_back({status.at, 1});
    }
    wanted.push_back({value.at, registers_of(value.type)});
    counters_.push_back(std::move(counter));
  }
  blocks_ = plan_reads(std::move(wanted), profile.join_gap);
  for (const Block& block : blocks_) registers_.emplace_back(block.count);
  readings_.resize(counters_.size());
}

const std::vector<Reading>& Readings::read() {
  for (std::size_t i = 0; i < counters_.size(); ++i) readings_[i] = read(counters_[i]);
  return readings_;
}

// If the reading is missing, the counter is not updated.
Reading Readings::read(Counter& counter) {
  const Value& value = counter.value;
  Reading reading{kNaN, Quality::good};
  for (const StatusBits& status : counter.statuses)
    if ((at(status.at) & status.mask) != 0)
      reading.quality = std::max(reading.quality, status.makes);
  double raw = number_of(value.type, bits(value));
  const auto& ends = value.over_range;
  if (std::find(ends.begin(), ends.end(), raw) != ends.end())
    reading.quality = std::max(reading.quality, Quality::over_range);
  if (!std::isfinite(raw)) reading.quality = Quality::missing;
  if (reading.quality == Quality::missing) return reading;
  if (value.ring_bits > 0) raw = static_cast<double>(counter.unwrap(bits(value)));
  reading.value = (raw * value.scale + value.offset) * counter.factor;
  return reading;
}

std::uint16_t Readings::at(const Register& reg, int offset) const {
  const int address = reg.address + offset;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const auto& [from, count] = blocks_[i];
    if (from.function == reg.function && address >= from.address && address < from.address + count)
      return registers_[i][static_cast<std::size_t>(address - from.address)];
  }
  assert(false && "this register is in the read plan");
  return 0;
}

std::uint32_t Readings::bits(const Value& value) const {
  if (registers_of(value.type) == 1) return at(value.at);
  const std::uint32_t first = at(value.at), second = at(value.at, 1);
  return value.low_word_first ? second << 16 | first : first << 16 | second;
}

std::vector<std::uint16_t> encode(const Value& value, double raw) {
  const std::uint32_t bits = value.type == Type::f32
                                 ? std::bit_cast<std::uint32_t>(static_cast<float>(raw))
                                 : static_cast<std::uint32_t>(static_cast<std::int64_t>(raw));
  const auto high = static_cast<std::uint16_t>(bits >> 16), low = static_cast<std::uint16_t>(bits);
  if (registers_of(value.type) == 1) return {low};
  if (value.low_word_first) return {low, high};
  return {high, low};
}

}  // namespace mdof::drivers::modbus
