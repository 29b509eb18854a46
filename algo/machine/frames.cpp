#include "algo/machine/frames.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr std::string_view kLetters = "XYZABC";

double value_at(const std::vector<double>& values, const TablePlace& place) {
  if (values.size() < 2) return values.empty() ? 0 : values[0];
  const double a = values[place.cell], b = values[place.cell + 1];
  return place.part == 1 ? b : a + (b - a) * place.part;
}

double value_at(const ErrorFunction& f, const TablePlace& place, MachineApproach approach) {
  const double forward = value_at(f.forward, place);
  if (f.reverse.empty() || approach == MachineApproach::forward) return forward;
  const double reverse = value_at(f.reverse, place);
  return approach == MachineApproach::reverse ? reverse : (forward + reverse) / 2;
}

using Matrix6 = Eigen::Matrix<double, kBodyErrors, kBodyErrors>;

// Root of a covariance: L Lᵀ. A pivot that rounding leaves of nothing is nothing.
Matrix6 root_of(const Matrix6& covariance) {
  constexpr double kNothing = 1e-12;  // of the variance
  Matrix6 L = Matrix6::Zero();
  for (Eigen::Index q = 0; q < L.rows(); ++q) {
    const double pivot = covariance(q, q) - L.row(q).head(q).squaredNorm();
    if (!(pivot > kNothing * covariance(q, q))) continue;
    L(q, q) = std::sqrt(pivot);
    for (Eigen::Index k = q + 1; k < L.rows(); ++k)
      L(k, q) = (covariance(k, q) - L.row(k).head(q).dot(L.row(q).head(q))) / L(q, q);
  }
  return L;
}

using SharedErrors = std::vector<std::array<double, kBodyErrors>>;

SharedErrors shared_at(const ErrorCorrelation& correlation, double at) {
  SharedErrors all;
  if (correlation.shared.empty()) return all;
  const TablePlace place = place_of(correlation.position, at);
  for (const SharedPart& part : correlation.shared) {
    const auto& low = part.at[place.cell];
    const auto& high = part.at[std::min(place.cell + 1, part.at.size() - 1)];
    auto& here = all.emplace_back();
    for (std::size_t k = 0; k < kBodyErrors; ++k)
      here[k] = low[k] + (high[k] - low[k]) * place.part;
  }
  return all;
}

// Without the shared parts.
Matrix6 parts_of(const ErrorCorrelation& correlation, double at,
                 const std::array<double, kBodyErrors>& u, const SharedErrors& shared) {
  if (correlation.at.empty())
    return Matrix6(Eigen::Map<const Eigen::Matrix<double, kBodyErrors, 1>>(u.data()).asDiagonal());
  const TablePlace place = place_of(correlation.position, at);
  const auto& low = correlation.at[place.cell];
  const auto& high = correlation.at[std::min(place.cell + 1, correlation.at.size() - 1)];
  Matrix6 covariance;
  for (std::size_t k = 0; k < kBodyErrors; ++k)
    for (std::size_t l = 0; l < kBodyErrors; ++l)
      covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
          u[k] * u[l] * (low[k][l] + (high[k][l] - low[k][l]) * place.part);
  for (const auto& part : shared) {
    const Eigen::Map<const Eigen::Matrix<double, kBodyErrors, 1>> by(part.data());
    covariance -= by * by.transpose();
  }
  return root_of(covariance);
}

// Of the line of an axis; of angles, by the rotations one after the other.
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
  if (at <= position.front()) return {0, 0, at < position.front()};
  if (at >= position.back()) return {position.size() - 2, 1, at > position.back()};
  const auto above = std::upper_bound(position.begin(), position.end(), at);
  const auto cell = static_cast<std::size_t>(above - position.begin()) - 1;
  return {cell, (at - position[cell]) / (position[cell + 1] - position[cell])};
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
  std::array<double, kBodyErrors> u_noise{};
  const double at = command_of(frame, command);
  v.travel = travel_of(frame, command);
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    const ErrorFunction& f = frame.error[k];
    const TablePlace place = place_of(f.position, at);
    v.error[k] = value_at(f, place, approach);
    v.u_error[k] = value_at(f.u, place);
    v.beyond[k] = f.known() && place.beyond;
    v.location[k] = frame.location[k].value.value_or(0);
    v.u_location[k] = frame.location[k].u.value_or(0);
    u_noise[k] = value_at(f.u_independent, place);
  }
  v.shared = shared_at(frame.correlation, at);
  v.u_parts = parts_of(frame.correlation, at, v.u_error, v.shared);
  v.noise_parts = parts_of(frame.noise_correlation, at, u_noise, {});
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
