// Plans which registers a poll reads, and converts the registers to readings. Pure.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/counter/unwrap.h"
#include "drivers/modbus/profile.h"
#include "schema/sample.h"

namespace mdof::drivers::modbus {

// One read request, for at most 125 registers.
struct Block {
  Register from;
  int count = 0;
  bool operator==(const Block&) const = default;
};

// Plans the smallest number of read requests for these registers, sorted by address. A request may
// include up to `join_gap` unused registers between two used registers. Span::count: number of
// registers.
struct Span {
  Register from;
  int count = 1;
};
std::vector<Block> plan_reads(std::vector<Span> wanted, int join_gap);

struct Reading {
  double value = kNaN;
  Quality quality = Quality::missing;
};

// The values of a profile that the channels use, with the status bits that affect them. Extends
// counters over their overflows. This also works after a pause in the connection if a counter has
// moved by less than half of its range. Thread-bound.
class Readings {
 public:
  struct Use {
    Value value;              // the value in the profile
    double um_per_count = 0;  // length of one count; not used for values in other units
  };
  Readings(const Profile& profile, const std::vector<Use>& uses);

  const std::vector<Block>& blocks() const { return blocks_; }
  // Memory for the registers of blocks()[block]. The caller must fill it before read().
  std::span<std::uint16_t> registers(std::size_t block) { return registers_[block]; }
  // Converts the present registers to one reading for each Use. Call it once for each poll.
  const std::vector<Reading>& read();

 private:
  struct Counter {
    Value value;
    double factor;  // factor to the unit of the channel
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

// Converts `raw` to the contents of the registers of `value`, in the order of transmission. `raw`
// must be in the range of the type.
std::vector<std::uint16_t> encode(const Value& value, double raw);

}  // namespace mdof::drivers::modbus
