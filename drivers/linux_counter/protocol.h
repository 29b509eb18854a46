// Rules for the counts of a Linux counter device (Documentation/ABI/testing/sysfs-bus-counter of
// the kernel).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers {

// Extends a count from 0 to `ceiling` over its overflows. Between two readings the count must move
// by less than half of this range. The first reading is read as a signed number: a count just below
// the ceiling is a position just below 0. Pure.
class CountUnwrap {
 public:
  // `ceiling`: at least 1; 2^64 - 1 is allowed.
  explicit CountUnwrap(std::uint64_t ceiling) : ceiling_(ceiling) {}
  // nullopt: `raw` is larger than the ceiling, so it cannot be a count.
  std::optional<std::int64_t> operator()(std::uint64_t raw);

 private:
  std::uint64_t ceiling_;
  std::uint64_t last_raw_ = 0;
  std::int64_t total_ = 0;
};

// Returns the error that a file of the device must contain `value`.
tl::unexpected<Error> needs_setting(const std::string& file, const std::string& why,
                                    const std::string& value);

// Contents of the files in the folder of the count; nullopt: the file does not exist.
struct CountFiles {
  std::optional<std::string> function, count_mode, enable, ceiling, floor;
};
// Checks that a count can be used for positions, and returns its ceiling. `function`: required
// function (empty: any). `ceiling`: from the configuration; 0: not given. `path`: folder of the
// count. Errors state which text must be in which file: the count is paused; it stops at its
// limits; it has another function; its ceiling is unknown.
Result<std::uint64_t> check_count(const CountFiles& files, const std::string& path,
                                  const std::string& function, std::uint64_t ceiling);

}  // namespace mdof::drivers
