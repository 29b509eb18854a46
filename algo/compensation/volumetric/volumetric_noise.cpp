#include "algo/compensation/volumetric/volumetric_noise.h"

#include <algorithm>
#include <optional>

#include "algo/machine/compensating.h"

namespace mdof::algo {
namespace {

using Matrix6 = Eigen::Matrix<double, kBodyErrors, kBodyErrors>;
using EffectOnTool = Eigen::Matrix<double, 3, kBodyErrors>;

// kOthers[axis]: the other two axes, in the order X, Y, Z.
constexpr std::array<std::array<std::size_t, 2>, 3> kOthers = {{{1, 2}, {0, 2}, {0, 1}}};

// The effect of the errors of a frame on the position of the tool, as a function of the commands p,
// q of the other two axes:
// of[0] + of[1] p + of[2] q.
struct AffineEffect {
  std::array<EffectOnTool, 3> of;
};

EffectOnTool effect_at(const Machine& machine, std::size_t frame, const Command& command) {
  EffectOnTool effect = EffectOnTool::Zero();
  for (const ErrorDerivative& d : command_derivatives(machine, command))
    if (d.frame == frame && !d.of_line) effect.col(static_cast<Eigen::Index>(d.k)) = d.d.head<3>();
  return effect;
}

AffineEffect effect_of(const Machine& machine, std::size_t frame, Command command,
                       std::size_t axis) {
  for (const std::size_t other : kOthers[axis]) command[other] = 0;
  AffineEffect effect{{effect_at(machine, frame, command), {}, {}}};
  for (std::size_t i = 0; i < 2; ++i) {
    Command moved = command;
    moved[kOthers[axis][i]] = 1;
    effect.of[i + 1] = effect_at(machine, frame, moved) - effect.of[0];
  }
  return effect;
}

// Returns for each component of the tool's position the quadratic form
// (a.of[0] + a.of[1] p + a.of[2] q) covariance (b.of[0] + b.of[1] p + b.of[2] q)ᵀ.
std::array<AxisNoise::SquareForm, 3> square_forms(const AffineEffect& a, const Matrix6& covariance,
                                                  const AffineEffect& b) {
  std::array<AxisNoise::SquareForm, 3> forms{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const auto product = [&](std::size_t i, std::size_t j) {
      return (a.of[i].row(row) * covariance).dot(b.of[j].row(row));
    };
    forms[k] = {product(0, 0), product(1, 0) + product(0, 1), product(2, 0) + product(0, 2),
                product(1, 1), product(1, 2) + product(2, 1), product(2, 2)};
  }
  return forms;
}

double weight_of(const TablePlace& place, std::size_t target) {
  if (target == place.cell) return 1 - place.part;
  return target == place.cell + 1 ? place.part : 0;
}

// Returns the covariance of the noise of error k at the command `at` and the noise of error l at
// the command `there`. Only targets that are next to both commands contribute.
double covariance_of(const MachineFrame& frame, std::size_t k, std::size_t l, double at,
                     double there) {
  const ErrorCovariance& known = frame.covariance;
  const ErrorFunction& f = frame.error[k];
  const bool together = known.has[k] && known.has[l];
  if (!together && (k != l || f.u_independent.empty())) return 0;
  const std::vector<double>& targets = together ? known.position : f.position;
  const TablePlace here = place_of(targets, at), next = place_of(targets, there);
  double sum = 0;
  for (std::size_t t = here.cell;
       t < std::min(here.cell + 2, std::max<std::size_t>(targets.size(), 1)); ++t) {
    const double weights = weight_of(here, t) * weight_of(next, t);
    if (weights != 0)
      sum += weights * (together ? known.noise[t][k][l] : f.u_independent[t] * f.u_independent[t]);
  }
  return sum;
}

Matrix6 covariance_between(const MachineFrame& frame, double at, double there) {
  Matrix6 all;
  for (std::size_t k = 0; k < kBodyErrors; ++k)
    for (std::size_t l = 0; l < kBodyErrors; ++l)
      all(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
          covariance_of(frame, k, l, at, there);
  return all;
}

std::vector<AxisNoise> noise_of_axis(const Machine& machine, std::size_t frame,
                                     const std::vector<double>& commands_m, Command command,
                                     MachineApproach approach) {
  const MachineFrame& of = machine.frames[frame];
  std::vector<AxisNoise> noise;
  std::optional<AffineEffect> before;
  for (std::size_t i = 0; i < commands_m.size(); ++i) {
    command[of.direction] = commands_m[i];
    const AffineEffect effect = effect_of(machine, frame, command, of.direction);
    const Matrix6& parts = values_at(of, command, approach).noise_parts;
    if (before)
      noise.back().covariance_with_next =
          square_forms(*before, covariance_between(of, commands_m[i - 1], commands_m[i]), effect);
    noise.push_back({square_forms(effect, parts * parts.transpose(), effect), {}});
    before = effect;
  }
  return noise;
}

bool has_noise(const MachineFrame& frame) {
  return std::any_of(frame.error.begin(), frame.error.end(),
                     [](const ErrorFunction& f) { return !f.u_independent.empty(); });
}

double value_of(const AxisNoise::SquareForm& c, double p, double q) {
  return c[0] + p * (c[1] + p * c[3]) + q * (c[2] + p * c[4] + q * c[5]);
}

}  // namespace

void set_axis_noise(VolumetricTable& table, const Machine& machine, const Command& others,
                    MachineApproach approach) {
  if (std::none_of(machine.frames.begin(), machine.frames.end(), has_noise)) return;
  for (std::size_t i = 0; i < machine.frames.size(); ++i) {
    const MachineFrame& frame = machine.frames[i];
    if (frame.kind != FrameKind::linear || table.command_m[frame.direction].size() < 2) continue;
    table.noise[frame.direction] =
        noise_of_axis(machine, i, table.command_m[frame.direction], others, approach);
  }
}

Vec3 noise_variance(const VolumetricTable& table, const std::array<GridCell, 3>& cell,
                    const Vec3& command_m) {
  Vec3 at = command_m, variance{};
  for (std::size_t k = 0; k < 3; ++k)
    at[k] = std::clamp(at[k], table.command_m[k].front(), table.command_m[k].back());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (table.noise[axis].empty()) continue;
    const double p = at[kOthers[axis][0]], q = at[kOthers[axis][1]], part = cell[axis].part;
    const AxisNoise& node = table.noise[axis][cell[axis].index];
    const AxisNoise& next =
        part > 0 ? table.noise[axis][cell[axis].index + 1] : table.noise[axis][cell[axis].index];
    for (std::size_t k = 0; k < 3; ++k)
      variance[k] += (1 - part) * (1 - part) * value_of(node.variance[k], p, q) +
                     2 * part * (1 - part) * value_of(node.covariance_with_next[k], p, q) +
                     part * part * value_of(next.variance[k], p, q);
  }
  for (double& of : variance) of = std::max(of, 0.0);  // below 0: rounding
  return variance;
}

}  // namespace mdof::algo
