// How long the tests of coverage draw: briefly in the suite, for figures worth quoting as asked
// for.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace mdof::test {

// MDOF_COVERAGE_RUNS, else `otherwise`.
inline int coverage_runs(int otherwise) {
  const char* runs = std::getenv("MDOF_COVERAGE_RUNS");
  return runs ? std::atoi(runs) : otherwise;
}
// MDOF_COVERAGE_SEED, else `otherwise`.
inline std::uint64_t coverage_seed(std::uint64_t otherwise) {
  const char* seed = std::getenv("MDOF_COVERAGE_SEED");
  return seed ? std::strtoull(seed, nullptr, 10) : otherwise;
}

}  // namespace mdof::test
