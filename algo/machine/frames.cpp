#include "algo/machine/frames.h"

#include <algorithm>
#include <cmath>

#include "algo/compensation/between_targets.h"
#include "algo/linear_algebra/covariance_root.h"

namespace mdof::algo {
namespace {

constexpr std::string_view kLetters = "XYZABC";

double value_at(const ErrorFunction& f, const TablePlace& place, MachineApproach approach) {
  const double forward = value_at(f.forward, place);
  if (f.reverse.empty() || approach == MachineApproach::forward) return forward;
  const double reverse = value_at(f.reverse, place);
  return approach == MachineApproach::reverse ? reverse : (forward + reverse) / 2;
}

using Matrix6 = Eigen::Matrix<double, kBodyErrors, kBodyErrors>;

Matrix6 matrix_of(const Covariance6& covariance) {
  Matrix6 matrix;
  for (std::size_t k = 0; k < kBodyErrors; ++k)
    for (std::size_t l = 0; l < kBodyErrors; ++l)
      matrix(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) = covariance[k][l];
  return matrix;
}

// The covariance of the errors at a command between two positions: the interpolated covariance,
// scaled so that the standard deviations are linear between the positions. The interpolated error
// has at most this standard deviation, whatever the correlation of the errors at the two positions
// is.
Matrix6 between(const std::vector<Covariance6>& by_position, const TablePlace& place) {
  Matrix6 low = matrix_of(by_position[place.cell]);
  if (place.part == 0) return low;
  Matrix6 high = matrix_of(by_position[place.cell + 1]);
  if (place.part == 1) return high;
  const Matrix6 mean = low + (high - low) * place.part;
  Eigen::Matrix<double, kBodyErrors, 1> scale;
  for (Eigen::Index k = 0; k < scale.rows(); ++k) {
    const double below = std::sqrt(low(k, k)), above = std::sqrt(high(k, k));
    scale(k) = mean(k, k) > 0 ? (below + (above - below) * place.part) / std::sqrt(mean(k, k)) : 0;
  }
  return scale.asDiagonal() * mean * scale.asDiagonal();
}

using SharedErrors = std::vector<std::array<double, kBodyErrors>>;

SharedErrors shared_at(const ErrorCovariance& covariance, const TablePlace& place) {
  SharedErrors all;
  for (const SharedPart& part : covariance.shared) {
    const auto& low = part.at[place.cell];
    const auto& high = part.at[std::min(place.cell + 1, part.at.size() - 1)];
    auto& here = all.emplace_back();
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      here[k] = low[k] + (high[k] - low[k]) * place.part;
  }
  return all;
}

// The change of a series over the interval of `place`; 0 for a constant.
double change(const std::vector<double>& values, const TablePlace& place) {
  return values.size() < 2 ? 0 : values[place.cell + 1] - values[place.cell];
}

// Standard uncertainty due to the straight line between two positions or, beyond the first and the
// last position, due to the value of this position, which is held.
double u_interpolation(const ErrorFunction& f, const TablePlace& place, double at) {
  if (f.position.size() < 2) return 0;
  const double low = f.position[place.cell], high = f.position[place.cell + 1];
  const double interval = high - low, curvature = f.curvature.empty() ? 0 : f.curvature[place.cell];
  if (place.part > 0 && place.part < 1)
    return 0.5 * place.part * (1 - place.part) * interval * interval * curvature;
  const double beyond = std::max(low - at, at - high);  // 0 at an end
  return std::max(u_beyond_end(beyond, interval, change(f.forward, place), curvature),
                  u_beyond_end(beyond, interval, change(f.reverse, place), curvature));
}

double squared(double x) {
  return x * x;
}

// Sets the uncertainties of the errors of the body in `v`.
void set_uncertainty(const MachineFrame& frame, double at, FrameValues& v) {
  const ErrorCovariance& known = frame.covariance;
  Matrix6 all = Matrix6::Zero(), noise = Matrix6::Zero();
  if (!known.position.empty()) {
    const TablePlace place = place_of(known.position, at);
    noise = between(known.noise, place);
    all = noise + between(known.declared, place);
    v.shared = shared_at(known, place);
  }
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const ErrorFunction& f = frame.error[k];
    const TablePlace place = place_of(f.position, at);
    const auto kk = static_cast<Eigen::Index>(k);
    if (!known.has[k]) {
      all(kk, kk) = squared(value_at(f.u, place));
      noise(kk, kk) = squared(value_at(f.u_independent, place));
    }
    if (!f.u.empty()) all(kk, kk) += squared(u_interpolation(f, place, at));
  }
  v.u_parts = covariance_root(all);
  v.noise_parts = covariance_root(noise);
}

// Rotation of the axis line by its location errors EA0, EB0, EC0.
Eigen::Matrix3d line_rotation(const FrameValues& v) {
  return tiny_rotation(v.location[3], v.location[4], v.location[5]);
}

Pose about_point(const Eigen::Matrix3d& R, const Eigen::Vector3d& point) {
  return {R, point - R * point};
}

Pose motion(const MachineFrame& frame, const FrameValues& v) {
  if (frame.kind == FrameKind::fixed && frame.moves_with == 0) return {};
  const Eigen::Matrix3d line = line_rotation(v);
  if (moves_along(frame))
    return {Eigen::Matrix3d::Identity(),
            line.col(static_cast<Eigen::Index>(frame.direction)) * v.travel};
  const Eigen::Vector3d centre =
      vector_of(frame.at_m) + Eigen::Vector3d(v.location[0], v.location[1], v.location[2]);
  return about_point(line * turn_about(frame.direction, v.travel) * line.transpose(), centre);
}

}  // namespace

