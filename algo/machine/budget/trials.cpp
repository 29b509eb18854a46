#include "algo/machine/budget/trials.h"

#include <algorithm>
#include <cmath>

#include "algo/sensitivity/distribution.h"
#include "algo/sensitivity/kernels/chain.h"
#include "algo/sensitivity/kernels/kernels.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kTrials = 256;  // number of trials in one block: the numbers for 84 causes
                                      // fit into the second-level cache

// How the deviation of one cause is calculated from a random number.
struct Drawing {
  SourceShape shape = SourceShape::normal;
  double u = 0;
  std::shared_ptr<const QuantileFunction> function;  // only for triangular and U-shaped: quantiles
                                                     // for u = 1
};

Drawing drawing_of(const BudgetCause& cause) {
  Drawing drawing{cause.shape, cause.u, nullptr};
  Distribution d;
  if (cause.shape == SourceShape::triangular)
    d = {Distribution::Kind::triangular, -std::sqrt(6.0), std::sqrt(6.0), 0, 0, 0, 0, 0, {}};
  else if (cause.shape == SourceShape::u_shaped)
    d = {Distribution::Kind::u_shaped, -std::sqrt(2.0), std::sqrt(2.0), 0, 0, 0, 0, 0, {}};
  else
    return drawing;
  drawing.function = std::make_shared<const QuantileFunction>(d);
  return drawing;
}

// Converts uniform numbers to numbers with standard deviation 1. For the rectangular shape the
// numbers stay uniform in (0, 1); term_of() scales them.
void shape_numbers(const Drawing& drawing, std::span<double> p) {
  if (drawing.shape == SourceShape::normal) gaussians(p);
  if (!drawing.function) return;
  for (double& x : p) x = drawing.function->at(x);
}

ChainTerm term_of(const BudgetCause& cause, std::size_t column, double per_unit) {
  if (cause.shape == SourceShape::rectangular)
    return {column, 0.5, 2 * std::sqrt(3.0) * cause.u * per_unit};
  return {column, 0, cause.u * per_unit};
}

