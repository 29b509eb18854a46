#include "algo/sensitivity/statistics/statistics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

#include "algo/sensitivity/statistics/intervals.h"
#include "algo/sensitivity/statistics/statistics_parts.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

using Values = std::vector<std::vector<double>>;  // [output][trial], in the order of calculation

std::size_t bins_of(const Experiment& experiment) {
  return std::max<std::size_t>(experiment.binned().bins, 1);
}

// Runs trials first ... first + trials - 1, bin after bin and cell after cell. Calls visit(bin,
// columns of the cell, number of trials) for each cell.
template <class Visit>
void run_cells(const Experiment& experiment, std::uint64_t first, std::uint64_t trials,
               const Visit& visit) {
  const std::size_t bins = bins_of(experiment), outputs = experiment.outputs().size();
  std::vector<double> cell(outputs * kCellTrials);
  std::vector<double*> out(outputs);
  for (std::size_t k = 0; k < outputs; ++k) out[k] = cell.data() + k * kCellTrials;
  for (std::size_t bin = 0; bin < bins && bin < trials; ++bin) {
    const std::uint64_t in_bin = (trials - bin + bins - 1) / bins;
    for (std::uint64_t at = 0; at < in_bin; at += kCellTrials) {
      const std::size_t n = std::min<std::uint64_t>(kCellTrials, in_bin - at);
      experiment.run(first + bin + at * bins, bins, n, out);
      visit(bin, out, n);
    }
  }
}

// Moves the finite values to the front and returns their number.
std::size_t keep_finite(double* x, std::size_t n) {
  return static_cast<std::size_t>(
      std::remove_if(x, x + n, [](double y) { return !std::isfinite(y); }) - x);
}

void add_cell(const Kernels& kernels, const OutputScale& scale, double* x, std::size_t n,
              Accumulator& to) {
  std::array<std::uint64_t, kCellTrials> index;
  CellSums sums{};
  const double per_width = 1 / scale.width;
  kernels.scan(x, n, scale.low, per_width, sums, index.data());
  if (!std::isfinite(sums.power[0])) {
    const std::size_t solved = keep_finite(x, n);
    to.unsolved += n - solved;
    n = solved;
    if (n == 0) return;
    kernels.scan(x, n, scale.low, per_width, sums, index.data());
  }
  to.n += n;
  to.min = std::min(to.min, sums.min + 0.0);  // converts -0 to +0
  to.max = std::max(to.max, sums.max + 0.0);
  to.powers.add(sums);
  to.histogram.add({x, n}, index.data(), scale);
}

OutputSummary summarise(const Accumulator& sums, const OutputScale& scale, const std::string& key,
                        const SummaryRequest& request, bool with_histogram) {
  const OrderedTrials order(sums.histogram, scale, sums.min, sums.max);
  const Moments m = moments_of(sums.powers, order, scale);
  OutputSummary s;
  s.key = key;
  s.n = sums.n;
  s.unsolved = sums.unsolved;
  s.mean = m.mean;
  s.mean_se = m.mean_se;
  s.sd = m.sd;
  s.sd_se = m.sd_se;
  s.coverage = request.coverage;
  if (sums.n == 0) {
    s.min = s.max = kNaN;
    s.symmetric = s.shortest = {kNaN, kNaN};
    for (const double p : request.quantiles) s.quantiles.push_back({p, kNaN});
    return s;
  }
  s.min = sums.min;
  s.max = sums.max;
  summarise_order(order, request.coverage, request.quantiles, s);
  if (with_histogram) s.histogram = histogram_for_drawing(sums.histogram, scale, order);
  return s;
}

