// Number of runs and seed of the coverage tests: few runs in the test suite; the environment can
// request more for publishable figures.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace mdof::test {

// MDOF_COVERAGE_RUNS if set, otherwise `otherwise`.
inline int coverage_runs(int otherwise) {
  const char* runs = std::getenv("MDOF_COVERAGE_RUNS");
  return runs ? std::atoi(runs) : otherwise;
}
// MDOF_COVERAGE_SEED if set, otherwise `otherwise`.
inline std::uint64_t coverage_seed(std::uint64_t otherwise) {
  const char* seed = std::getenv("MDOF_COVERAGE_SEED");
  return seed ? std::strtoull(seed, nullptr, 10) : otherwise;
}

}  // namespace mdof::test