class BudgetTrials : public ScalableExperiment {
 public:
  BudgetTrials(const BudgetModel& model, std::uint64_t seed, InstructionSet set)
      : seed_(seed), set_(set) {
    outputs_ = {"x_um", "y_um", "z_um", "volume_um"};
    for (const BudgetCause& cause : model.causes) {
      causes_.push_back(cause.name);
      drawings_.push_back(drawing_of(cause));
    }
    for (const BudgetRow& row : model.rows) {
      quantities_.push_back(row.name);
      sizes_.push_back(row.u);
    }
    for (std::size_t i = model.machine.frames.size(); i-- > 0;) add_step(model, i);
    const Pose nominal = nominal_tool(model.machine, model.at);
    for (std::size_t i = 0; i < 3; ++i) {
      chain_.tool[i] = model.machine.tool_m[i];
      chain_.nominal[i] = nominal.p[static_cast<Eigen::Index>(i)];
    }
  }

  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    run_all({}, terms_, first, step, n, out);
  }
  void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first, std::uint64_t step,
                 std::size_t n, std::span<double* const> out) const override {
    run_all(second, terms_, first, step, n, out);
  }
  void run_scaled(std::span<const double> scale, std::uint64_t first, std::uint64_t step,
                  std::size_t n, std::span<double* const> out) const override {
    std::vector<ChainTerm> terms = terms_;
    for (std::size_t t = 0; t < terms.size(); ++t) terms[t].factor *= scale[term_rows_[t]];
    run_all({}, terms, first, step, n, out);
  }
  std::vector<std::pair<std::string, double>> inputs(std::uint64_t trial) const override {
    std::vector<double> columns(columns_count() * kTrials);
    draw_all({}, trial, 1, 1, columns);
    std::vector<std::pair<std::string, double>> all;
    for (std::size_t c = 0; c < causes_.size(); ++c) {
      const double x = columns[c * kTrials];
      const bool even = drawings_[c].shape == SourceShape::rectangular;
      all.emplace_back(causes_[c], drawings_[c].u * (even ? 2 * std::sqrt(3.0) * (x - 0.5) : x));
    }
    return all;
  }

 private:
  ChainSum sum_of(const BudgetModel& model, std::size_t frame, std::size_t k, bool of_line) {
    const FrameValues& v = model.values[frame];
    ChainSum sum{of_line ? v.location[k] : v.error[k], terms_.size(), 0};
    for (std::size_t c = 0; c < model.causes.size(); ++c)
      for (const CauseEffect& e : model.causes[c].effects)
        if (e.frame == frame && e.k == k && e.of_line == of_line && e.per_unit != 0) {
          terms_.push_back(term_of(model.causes[c], c, e.per_unit));
          term_rows_.push_back(e.row);
        }
    sum.last = terms_.size();
    return sum;
  }

  void add_step(const BudgetModel& model, std::size_t i) {
    const MachineFrame& frame = model.machine.frames[i];
    const double travel = travel_of(frame, model.at);
    ChainStep step;
    step.inverse = frame.carries_work;
    const Eigen::Vector3d point = holding_point(frame, travel);
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      step.error[k] = sum_of(model, i, k, false);
      step.line[k] = sum_of(model, i, k, true);
    }
    if (moves_along(frame)) {
      step.motion = ChainMotion::linear;
      step.direction = frame.direction;
      step.travel = travel;
    } else if (frame.kind == FrameKind::rotary) {
      step.motion = ChainMotion::rotary;
      const Eigen::Matrix3d turn = turn_about(frame.direction, travel);
      for (Eigen::Index k = 0; k < 9; ++k) step.turn[k] = turn(k / 3, k % 3);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      step.point[k] = point[static_cast<Eigen::Index>(k)];
      step.centre[k] = frame.at_m[k];
    }
    steps_.push_back(step);
  }

  std::size_t columns_count() const { return causes_.size() + causes_.size() % 2; }

  // Draws numbers for all causes. One call of draw_pairs() with group g draws the numbers 2g and 2g
  // + 1.
  void draw_all(std::span<const std::uint8_t> second, std::uint64_t first, std::uint64_t step,
                std::size_t n, std::vector<double>& columns) const {
    std::array<double, kTrials> other{};
    const auto column = [&](std::size_t c) { return std::span(&columns[c * kTrials], n); };
    const std::span<double> rest(other.data(), n);
    const auto stream = [&](std::size_t c) {
      return Stream{seed_, c < second.size() && second[c] != 0 ? 1u : 0u};
    };
    for (std::size_t c = 0; c < causes_.size(); c += 2) {
      const bool alike = stream(c).stream == stream(c + 1).stream;
      draw_pairs(stream(c), c / 2, first, step, column(c), alike ? column(c + 1) : rest, set_);
      if (!alike) draw_pairs(stream(c + 1), c / 2, first, step, rest, column(c + 1), set_);
    }
    for (std::size_t c = 0; c < causes_.size(); ++c) shape_numbers(drawings_[c], column(c));
  }

  void run_all(std::span<const std::uint8_t> second, const std::vector<ChainTerm>& terms,
               std::uint64_t first, std::uint64_t step, std::size_t n,
               std::span<double* const> out) const {
    ChainProgram chain = chain_;
    chain.steps = steps_.data();
    chain.count = steps_.size();
    chain.terms = terms.data();
    std::vector<double> columns(columns_count() * kTrials);
    for (std::size_t done = 0; done < n; done += kTrials) {
      const std::size_t some = std::min(kTrials, n - done);
      draw_all(second, first + step * done, step, some, columns);
      double* const error[3] = {out[0] + done, out[1] + done, out[2] + done};
      kernels(set_).chain(chain, columns.data(), kTrials, some, error);
      for (std::size_t j = 0; j < some; ++j) {
        const double x = error[0][j] * 1e6, y = error[1][j] * 1e6, z = error[2][j] * 1e6;
        error[0][j] = x;
        error[1][j] = y;
        error[2][j] = z;
        out[3][done + j] = std::sqrt(x * x + y * y + z * z);
      }
    }
  }

  std::uint64_t seed_;
  InstructionSet set_;
  std::vector<Drawing> drawings_;  // one for each cause; the random numbers of cause c are in
                                   // column c
  std::vector<ChainStep> steps_;   // from the tool to the work
  std::vector<ChainTerm> terms_;
  std::vector<std::size_t> term_rows_;  // row of the budget that scales each term
  ChainProgram chain_;
};

}  // namespace

std::unique_ptr<ScalableExperiment> budget_trials(const BudgetModel& model, std::uint64_t seed,
                                                  InstructionSet set) {
  return std::make_unique<BudgetTrials>(model, seed, set);
}

}  // namespace mdof::algo
