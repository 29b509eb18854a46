#include "algo/milling/milling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "algo/milling/input_limits.h"

namespace mdof::algo {
namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double largest_deflection_m(const MillingPlan& plan, const CutTurn& turn) {
  return deflection_m(plan, turn, 0).rowwise().norm().maxCoeff();
}

// The models assume that the deflection of the tool's axis is small.
Status check_deflection(const MillingPlan& plan, const CutTurn& turn) {
  const double deflection_m = largest_deflection_m(plan, turn);
  if (deflection_m <= plan.radius_m() / 2) return {};
  return fail(ErrorCode::check,
              "the tip is deflected by " + std::to_string(deflection_m * 1e6) +
                  " µm, which is more than half of the tool's radius; the tool "
                  "is too weak for this cut: reduce overhang_mm or the depths of cut");
}

WallFigures wall_figures(const MillingPlan& plan, const CutTurn& turn) {
  const std::vector<WallLine> lines = wall_lines(plan, turn);
  WallFigures wall;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double offset = lines[i].mean_m();
    least = std::min(least, offset);
    most = std::max(most, offset);
    const bool of_element = i > 0 && i + 1 < lines.size();
    if (of_element) wall.offset_mean_m += offset / static_cast<double>(lines.size() - 2);
  }
  wall.form_m = most - least;
  wall.waviness_tip_m = lines.front().waviness_m();
  wall.waviness_root_m = lines.back().waviness_m();
  wall.offset_tip_m = lines.front().mean_m();
  wall.offset_root_m = lines.back().mean_m();
  wall.Ra_tip_m = lines.front().Ra_m();
  wall.Ra_root_m = lines.back().Ra_m();
  return wall;
}

Result<double> mean_offset_m(const MillingPlan& plan) {
  MDOF_TRY(const CutTurn turn, cut_turn(plan));
  MDOF_CHECK(check_deflection(plan, turn));
  return wall_figures(plan, turn).offset_mean_m;
}

}  // namespace

Result<MillingResult> milling(const MillingPlan& plan) {
  MillingPlan rigid_plan = plan;
  rigid_plan.deflection = DeflectionModel::rigid;
  MDOF_TRY(const CutTurn rigid, cut_turn(rigid_plan));
  MDOF_TRY(const CutTurn turn, cut_turn(plan));
  const Eigen::MatrixXd force = turn.force_N(), force_rigid = rigid.force_N();
  MDOF_CHECK(check_deflection(plan, turn));
  MillingResult r;
  r.x_max_N = force.col(0).cwiseAbs().maxCoeff();
  r.y_max_N = force.col(1).cwiseAbs().maxCoeff();
  r.x_max_rigid_N = force_rigid.col(0).cwiseAbs().maxCoeff();
  r.y_max_rigid_N = force_rigid.col(1).cwiseAbs().maxCoeff();
  r.x_mean_N = force.col(0).mean();
  r.y_mean_N = force.col(1).mean();
  r.deflection_m = largest_deflection_m(plan, turn);
  r.deflection_rigid_m = largest_deflection_m(plan, rigid);
  r.entry_rad = turn.entry_rad;
  r.exit_rad = turn.exit_rad;
  r.power_W = mean(turn.power_W);
  r.wall = wall_figures(plan, turn);
  r.iterations = turn.iterations;
  return r;
}

Result<WearOffset> wear_offset(const DeclaredMillingPlan& declared) {
  WearOffset out;
  MDOF_TRY(out.offset_m, mean_offset_m(declared.plan));
  double square = 0;
  for (const auto& [input, u] : declared.u) {
    const InputStep step = input_step(declared.plan, *input, u);
    MDOF_TRY(const double above, mean_offset_m(step.higher));
    MDOF_TRY(const double below, mean_offset_m(step.lower));
    out.parts.push_back({input, (above - below) / step.width * u});
    square += out.parts.back().contribution_m * out.parts.back().contribution_m;
  }
  std::stable_sort(out.parts.begin(), out.parts.end(), [](const auto& a, const auto& b) {
    return std::abs(a.contribution_m) > std::abs(b.contribution_m);
  });
  for (const MillingInput& input : milling_inputs()) {
    const bool is_declared = std::any_of(declared.u.begin(), declared.u.end(),
                                         [&](const auto& one) { return one.first == &input; });
    if (!is_declared && declared.plan.*(input.member) != 0) out.not_declared.push_back(&input);
  }
  out.u_m = declared.u.empty() ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(square);
  return out;
}

}  // namespace mdof::algo
