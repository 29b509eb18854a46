// Measures the time for the three reference lines of a long unsorted series, and for the minimum
// zone of a sorted series. Limit: 20 ms for the minimum zone of 100,000 readings.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "algo/iso230/minimum_zone.h"
#include "algo/iso230/reference_lines.h"
#include "schema/base/random.h"

namespace {

constexpr std::uint32_t kReadings = 100'000;
constexpr int kRounds = 9;

double any(std::uint32_t i, std::uint32_t purpose) {
  const mdof::Philox random = mdof::philox({i, 0, 0, purpose}, 230);
  return mdof::uniform(random[0], random[1]);
}

// The shortest time of several rounds, ms.
template <class Work>
double best_ms(Work work) {
  double best = 1e9;
  for (int i = 0; i < kRounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count());
  }
  return best;
}

}  // namespace

int main() {
  std::vector<double> x, y;
  for (std::uint32_t i = 0; i < kReadings; ++i) {
    x.push_back(any(i, 1));
    y.push_back(1e-6 * any(i, 2));
  }
  const double all_ms = best_ms([&] { mdof::algo::reference_lines(x, y).value(); });
  std::sort(x.begin(), x.end());
  const double zone_ms = best_ms([&] { mdof::algo::minimum_zone_line(x, y); });
  for (std::uint32_t i = 0; i < kReadings;
       ++i)  // a convex series: every reading is on the convex hull
    y[i] = 1e-6 * x[i] * (1 - x[i]);
  const double arch_ms = best_ms([&] { mdof::algo::minimum_zone_line(x, y); });
  std::printf(
      "iso230   %u readings: minimum-zone line in %.2f ms, for readings on an arch in %.2f ms "
      "(limit 20 ms); all three reference lines, with sorting, in %.2f ms\n",
      kReadings, zone_ms, arch_ms, all_ms);
  return zone_ms < 20 && arch_ms < 20 ? 0 : 1;
}
