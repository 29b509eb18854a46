#include "algo/part/machine_causes.h"

#include "algo/machine/budget/budget.h"

#include <algorithm>
#include <cmath>

#include "algo/machine/compensating.h"
#include "algo/machine/tool_error.h"

namespace mdof::algo {
namespace {

// A known error. frame, k and of_line identify the error in the result of derivatives().
struct Known {
  std::size_t frame = 0, k = 0;
  bool of_line = false;
  std::size_t cause = 0;
};

std::vector<Known> known_errors(const Machine& machine, std::size_t points, MachineCauses& causes) {
  std::vector<Known> known;
  for (std::size_t f = 0; f < machine.frames.size(); ++f)
    for (const bool of_line : {false, true})
      for (std::size_t k = 0; k < kBodyErrors; ++k) {
        const MachineFrame& frame = machine.frames[f];
        if (!frame.is_known(k, of_line)) continue;
        known.push_back({f, k, of_line, causes.axes.size()});
        causes.axes.push_back(
            new_cause(of_line ? location_name(frame, k) : error_name(frame, k), points));
      }
  return known;
}

// Follows the commands along the path and keeps the last direction of motion of each axis.
class PathApproaches {
 public:
  // The first point has the approach of the first step.
  PathApproaches(const Machine& machine, const std::vector<Eigen::Vector3d>& at_m)
      : machine_(machine),
        approach_(machine.frames.size(), MachineApproach::mean),
        unknown_(machine.frames.size(), 0) {
    if (at_m.size() < 2) return;
    before_ = command_at_place(machine, at_m[0]);
    move_to(command_at_place(machine, at_m[1]));
  }

  // Values of the errors at the next point of the path.
  std::vector<FrameValues> values_at_next(const Command& command) {
    std::vector<FrameValues> values;
    if (next_++ > 0) move_to(command);
    for (std::size_t f = 0; f < machine_.frames.size(); ++f) {
      if (approach_[f] == MachineApproach::mean) ++unknown_[f];
      values.push_back(values_at(machine_.frames[f], command, approach_[f]));
    }
    before_ = command;
    return values;
  }

  std::vector<std::pair<std::string, std::size_t>> unknown() const {
    std::vector<std::pair<std::string, std::size_t>> list;
    for (std::size_t f = 0; f < machine_.frames.size(); ++f) {
      const auto& errors = machine_.frames[f].error;
      const bool depends = std::any_of(errors.begin(), errors.end(),
                                       [](const ErrorFunction& e) { return !e.reverse.empty(); });
      if (depends && unknown_[f] > 0) list.emplace_back(machine_.frames[f].id, unknown_[f]);
    }
    return list;
  }

 private:
  static constexpr double kRounding = 1e-9;  // m or rad

  void move_to(const Command& command) {
    for (std::size_t f = 0; f < machine_.frames.size(); ++f) {
      const MachineFrame& frame = machine_.frames[f];
      const double step = command_of(frame, command) - command_of(frame, before_);
      // The coordinates of a path are rounded.
      if (std::abs(step) > kRounding)
        approach_[f] = step > 0 ? MachineApproach::forward : MachineApproach::reverse;
    }
  }

  const Machine& machine_;
  Command before_{};
  std::size_t next_ = 0;                   // index of the next point
  std::vector<MachineApproach> approach_;  // [frame]; `mean` until the axis has moved
  std::vector<std::size_t> unknown_;       // [frame] number of points
};

// Returns the effect of one unit of the source on the position of the tool for this command.
// Measured errors are left out, because their values already contain the effect of the source.
Eigen::Vector3d effect_of(const Machine& machine, const ErrorSource& source, const Command& command,
                          const std::vector<ErrorDerivative>& all, bool with_axes) {
  Eigen::Vector3d effect = Eigen::Vector3d::Zero();
  for (const SourceEffect& acts : source.acts_on) {
    if (with_axes && is_measured(machine, {acts.frame, acts.k, acts.of_line, {}})) continue;
    const double factor = per_unit_at(machine, acts, command);
    for (const ErrorDerivative& d : all)
      if (d.frame == acts.frame && d.k == acts.k && d.of_line == acts.of_line)
        effect += factor * d.d.head<3>();
  }
  return effect;
}

std::vector<Eigen::Vector3d>& common_part(PartCause& cause, std::size_t number) {
  for (CommonPart& part : cause.common)
    if (part.number == number) return part.u_m;
  cause.common.push_back(
      {number, std::vector<Eigen::Vector3d>(cause.u_m.size(), Eigen::Vector3d::Zero())});
  return cause.common.back().u_m;
}

// Adds the u of the error `one` of a body at point `p`. `d`: derivative by this error. If the
// errors of the body are correlated, or other bodies share a quantity, u consists of common parts.
void add_u_of_body(const Machine& machine, const Known& one, const Eigen::Vector3d& d,
                   const std::vector<FrameValues>& values, std::size_t p, PartCause& cause) {
  const FrameValues& v = values[one.frame];
  const auto row = static_cast<Eigen::Index>(one.k);
  if (machine.frames[one.frame].covariance.position.empty()) {
    cause.u_m[p] += d * v.u_parts(row, row);
    return;
  }
  for (Eigen::Index q = 0; q <= row; ++q)
    common_part(cause, one.frame * kBodyErrors + static_cast<std::size_t>(q))[p] +=
        d * v.u_parts(row, q);
  for (std::size_t s = 0; s < v.shared.size(); ++s)
    common_part(cause, values.size() * kBodyErrors + s)[p] += d * v.shared[s][one.k];
}

}  // namespace

MachineCauses machine_causes(const Machine& machine, const std::vector<Eigen::Vector3d>& at_m,
                             bool with_axes) {
  MachineCauses causes;
  const std::vector<Known> known = known_errors(machine, at_m.size(), causes);
  for (const ErrorSource& source : machine.sources)
    causes.budget.push_back(new_cause(source.name, at_m.size()));
  PathApproaches approaches(machine, at_m);
  for (std::size_t p = 0; p < at_m.size(); ++p) {
    const Command command = command_at_place(machine, at_m[p]);
    const auto values = approaches.values_at_next(command);
    const auto all = derivatives(machine, command);
    for (const Known& one : known)
      for (const ErrorDerivative& d : all) {
        if (d.frame != one.frame || d.k != one.k || d.of_line != one.of_line) continue;
        const FrameValues& v = values[one.frame];
        PartCause& cause = causes.axes[one.cause];
        const Eigen::Vector3d place = d.d.head<3>();
        cause.value_m[p] += place * (one.of_line ? v.location : v.error)[one.k];
        if (one.of_line)
          cause.u_m[p] += place * v.u_location[one.k];
        else
          add_u_of_body(machine, one, place, values, p, cause);
      }
    for (std::size_t s = 0; s < machine.sources.size(); ++s)
      causes.budget[s].u_m[p] =
          effect_of(machine, machine.sources[s], command, all, with_axes) * machine.sources[s].u;
    const ToolError error = tool_error(machine, command, MachineApproach::mean);
    for (std::size_t k = 0; k < 3; ++k) {
      add_new(error.not_measured[k], causes.not_measured);
      add_new(error.no_u[k], causes.no_u);
    }
    add_new(error.beyond, causes.beyond);
  }
  causes.unknown_approach = approaches.unknown();
  return causes;
}

}  // namespace mdof::algo