BlockFigures figures_of(std::vector<double> values, double coverage) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  BlockFigures f;
  f.n = values.size();
  if (values.size() < 2) return f;
  double sum = 0;
  for (const double x : values) sum += x - values[0];
  const auto n = static_cast<double>(values.size());
  f.mean = values[0] + sum / n;
  double squares = 0;
  for (const double x : values) squares += (x - f.mean) * (x - f.mean);
  f.u = std::sqrt(squares / (n - 1));
  const IntervalRanks ranks = symmetric_ranks(coverage, values.size());
  const auto of_rank = [&](std::uint64_t rank) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  f.low = of_rank(ranks.low);
  f.high = of_rank(ranks.high);
  return f;
}

// Largest number of trials of a block: 80 MB for each output and thread. The term + 1 permits a
// coverage of 0.99999, because 1 - 0.99999 is not exactly 1e-5.
constexpr double kMostAdaptiveBlock = 1e7 + 1;

tl::unexpected<Error> coverage_too_high(double coverage) {
  std::array<char, 32> digits;  // the shortest text from which the same coverage is read
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), coverage);
  return bad_input("coverage " + std::string(digits.data(), end.ptr) +
                       ": a block of adaptive trials would have 100 / (1 - coverage) trials, more "
                       "than the limit of 1e7",
                   Remedy::fix_number_of_trials);
}

std::vector<BlockFigures> figures_of(Values values, double coverage) {
  std::vector<BlockFigures> figures;
  for (std::vector<double>& of_output : values) {
    figures.push_back(figures_of(std::move(of_output), coverage));
  }
  return figures;
}

void collect(Values& values, const std::vector<double*>& cell, std::size_t n) {
  for (std::size_t k = 0; k < cell.size(); ++k) {
    values[k].insert(values[k].end(), cell[k], cell[k] + n);
  }
}

}  // namespace

std::uint64_t block_trials(const Experiment& experiment, std::uint64_t least) {
  const std::uint64_t unit = kCellTrials * bins_of(experiment);
  return (least + unit - 1) / unit * unit;
}

StudyScale pilot_scale(const Experiment& experiment, std::uint64_t trials) {
  Values values(experiment.outputs().size());
  run_cells(experiment, 0, std::min(trials, kPilotTrials),
            [&](std::size_t, const std::vector<double*>& cell, std::size_t n) {
              collect(values, cell, n);
            });
  StudyScale scale;
  for (std::vector<double>& of_output : values) scale.push_back(scale_for(std::move(of_output)));
  return scale;
}

std::vector<BlockFigures> block_figures(const Experiment& experiment, std::uint64_t first_trial,
                                        std::uint64_t trials, double coverage) {
  Values values(experiment.outputs().size());
  run_cells(experiment, first_trial, trials,
            [&](std::size_t, const std::vector<double*>& cell, std::size_t n) {
              collect(values, cell, n);
            });
  return figures_of(std::move(values), coverage);
}

Result<std::uint64_t> adaptive_block_trials(const Experiment& experiment, double coverage) {
  assert(coverage > 0 && coverage < 1);
  const double wanted = std::ceil(100 / (1 - coverage));
  if (wanted > kMostAdaptiveBlock) return coverage_too_high(coverage);
  const std::uint64_t block = block_trials(experiment);
  const auto least = static_cast<std::uint64_t>(wanted);
  return std::max<std::uint64_t>(1, (least + block - 1) / block) * block;
}

void Accumulator::add(const Accumulator& other) {
  n += other.n;
  unsolved += other.unsolved;
  min = std::min(min, other.min);
  max = std::max(max, other.max);
  powers.add(other.powers);
  histogram.add(other.histogram);
}

StudyStatistics::StudyStatistics(const Experiment& shape, StudyScale scale, InstructionSet set)
    : parts_(std::make_unique<Parts>()) {
  assert(scale.size() == shape.outputs().size());
  parts_->outputs = shape.outputs();
  parts_->binned = shape.binned();
  parts_->binned.bins = bins_of(shape);
  parts_->scale = std::move(scale);
  parts_->set = set;
  parts_->sums.resize(parts_->binned.bins * parts_->outputs.size());
}

