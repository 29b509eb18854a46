// Counts of a Linux counter device (Documentation/ABI/testing/sysfs-bus-counter of the kernel).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers {

// A count from 0 to `ceiling` that wraps, and moves by less than half of that between two readings.
// The first one stands for itself, as a signed number: just below the wrap is just below 0. Pure.
class CountUnwrap {
 public:
  // At least 1; 2^64 - 1 is as good as any.
  explicit CountUnwrap(std::uint64_t ceiling) : ceiling_(ceiling) {}
  // Nothing: beyond the ceiling, which no true count is.
  std::optional<std::int64_t> operator()(std::uint64_t raw);

 private:
  std::uint64_t ceiling_;
  std::uint64_t last_raw_ = 0;
  std::int64_t total_ = 0;
};

// The error that a file of the device has to be set up.
tl::unexpected<Error> to_be_written(const std::string& file, const std::string& why,
                                    const std::string& value);

// What the files beside `count` say; absent ones are nothing.
struct CountFiles {
  std::optional<std::string> function, count_mode, enable, ceiling, floor;
};
// The ceiling of a count that is fit for a position. Errors say what to write to which file: it is
// paused, it stops at its limits, `function` is not as wanted (empty: any), its ceiling is not
// known. `ceiling`: from the configuration, 0: not given. `path`: of the count's folder.
Result<std::uint64_t> check_count(const CountFiles& files, const std::string& path,
                                  const std::string& function, std::uint64_t ceiling);

}  // namespace mdof::drivers