TablePlace place_of(const std::vector<double>& position, double at) {
  if (position.empty()) return {};
  if (position.size() == 1) return {0, 0, at != position[0]};
  const std::size_t last = position.size() - 1;
  if (at <= position[0])
    return {0, 0, at < position[0] - kEndTolerance * (position[1] - position[0])};
  if (at >= position[last])
    return {last - 1, 1,
            at > position[last] + kEndTolerance * (position[last] - position[last - 1])};
  const auto above = std::upper_bound(position.begin(), position.end(), at);
  const auto cell = static_cast<std::size_t>(above - position.begin()) - 1;
  return {cell, (at - position[cell]) / (position[cell + 1] - position[cell])};
}

double value_at(const std::vector<double>& values, const TablePlace& place) {
  if (values.size() < 2) return values.empty() ? 0 : values[0];
  const double a = values[place.cell], b = values[place.cell + 1];
  return place.part == 1 ? b : a + (b - a) * place.part;
}

double command_of(const MachineFrame& frame, const Command& command) {
  return frame.kind == FrameKind::fixed ? 0 : command[kLetters.find(frame.id)];
}

double travel_of(const MachineFrame& frame, const Command& command) {
  if (frame.moves_with != 0) return frame.ratio * command[kLetters.find(frame.moves_with)];
  const double at = command_of(frame, command);
  return frame.against_command ? -at : at;
}

FrameValues values_at(const MachineFrame& frame, const Command& command, MachineApproach approach) {
  FrameValues v;
  const double at = command_of(frame, command);
  v.travel = travel_of(frame, command);
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const ErrorFunction& f = frame.error[k];
    const TablePlace place = place_of(f.position, at);
    v.error[k] = value_at(f, place, approach);
    v.beyond[k] = f.known() && place.beyond;
    v.location[k] = frame.location[k].value.value_or(0);
    v.u_location[k] = frame.location[k].u.value_or(0);
  }
  set_uncertainty(frame, at, v);
  return v;
}

std::vector<FrameValues> values_at(const Machine& machine, const Command& command,
                                   MachineApproach approach) {
  std::vector<FrameValues> values;
  values.reserve(machine.frames.size());
  for (const MachineFrame& frame : machine.frames)
    values.push_back(values_at(frame, command, approach));
  return values;
}

Pose nominal_pose(const MachineFrame& frame, double travel) {
  FrameValues v;
  v.travel = travel;
  return motion(frame, v);
}

Eigen::Vector3d holding_point(const MachineFrame& frame, double travel) {
  Eigen::Vector3d point = vector_of(frame.at_m);
  if (moves_along(frame) && frame.point_moves)
    point[static_cast<Eigen::Index>(frame.direction)] += travel;
  return point;
}

Pose actual_pose(const MachineFrame& frame, const FrameValues& v) {
  const Eigen::Vector3d point = holding_point(frame, v.travel);
  Pose error = about_point(tiny_rotation(v.error[3], v.error[4], v.error[5]), point);
  error.p += Eigen::Vector3d(v.error[0], v.error[1], v.error[2]);
  return error * motion(frame, v);
}

}  // namespace mdof::algo
