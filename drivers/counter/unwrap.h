// Extends the range of counters that overflow.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// Extends a counter of `bits` bits (1 ... 63) over its overflows. Between two readings the counter
// must move by less than half of its range, in either direction. The first reading is returned
// unchanged; if `is_signed`, it is read as a two's complement number.
class Unwrap {
 public:
  explicit Unwrap(int bits, bool is_signed = false) : bits_(bits), is_signed_(is_signed) {}

  std::int64_t operator()(std::uint64_t raw) {
    const std::uint64_t range = std::uint64_t{1} << bits_;
    raw &= range - 1;
    if (!begun_) {
      begun_ = true;
      const bool negative = is_signed_ && raw >= range / 2;
      last_ = static_cast<std::int64_t>(raw) - (negative ? static_cast<std::int64_t>(range) : 0);
      return last_;
    }
    const std::uint64_t moved = (raw - static_cast<std::uint64_t>(last_)) & (range - 1);
    last_ += static_cast<std::int64_t>(moved);
    if (moved >= range / 2) last_ -= static_cast<std::int64_t>(range);
    return last_;
  }
  void reset() { begun_ = false; }

 private:
  int bits_;
  bool is_signed_;
  bool begun_ = false;
  std::int64_t last_ = 0;
};

}  // namespace mdof::drivers
