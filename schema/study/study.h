// Result of a sensitivity study. It is printed, stored and plotted. The key of an output ends in
// its unit ("EAX_urad", "EYX_um"); the values are in this unit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mdof {

struct CoverageInterval {
  double low = 0, high = 0;
};

struct Quantile {
  double p = 0, value = 0;
};

// A histogram for plots. counts[i] is the number of trials with a value in [from + i width, from +
// (i+1) width).
struct Histogram {
  double from = 0, width = 0;
  std::vector<std::uint64_t> counts;
  std::uint64_t below = 0, above = 0;
};

// Statistics of one output over n trials; mean_se, sd_se: standard errors of mean and sd.
struct OutputSummary {
  std::string key;
  std::uint64_t n = 0;         // number of trials with a solution
  std::uint64_t unsolved = 0;  // number of trials without a solution; no other figure includes them
  double mean = 0, mean_se = 0, sd = 0, sd_se = 0, min = 0, max = 0;
  std::vector<Quantile> quantiles;  // ascending p
  double coverage = 0.95;
  CoverageInterval symmetric;  // probabilistically symmetric, JCGM 101 §7.7
  CoverageInterval shortest;   // JCGM 101 §5.3.4
  // Largest distance between a quantile (or an end of an interval) here and the exact value that
  // sorting of all trials would produce.
  double resolution = 0;
  Histogram histogram;
};

// One bin of the binned quantity.
struct StudyBin {
  double from = 0, to = 0;  // unit of StudyResult::binned_key
  std::vector<OutputSummary> outputs;

  // The reason why a mean or a standard deviation of this bin is unknown; empty: all are known.
  const char* reason() const {
    for (const OutputSummary& output : outputs)
      if (output.n < 2) return "fewer than two trials in this bin have a solution";
    return "";
  }
};

// Statistics of one output after a number of trials; they show how the statistics converge.
struct ConvergencePoint {
  std::uint64_t trials = 0;
  double mean = 0, sd = 0, low = 0, high = 0;  // low, high: ends of the symmetric interval
};
struct Convergence {
  std::string key;
  std::vector<ConvergencePoint> points;
};

// Variance-based indices (Sobol) of one output. se: standard error of the index.
struct CauseIndex {
  std::string cause;
  double first = 0, first_se = 0, total = 0, total_se = 0;
};
struct OutputIndices {
  std::string key;
  std::vector<CauseIndex> causes;  // sorted by `total`, largest first
};

// Largest tolerances for which P(|output| <= limit) >= probability.
struct AllocatedTolerance {
  std::string tolerance;     // key in the plan with its unit, "probe_position_um"
  double value = 0;          // largest value with which the output meets the limit
  double low = 0, high = 0;  // 95 % interval of `value`, because the number of trials is limited
};
struct Allocation {
  std::string output;
  double limit = 0, probability = 0;
  double reached = 0;  // probability with the tolerances of the plan
  // Largest value of each tolerance, while the others are as planned.
  std::vector<AllocatedTolerance> alone;
  double common_factor = 0;  // common factor by which all allocated tolerances can be multiplied
  // Pairs of tolerances: a value of the first tolerance, and the largest value of the second.
  std::vector<std::vector<AllocatedTolerance>> frontier;
};

// Comparison of two fixtures with the same random numbers.
struct ComparedOutput {
  std::string key;
  double sd_this = 0, sd_other = 0, ratio = 0, ratio_se = 0;  // ratio = other / this
};

enum class StudyState { complete, interrupted };
const char* to_string(StudyState state);

struct StudyResult {
  std::string name;       // "simulation-1", or the plan's name
  std::string plan_toml;  // the whole plan; for a preset, its options in the format of a plan
  std::string software;   // version of mdof
  std::string started_utc;
  std::uint64_t seed = 0, trials = 0;  // trials: number of finished trials
  std::uint64_t trials_wanted = 0;
  double elapsed_s = 0;
  StudyState state = StudyState::complete;
  std::vector<OutputSummary> outputs;
  std::string binned_key;  // "travel_mm"; "": no bins
  std::vector<StudyBin> bins;
  std::vector<Convergence> convergence;
  std::vector<OutputIndices> indices;
  std::vector<Allocation> allocations;
  std::vector<ComparedOutput> comparison;
  std::vector<std::string> warnings;
};

}  // namespace mdof
