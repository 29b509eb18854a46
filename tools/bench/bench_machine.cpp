// Measures the Monte Carlo budget of the co-planar machine on one thread: processor time for each
// trial in ns. All 84 part errors vary, and each trial calculates the complete product of the 14
// frames. tools/bench/peers/machine_numpy.py calculates the same with NumPy.
//   bench_machine [TRIALS] [baseline|avx2|avx512]
//   bench_machine --frames   prints the nominal machine for the peer, one row for each frame from
//                            the tool to the work: side, nominal rotation and translation, point
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include "algo/machine/budget/trials.h"
#include "algo/sensitivity/statistics/statistics.h"

namespace {

using mdof::InstructionSet;
constexpr int kRounds = 5;
const mdof::algo::Command kAt = {0.03, 0.02, 0.02, 0, 0.1, 0};

// The machine with errors of the half widths 1 µm and 50 µrad (Eq. 9 of the paper).
mdof::Machine machine() {
  auto machine = mdof::parse_machine(mdof::co_planar_machine(), "co-planar").value();
  machine.sources.clear();
  for (std::size_t i = 0; i < machine.frames.size(); ++i)
    for (std::size_t k = 0; k < mdof::kBodyErrors; ++k)
      machine.sources.push_back({mdof::error_name(machine.frames[i], k),
                                 k < 3 ? "um" : "urad",
                                 k < 3 ? 0.57735026918962576 : 28.867513459481288,
                                 mdof::SourceShape::rectangular,
                                 {{i, k, false, 1e-6, 0, 0}}});
  return machine;
}

void print_frames(const mdof::Machine& machine) {
  for (std::size_t i = machine.frames.size(); i-- > 0;) {
    const auto& frame = machine.frames[i];
    const double travel = mdof::algo::travel_of(frame, kAt);
    const auto pose = mdof::algo::nominal_pose(frame, travel);
    const auto point = mdof::algo::holding_point(frame, travel);
    std::printf("%d", frame.carries_work ? 1 : 0);
    for (Eigen::Index k = 0; k < 9; ++k) std::printf(" %.17g", pose.R(k / 3, k % 3));
    for (Eigen::Index k = 0; k < 3; ++k) std::printf(" %.17g", pose.p[k]);
    for (Eigen::Index k = 0; k < 3; ++k) std::printf(" %.17g", point[k]);
    std::printf("\n");
  }
}

void bench(std::uint64_t trials, InstructionSet set) {
  const auto model = mdof::algo::budget_model(machine(), kAt, mdof::algo::MachineApproach::mean,
                                              mdof::algo::BudgetStage::designed)
                         .value();
  const auto experiment = mdof::algo::budget_trials(model, 1, set);
  double best = 1e300;
  mdof::algo::SummaryRequest request{0.95, {0.5, 0.95}};
  for (int round = 0; round < kRounds; ++round) {
    const std::clock_t begin = std::clock();
    mdof::algo::StudyStatistics statistics(*experiment, mdof::algo::pilot_scale(*experiment), set);
    statistics.add_block(*experiment, 0, trials);
    const auto figures = statistics.overall(request);
    best = std::min(best, static_cast<double>(std::clock() - begin));
    if (round + 1 < kRounds) continue;
    std::printf(
        "machine budget, %s: %.1f ns a trial; standard deviations of x, y and z %.4f %.4f %.4f µm, "
        "95 %% of the errors in the volume are below %.4f µm\n",
        mdof::to_string(set), best / CLOCKS_PER_SEC / static_cast<double>(trials) * 1e9,
        figures[0].sd, figures[1].sd, figures[2].sd, figures[3].quantiles[1].value);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "--frames") == 0) {
    print_frames(machine());
    return 0;
  }
  const std::uint64_t trials = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  InstructionSet set = mdof::best_instruction_set();
  for (const InstructionSet one : mdof::available_instruction_sets())
    if (argc > 2 && std::strcmp(argv[2], mdof::to_string(one)) == 0) set = one;
  bench(trials, set);
  return 0;
}
