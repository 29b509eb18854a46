// The uncertainty of the tool's place relative to the work at one command (../README.md). The
// causes of the uncertainty are the error sources of the machine and the uncertainties of its
// measured errors. SI, except for the values of a cause, which are in the unit of the cause.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

// Effect of one unit of a cause on one error of a frame, at this command: m or rad.
struct CauseEffect {
  std::size_t frame = 0, k = 0;
  bool of_line = false;
  double per_unit = 0;
  std::size_t row = 0;  // index in BudgetModel::rows
};

// An independent random quantity of the trials: a source, a part of the uncertainties of the
// correlated errors of one body (FrameValues::u_parts), an error of an axis line, or a quantity
// that several bodies share.
struct BudgetCause {
  std::string name, unit;
  double u = 0;  // standard uncertainty, in `unit`
  SourceShape shape = SourceShape::normal;
  std::vector<CauseEffect> effects;
  Eigen::Vector3d sensitivity = Eigen::Vector3d::Zero();  // of the tool's place, m for one `unit`;
                                                          // derivative where all errors are 0
  bool is_shared = false;  // a quantity that the errors of several bodies have in common

  Eigen::Vector3d contribution_m() const { return sensitivity.cwiseAbs() * u; }
};

// A row of the budget: a source, or an error with its own u. The errors can be correlated, so the
// squares of the contributions do not add up to u²; the variances do.
struct BudgetRow {
  std::string name, unit;
  double u = 0;  // standard uncertainty, in `unit`
  SourceShape shape = SourceShape::normal;
  Eigen::Vector3d sensitivity = Eigen::Vector3d::Zero();  // as in BudgetCause
  // Part of u_x² + u_y² + u_z², m²: square of the contribution, plus the covariances with the other
  // errors. Negative: the correlation with other errors reduces u by more than this error adds.
  double variance_m2 = 0;

  Eigen::Vector3d contribution_m() const { return sensitivity.cwiseAbs() * u; }
};

// designed: all sources as declared; measured errors are ignored. measured: a measured error has
// its measured value and u. Sources do not act on a measured error (is_measured()), because its
// value includes their effect.
enum class BudgetStage { designed, measured };

struct BudgetModel {
  Machine machine;
  Command at{};
  std::vector<FrameValues> values;  // values of the measured errors
  std::vector<BudgetCause> causes;
  std::vector<BudgetRow> rows;
  std::vector<std::string> replaced;  // effects that a measured error replaces: "screw B on EXX"
  std::vector<std::string> not_declared;  // errors that act on the tool but have neither a cause
                                          // nor a declared u
};

// Effect of one unit of the source on the error at the command `at`: m or rad.
double per_unit_at(const Machine& machine, const SourceEffect& effect, const Command& at);

// Error: the causes can increase an error of a frame beyond 0.1 rad or 10 mm at this command.
Result<BudgetModel> budget_model(const Machine& machine, const Command& at,
                                 MachineApproach approach, BudgetStage stage);

// Standard uncertainty of x, y, z by the linear model with independent causes (GUM 5.1.2).
Eigen::Vector3d budget_u_m(const BudgetModel& model);

// Returns whether errors of different rows are correlated.
bool has_correlated_rows(const BudgetModel& model);

// One measured error, compared with the effect of its declared sources.
struct MeasuredError {
  std::string name;
  std::size_t k = 0;
  bool has_design = false;  // at least one source acts on the error
  // m or rad. designed_u: standard uncertainty by the sources, root mean square over the positions
  // of the table of the error. measured_u: root of the mean of value² + u² over this table, that
  // is, without compensation.
  double designed_u = 0, measured_u = 0;
  // Effect on the tool's place: u times |derivative of the place|.
  double designed_effect_m = 0, measured_effect_m = 0;
};
// Sorted by measured_effect_m² - designed_effect_m², largest first.
std::vector<MeasuredError> designed_against_measured(const Machine& machine, const Command& at);

}  // namespace mdof::algo
