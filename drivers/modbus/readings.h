// From registers to readings: which blocks a poll reads, and what they mean. Pure.
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

// The fewest reads for these registers (each with how many), in the order of their addresses; up to
// `join_gap` registers in between are read along.
struct Span {
  Register from;
  int count = 1;
};
std::vector<Block> plan_reads(std::vector<Span> wanted, int join_gap);

struct Reading {
  double value = kNaN;
  Quality quality = Quality::missing;
};

// The values of a profile that are in use, with the status bits that concern them. Keeps the count
// of wrapping counters, also while the device is away: it moves by less than half a ring meanwhile.
// Thread-bound.
class Readings {
 public:
  struct Use {
    Value value;              // of the profile
    double um_per_count = 0;  // of a count; else not used
  };
  Readings(const Profile& profile, const std::vector<Use>& uses);

  const std::vector<Block>& blocks() const { return blocks_; }
  // To be filled by a read of blocks()[i].
  std::span<std::uint16_t> registers(std::size_t block) { return registers_[block]; }
  // Of each use, from the registers as they are; once a poll.
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

// The registers that hold `raw`, which fits the type, in the order of the wire.
std::vector<std::uint16_t> encode(const Value& value, double raw);

}  // namespace mdof::drivers::modbus
