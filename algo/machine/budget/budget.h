// The uncertainty of the tool relative to the work at one command, by the sources of the machine
// and the u of its measured errors (../README.md). SI, except for the unit of a cause.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

// Effect of one unit of a cause on one error, at this command: m or rad.
struct CauseEffect {
  std::size_t frame = 0, k = 0;
  bool of_line = false;
  double per_unit = 0;
};

struct BudgetCause {
  std::string name, unit;
  double u = 0;  // standard uncertainty, in `unit`
  SourceShape shape = SourceShape::normal;
  std::vector<CauseEffect> effects;
  Eigen::Vector3d sensitivity = Eigen::Vector3d::Zero();  // m by `unit`, exact at errors of 0

  Eigen::Vector3d contribution_m() const { return sensitivity.cwiseAbs() * u; }
};

// designed: all sources as declared, no measured error. measured: measured errors have their value
// and their own u; sources do not act on them, because the measured value includes their effect.
enum class BudgetStage { designed, measured };

struct BudgetModel {
  Machine machine;
  Command at{};
  std::vector<FrameValues> values;  // values of the measured errors
  std::vector<BudgetCause> causes;
  std::vector<std::string> replaced;      // "screw B on EXX"
  std::vector<std::string> not_declared;  // errors that act on the tool, with neither cause nor u
};

// Effect of one unit of the source on the error at this command: m or rad.
double per_unit_at(const Machine& machine, const SourceEffect& effect, const Command& at);

// Error: a cause so large that an error exceeds 0.1 rad or 10 mm at this command.
Result<BudgetModel> budget_model(const Machine& machine, const Command& at,
                                 MachineApproach approach, BudgetStage stage);

// By the linear model with independent causes (GUM 5.1.2).
Eigen::Vector3d budget_u_m(const BudgetModel& model);

// One measured error and the effect of its sources by design.
struct MeasuredError {
  std::string name;
  std::size_t k = 0;
  bool has_design = false;  // a source acts on it
  // m or rad. measured_u: root mean square over its table, with u: the error without compensation.
  double designed_u = 0, measured_u = 0;
  // Effect on the place: u times |derivative of the place|.
  double designed_effect_m = 0, measured_effect_m = 0;
};
// Sorted by measured_effect_m² - designed_effect_m², largest first.
std::vector<MeasuredError> designed_against_measured(const Machine& machine, const Command& at);

}  // namespace mdof::algo
