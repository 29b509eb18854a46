// The bytes of a study's result must not depend on the number of threads or on interruptions.
#include "tools/mdof/study/running/runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <limits>
#include <stdexcept>

#include "schema/base/random.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/study/json.h"
#include "tools/mdof/study/running/divided_trials.h"
#include "tools/mdof/study/running/workers.h"

namespace mdof::tools {
namespace {

// An experiment with a normal and a skewed output. Some trials have no solution. After arm(), it
// requests an interrupt when it reaches the trial `interrupt_at`.
class Noise final : public algo::Experiment {
 public:
  explicit Noise(std::uint64_t interrupt_at = ~std::uint64_t{0}) : interrupt_at_(interrupt_at) {
    outputs_ = {"A_um", "B_um"};
    binned_ = {"travel_mm", 0, 8, 4};
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) {
      const std::uint64_t trial = first + j * step;
      const auto words = philox(
          {static_cast<std::uint32_t>(trial), static_cast<std::uint32_t>(trial >> 32), 0, 0}, 5);
      const double u = uniform(words[0], words[1]);
      out[0][j] = trial % 1000 == 7 ? std::numeric_limits<double>::quiet_NaN() : gaussian(u);
      out[1][j] = u * u * (1 + static_cast<double>(trial % 4));
      if (trial == interrupt_at_ && armed_.exchange(false)) std::raise(SIGINT);
    }
  }
  void arm() { armed_ = true; }

 private:
  std::uint64_t interrupt_at_;
  mutable std::atomic<bool> armed_ = false;
};

RunnerOptions fixed(std::uint64_t trials, unsigned threads) {
  RunnerOptions options;
  options.trials = trials;
  options.threads = threads;
  return options;
}

RunnerOptions adaptive(unsigned threads) {
  RunnerOptions options;
  options.adaptive.emplace();
  options.adaptive->absolute = {{"A_um", 0.02}, {"B_um", 0.02}};
  options.threads = threads;
  return options;
}

StudyWork work_of(const algo::Experiment& experiment, const RunnerOptions& options) {
  const std::uint64_t trials = options.trials.value_or(algo::kPilotTrials);
  return empty_work(experiment, algo::pilot_scale(experiment, trials));
}

// The bytes of a checkpoint with elapsed time 0.
std::string bytes_of(StudyWork& work) {
  work.elapsed_s = 0;
  return checkpoint_bytes(work);
}

std::string run_through(const algo::Experiment& experiment, const RunnerOptions& options) {
  Processes processes = Processes::join().value();
  StudyRunner runner = StudyRunner::create(experiment, options, processes).value();
  StudyWork work = work_of(experiment, options);
  EXPECT_EQ(runner.run(work), StudyState::complete);
  return bytes_of(work);
}

// Interrupts the study once, writes and reads its checkpoint, and continues the study with another
// number of threads.
std::string run_interrupted(Noise& experiment, RunnerOptions options,
                            std::optional<std::uint64_t> after = std::nullopt) {
  Processes processes = Processes::join().value();
  StudyRunner runner = StudyRunner::create(experiment, options, processes).value();
  StudyWork work = work_of(experiment, options);
  {
    const Interrupt interrupt;
    experiment.arm();
    EXPECT_EQ(runner.run(work), StudyState::interrupted);
  }
  EXPECT_TRUE(after ? work.trials == *after : work.trials > 0) << work.trials;
  auto back = parse_checkpoint(checkpoint_bytes(work), experiment);
  EXPECT_TRUE(back);
  options.threads = 3;
  const Interrupt none;
  StudyRunner again = StudyRunner::create(experiment, options, processes).value();
  EXPECT_EQ(again.run(*back), StudyState::complete);
  return bytes_of(*back);
}

constexpr std::uint64_t kTrials = 777777;

TEST(StudyRunner, GivesTheSameBytesForAnyNumberOfThreads) {
  const Noise noise;
  const std::string one = run_through(noise, fixed(kTrials, 1));
  EXPECT_EQ(one, run_through(noise, fixed(kTrials, 2)));
  EXPECT_EQ(one, run_through(noise, fixed(kTrials, 5)));
}

// If trials are slow, blocks are shorter. An interrupt discards the current block.
TEST(StudyRunner, SlowTrialsAreInterruptedWithinABlock) {
  constexpr std::uint64_t kBlock = 4 * 512;  // 512 trials for each of four bins
  Noise noise(3 * kBlock + 10);
  RunnerOptions slow = fixed(20000, 3);
  slow.slow = true;
  const std::string whole = run_through(noise, slow);
  slow.threads = 1;
  EXPECT_EQ(run_through(noise, slow), whole);
  EXPECT_EQ(run_interrupted(noise, slow, 3 * kBlock), whole);
}

TEST(StudyRunner, AStudyInterruptedBeforeItsFirstBlockIsContinued) {
  Noise noise(10);
  RunnerOptions slow = fixed(20000, 2);
  slow.slow = true;
  const std::string whole = run_through(noise, slow);
  EXPECT_EQ(run_interrupted(noise, slow, 0), whole);
}

TEST(StudyRunner, AContinuedStudyGivesTheSameBytes) {
  Noise noise(400000);
  EXPECT_EQ(run_interrupted(noise, fixed(kTrials, 2)), run_through(noise, fixed(kTrials, 1)));
}

TEST(StudyRunner, AContinuedAdaptiveStudyGivesTheSameBytes) {
  Noise noise(60000);
  const std::string whole = run_through(noise, adaptive(1));
  // Blocks that other threads calculate beyond the end of the study have no effect.
  EXPECT_EQ(whole, run_through(noise, adaptive(4)));
  EXPECT_EQ(whole, run_interrupted(noise, adaptive(2)));
}

TEST(StudyRunner, TheAdaptiveRuleEndsAtItsLimit) {
  const Noise noise;
  RunnerOptions options = adaptive(2);
  options.adaptive->absolute = {{"A_um", 1e-9}, {"B_um", 1e-9}};
  options.trials = 100000;
  Processes processes = Processes::join().value();
  StudyRunner runner = StudyRunner::create(noise, options, processes).value();
  StudyWork work = work_of(noise, options);
  EXPECT_EQ(runner.run(work), StudyState::complete);
  EXPECT_NE(runner.not_settled().find("within the permitted number of trials"), std::string::npos);
  EXPECT_GE(work.trials, 100000u);
  EXPECT_LT(work.trials, 100000u + algo::block_trials(noise));
}

// An experiment whose second output never has a solution.
class HalfSolved final : public algo::Experiment {
 public:
  HalfSolved() {
    outputs_ = noise_.outputs();
    binned_ = noise_.binned();
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    noise_.run(first, step, n, out);
    std::fill_n(out[1], n, std::numeric_limits<double>::quiet_NaN());
  }

