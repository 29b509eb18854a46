// Numbers without a pattern; they are the same in every build. A wrong index or sign in the code
// under test changes the results that a test calculates from them.
#pragma once

#include <cstdint>

#include "schema/base/random.h"

namespace mdof::test {

class NoPattern {
 public:
  explicit NoPattern(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) {
    const Philox words = philox({count_++, 0, 0, 0}, seed_);
    return low + (high - low) * uniform(words[0], words[1]);
  }

 private:
  std::uint64_t seed_;
  std::uint32_t count_ = 0;
};

}  // namespace mdof::test
