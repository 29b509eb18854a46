// Counts of a Linux counter device (Documentation/ABI/testing/sysfs-bus-counter of the kernel).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers {

// Unwraps a count from 0 to `ceiling` that moves by less than half of this range between two
// readings. The first reading is taken as a signed number: just below the ceiling means just below
// 0. Pure.
class CountUnwrap {
 public:
  // `ceiling` is at least 1; 2^64 - 1 is allowed.
  explicit CountUnwrap(std::uint64_t ceiling) : ceiling_(ceiling) {}
  // nullopt: `raw` is above the ceiling, so it is not a count.
  std::optional<std::int64_t> operator()(std::uint64_t raw);

 private:
  std::uint64_t ceiling_;
  std::uint64_t last_raw_ = 0;
  std::int64_t total_ = 0;
};

// Error: a file of the device must be set to `value`.
tl::unexpected<Error> needs_setting(const std::string& file, const std::string& why,
                                    const std::string& value);

// Contents of the files beside `count`; nullopt: the file does not exist.
struct CountFiles {
  std::optional<std::string> function, count_mode, enable, ceiling, floor;
};
// Returns the ceiling of a count that can give positions. Errors state which file needs which text:
// the count is paused, it stops at its limits, `function` is not the required one (empty: any), its
// ceiling is unknown. `ceiling`: from the configuration; 0: not given. `path`: folder of the count.
Result<std::uint64_t> check_count(const CountFiles& files, const std::string& path,
                                  const std::string& function, std::uint64_t ceiling);

}  // namespace mdof::drivers