 private:
  Noise noise_;
};

TEST(StudyRunner, TheAdaptiveRuleEndsIfAnOutputIsNeverSolved) {
  const HalfSolved half;
  Processes processes = Processes::join().value();
  StudyRunner runner = StudyRunner::create(half, adaptive(2), processes).value();
  StudyWork work = work_of(half, adaptive(2));
  EXPECT_EQ(runner.run(work), StudyState::complete);
  EXPECT_NE(runner.not_settled().find("fewer than two values of B_um"), std::string::npos)
      << runner.not_settled();
  EXPECT_EQ(work.trials, algo::adaptive_block_trials(half, 0.95).value());
}

TEST(StudyRunner, ADamagedCheckpointIsAnError) {
  const Noise noise;
  const std::string bytes = run_through(noise, fixed(30000, 1));
  ASSERT_TRUE(parse_checkpoint(bytes, noise));
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 64)
    EXPECT_FALSE(parse_checkpoint(bytes.substr(0, length), noise)) << length;
  for (std::size_t at = 0; at < std::min<std::size_t>(bytes.size(), 600); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    // Any result is permitted; sanitizers detect the errors.
    (void)parse_checkpoint(damaged, noise);
  }
  EXPECT_TRUE(parse_checkpoint(bytes, Noise(7)));  // this experiment has the same outputs and bins
}

TEST(StudyWorkers, FinishExactlyTheFirstPieces) {
  std::atomic<bool> go_on = true;
  std::atomic<int> done = 0;
  const std::size_t reported = in_parallel(
      3, 1'000'000'000,
      [&](unsigned worker, std::size_t) {
        EXPECT_LT(worker, 3u);
        if (++done > 1000) go_on = false;
      },
      [&] { return go_on.load(); });
  EXPECT_EQ(reported, static_cast<std::size_t>(done));
  EXPECT_EQ(in_parallel(
                2, 0, [](unsigned, std::size_t) {}, [] { return true; }),
            0u);
}

TEST(StudyWorkers, RethrowAnExceptionOfTheWork) {
  const auto work = [](unsigned, std::size_t i) {
    if (i == 5) throw std::runtime_error("out of memory");
  };
  EXPECT_THROW(in_parallel(2, 100, work, [] { return true; }), std::runtime_error);
}

TEST(StudyJson, ReadsBackToTheSameText) {
  StudyResult result;
  result.name = "a \"study\"";
  result.trials = 12;
  result.seed = 3;
  result.trials_wanted = 12;
  OutputSummary s;
  s.key = "EYX_um";
  s.n = 11;
  s.unsolved = 1;
  s.mean = 0.1;
  s.mean_se = NAN;
  s.sd = 2;
  s.quantiles = {{0.025, -1}, {0.975, 1.5}};
  s.histogram = {-1, 0.5, {1, 2, 3}, 4, 5};
  s.symmetric = {-1, 1.5};
  result.outputs = {s};
  result.binned_key = "travel_mm";
  s.histogram = {};
  result.bins = {{0, 5, {s}}, {5, 10, {s}}};
  result.convergence = {{"EYX_um", {{12, 0.1, 2, -1, 1.5}}}};
  result.indices = {{"EYX_um", {{"probe.A.x_um", 0.5, 0.01, 0.6, NAN}}}};
  result.allocations = {{"EYX_um", 2, 0.95, 0.9, {{"probe.A.x_um", 3, 2, 4}}, 1.1, {}}};
  result.allocations[0].frontier = {{{"a_um", 1, NAN, NAN}, {"b_um", 2, NAN, NAN}}};
  result.comparison = {{"EYX_um", 1, 2, 2, 0.1}};
  result.warnings = {"one"};
  const std::string json = study_figures_json(result);
  StudyResult back;
  ASSERT_TRUE(read_study_figures(json, "test", back));
  EXPECT_EQ(study_figures_json(back), json);
  EXPECT_FALSE(read_study_figures("{", "test", back));
}

}  // namespace
}  // namespace mdof::tools
