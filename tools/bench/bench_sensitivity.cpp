// Measures Simulation I on one thread: only the random numbers, only the trials, and the trials
// with all statistics. Prints the processor time for each trial in ns, the shortest of several
// rounds. tools/bench/run compares these times with NumPy and Octave.
//   bench_sensitivity [TRIALS] [baseline|avx2|avx512]
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "algo/sensitivity/simulation.h"
#include "algo/sensitivity/statistics/statistics.h"

namespace {

using mdof::InstructionSet;
constexpr int kRounds = 25;
constexpr std::size_t kBatch = 512;

// The shortest processor time for each trial of several rounds, ns.
template <class Work>
double best_ns(std::uint64_t trials, Work work) {
  double best = 1e300;
  for (int i = 0; i < kRounds; ++i) {
    const std::clock_t begin = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - begin));
  }
  return best / CLOCKS_PER_SEC / static_cast<double>(trials) * 1e9;
}

void print(const char* what, double ns) {
  std::printf("%-34s %7.3f ns a trial, %7.1f million a second\n", what, ns, 1e3 / ns);
}

// Draws `pairs` Philox blocks for each trial. Returns a sum of the numbers, so that the compiler
// cannot remove the calculation.
double draw_all(std::uint64_t trials, std::uint64_t pairs, InstructionSet set) {
  static std::array<double, kBatch> even, odd;
  double sum = 0;
  for (std::uint64_t at = 0; at < trials; at += kBatch) {
    for (std::uint64_t group = 0; group < pairs; ++group) {
      mdof::algo::draw_pairs({1, 0}, group, at, 1, even, odd, set);
      sum += even[0] + odd[0];
    }
  }
  return sum;
}

void bench(const char* name, const mdof::algo::SimulationOptions& options, std::uint64_t pairs,
           std::uint64_t trials, InstructionSet set) {
  const auto experiment = mdof::algo::make_simulation(options, set).value();
  std::printf("%s, %s, %.0f trials\n", name, mdof::to_string(set), static_cast<double>(trials));
  double sum = 0;
  print("  random numbers alone", best_ns(trials, [&] { sum += draw_all(trials, pairs, set); }));
  static std::array<std::array<double, kBatch>, 5> columns;
  std::array<double*, 5> out{};
  for (std::size_t k = 0; k < 5; ++k) out[k] = columns[k].data();
  print("  trials without statistics", best_ns(trials, [&] {
          for (std::uint64_t at = 0; at + kBatch <= trials; at += kBatch) {
            experiment->run(at, options.travel_bins, kBatch, out);
            sum += columns[0][0];
          }
        }));
  const mdof::algo::StudyScale scale = mdof::algo::pilot_scale(*experiment);
  mdof::algo::StudyStatistics statistics(*experiment, scale, set);
  const std::uint64_t at_once = mdof::algo::block_trials(*experiment) * mdof::algo::kBlocksAtOnce;
  const double all_ns = best_ns(trials, [&] {
    for (std::uint64_t at = 0; at < trials; at += at_once) {
      statistics.add_block(*experiment, at, std::min(at_once, trials - at));
    }
  });
  print("  with all statistics", all_ns);
  const double figures_ms = best_ns(
      1'000'000, [&] { sum += statistics.overall()[0].sd + statistics.bins()[0].outputs[0].sd; });
  std::printf("  figures of the whole travel and of each bin: %.1f ms, once in a study\n",
              figures_ms);
  const std::size_t memory = statistics.memory_bytes();
  std::printf("  memory of the statistics: %.1f MB (checksum %g)\n",
              static_cast<double>(memory) / 1e6, sum);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t trials = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 4'000'000;
  InstructionSet set = mdof::best_instruction_set();
  for (const InstructionSet one : mdof::available_instruction_sets()) {
    if (argc > 2 && std::strcmp(argv[2], mdof::to_string(one)) == 0) set = one;
  }
  bench("simulation I", mdof::algo::simulation_1_defaults(), 3, trials, set);
  bench("simulation II", mdof::algo::simulation_2_defaults(), 6, trials, set);
  return 0;
}