StudyStatistics::StudyStatistics(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
StudyStatistics::~StudyStatistics() = default;
StudyStatistics::StudyStatistics(StudyStatistics&&) noexcept = default;
StudyStatistics& StudyStatistics::operator=(StudyStatistics&&) noexcept = default;

void StudyStatistics::add_block(const Experiment& experiment, std::uint64_t first_trial,
                                std::uint64_t trials) {
  assert(first_trial % block_trials(experiment, 1) == 0);
  const Kernels& compiled = kernels(parts_->set);
  run_cells(experiment, first_trial, trials,
            [&](std::size_t bin, const std::vector<double*>& cell, std::size_t n) {
              for (std::size_t k = 0; k < cell.size(); ++k) {
                add_cell(compiled, parts_->scale[k], cell[k], n, parts_->at(bin, k));
              }
            });
  parts_->trials += trials;
}

std::vector<BlockFigures> StudyStatistics::add_block_with_figures(const Experiment& experiment,
                                                                  std::uint64_t first_trial,
                                                                  std::uint64_t trials,
                                                                  double coverage) {
  assert(first_trial % block_trials(experiment, 1) == 0);
  const Kernels& compiled = kernels(parts_->set);
  Values values(experiment.outputs().size());
  run_cells(experiment, first_trial, trials,
            [&](std::size_t bin, const std::vector<double*>& cell, std::size_t n) {
              collect(values, cell, n);
              for (std::size_t k = 0; k < cell.size(); ++k) {
                add_cell(compiled, parts_->scale[k], cell[k], n, parts_->at(bin, k));
              }
            });
  parts_->trials += trials;
  return figures_of(std::move(values), coverage);
}

bool StudyStatistics::matches(const StudyStatistics& other) const {
  return parts_->outputs == other.parts_->outputs &&
         parts_->binned.bins == other.parts_->binned.bins && parts_->scale == other.parts_->scale;
}

void StudyStatistics::merge(const StudyStatistics& other) {
  assert(matches(other));
  for (std::size_t i = 0; i < parts_->sums.size(); ++i) parts_->sums[i].add(other.parts_->sums[i]);
  parts_->trials += other.parts_->trials;
}

std::uint64_t StudyStatistics::trials() const {
  return parts_->trials;
}

std::vector<OutputSummary> StudyStatistics::overall(const SummaryRequest& request) const {
  std::vector<OutputSummary> summaries;
  for (std::size_t k = 0; k < parts_->outputs.size(); ++k) {
    Accumulator all;
    for (std::size_t bin = 0; bin < parts_->binned.bins; ++bin) all.add(parts_->at(bin, k));
    summaries.push_back(summarise(all, parts_->scale[k], parts_->outputs[k], request, true));
  }
  return summaries;
}

std::vector<StudyBin> StudyStatistics::bins(const SummaryRequest& request) const {
  const BinnedQuantity& b = parts_->binned;
  std::vector<StudyBin> bins;
  if (b.key.empty()) return bins;
  const double width = (b.to - b.from) / static_cast<double>(b.bins);
  for (std::size_t i = 0; i < b.bins; ++i) {
    StudyBin& bin = bins.emplace_back();
    bin.from = b.from + width * static_cast<double>(i);
    bin.to = i + 1 == b.bins ? b.to : b.from + width * static_cast<double>(i + 1);
    for (std::size_t k = 0; k < parts_->outputs.size(); ++k) {
      bin.outputs.push_back(
          summarise(parts_->at(i, k), parts_->scale[k], parts_->outputs[k], request, false));
    }
  }
  return bins;
}

std::size_t StudyStatistics::memory_bytes() const {
  std::size_t bytes = sizeof(Parts) + parts_->sums.capacity() * sizeof(Accumulator);
  for (const Accumulator& a : parts_->sums) bytes += a.histogram.memory_bytes();
  return bytes;
}

}  // namespace mdof::algo
