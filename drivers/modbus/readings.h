// Plans the register reads of a poll and converts registers to readings. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/counter/unwrap.h"
#include "drivers/modbus/profile.h"
#include "schema/sample.h"

namespace mdof::drivers::modbus {

// One read: at most 125 registers.
struct Block {
  Register from;
  int count = 0;
  bool operator==(const Block&) const = default;
};

// The fewest reads that cover these registers, in the order of addresses. Up to `join_gap` unused
// registers between two of them are read too. Span::count: number of registers.
struct Span {
  Register from;
  int count = 1;
};
std::vector<Block> plan_reads(std::vector<Span> wanted, int join_gap);

struct Reading {
  double value = kNaN;
  Quality quality = Quality::missing;
};

// The values of a profile that are used, with the status bits that apply to them. Unwraps counters,
// also while the device is away, if they move by less than half a ring meanwhile. Thread-bound.
class Readings {
 public:
  struct Use {
    Value value;              // of the profile
    double um_per_count = 0;  // length of a count; unused for other units
  };
  Readings(const Profile& profile, const std::vector<Use>& uses);

  const std::vector<Block>& blocks() const { return blocks_; }
  // The caller fills it with a read of blocks()[i].
  std::span<std::uint16_t> registers(std::size_t block) { return registers_[block]; }
  // Readings of each use from the present registers. Call it once for each poll.
  const std::vector<Reading>& read();

 private:
  struct Counter {
    Value value;
    double factor;  // to the unit of the channel
    Unwrap unwrap;
    std::vector<StatusBits> statuses;
  };
  Reading read(Counter& counter);
  std::uint16_t at(const Register& reg, int offset = 0) const;
  std::uint32_t bits(const Value& value) const;

  std::vector<Counter> counters_;
  std::vector<Block> blocks_;
  std::vector<std::vector<std::uint16_t>> registers_;
  std::vector<Reading> readings_;
};

// The registers that hold `raw` (it must fit the type), in the order on the wire.
std::vector<std::uint16_t> encode(const Value& value, double raw);

}  // namespace mdof::drivers::modbus
