// Number of runs and seed of the coverage tests. The test suite uses few runs; environment
// variables set more runs for publishable figures.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace mdof::test {

// The number in MDOF_COVERAGE_RUNS, or `otherwise` if it is not set.
inline int coverage_runs(int otherwise) {
  const char* runs = std::getenv("MDOF_COVERAGE_RUNS");
  return runs ? std::atoi(runs) : otherwise;
}
// The number in MDOF_COVERAGE_SEED, or `otherwise` if it is not set.
inline std::uint64_t coverage_seed(std::uint64_t otherwise) {
  const char* seed = std::getenv("MDOF_COVERAGE_SEED");
  return seed ? std::strtoull(seed, nullptr, 10) : otherwise;
}

}  // namespace mdof::test
