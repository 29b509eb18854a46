// The uncertainty of the tool against the work at one command, from what may vary: the sources of
// the machine and the u of its measured errors (../README.md). SI, but for a cause's own unit.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

// What one unit of a cause does to one error, at this command: m or rad.
struct CauseEffect {
  std::size_t frame = 0, k = 0;
  bool of_line = false;
  double per_unit = 0;
};

struct BudgetCause {
  std::string name, unit;
  double u = 0;  // standard uncertainty, in its unit
  SourceShape shape = SourceShape::normal;
  std::vector<CauseEffect> effects;
  Eigen::Vector3d sensitivity = Eigen::Vector3d::Zero();  // m by its unit, exact at no errors

  Eigen::Vector3d contribution_m() const { return sensitivity.cwiseAbs() * u; }
};

// designed: all sources as declared, no measured error. measured: measured errors have their value
// and their own u; a source does not act on them, for what it does there is in the measured value.
enum class BudgetStage { designed, measured };

struct BudgetModel {
  Machine machine;
  Command at{};
  std::vector<FrameValues> values;  // of the measured errors
  std::vector<BudgetCause> causes;
  std::vector<std::string> replaced;      // "screw B on EXX"
  std::vector<std::string> not_declared;  // act on the tool, and have neither a cause nor a u
};

// What a unit of the source makes of the error at this command: m or rad.
double per_unit_at(const Machine& machine, const SourceEffect& effect, const Command& at);

// Errors: a cause so large that an error leaves 0.1 rad or 10 mm at this command.
Result<BudgetModel> budget_model(const Machine& machine, const Command& at,
                                 MachineApproach approach, BudgetStage stage);

// By the linear form and independent causes (GUM 5.1.2).
Eigen::Vector3d budget_u_m(const BudgetModel& model);

// One measured error beside what its sources were designed to make of it.
struct MeasuredError {
  std::string name;
  std::size_t k = 0;
  bool has_design = false;                // a source acts on it
  double designed_u = 0, measured_u = 0;  // m or rad; measured: root mean square over its table
                                          // and u: what the part has when nothing compensates it
  double designed_effect_m = 0, measured_effect_m = 0;  // the same times |derivative of the place|
};
// That which measurement shows to be the most above its design first.
std::vector<MeasuredError> designed_against_measured(const Machine& machine, const Command& at);

}  // namespace mdof::algo
