// Machines with random chains and errors. Their tool position is calculated by 4x4 matrices in long
// double. The matrices follow the definitions in algo/machine/README.md and use no code of algo/ or
// Eigen.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "algo/machine/frames.h"

namespace mdof::test {

class RandomMachines {
 public:
  explicit RandomMachines(unsigned seed) : source_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(source_()) / 4294967296.0;
  }

  // A machine with the axes `letters` in random order; each axis is on the side of the work or of
  // the tool. Errors are up to shift_m and turn_rad, positions up to size_m.
  Machine machine(std::string letters, double shift_m, double turn_rad, double size_m,
                  bool line_errors = true) {
    for (std::size_t i = letters.size(); i > 1; --i)
      std::swap(letters[i - 1], letters[source_() % i]);
    const std::size_t of_work = source_() % (letters.size() + 1);
    Machine m;
    for (std::size_t i = 0; i < letters.size(); ++i)
      m.frames.push_back(frame(letters[i], i < of_work, shift_m, turn_rad, size_m, line_errors));
    for (MachineFrame& f : m.frames)
      if (f.kind == FrameKind::fixed && source_() % 2 == 1) follow(f, letters);
    m.tool_m = place(size_m);
    return m;
  }

  algo::Command command(double size_m) {
    return {between(0, size_m), between(0, size_m), between(0, size_m),
            between(-3, 3),     between(-3, 3),     between(-3, 3)};
  }

 private:
  Vec3 place(double size_m) {
    return {between(-size_m, size_m), between(-size_m, size_m), between(-size_m, size_m)};
  }

  // Makes the frame `f` a rod that moves with a linear axis; the direction of its motion is random.
  void follow(MachineFrame& f, const std::string& letters) {
    const std::size_t axis = letters.find_first_of("XYZ");
    f.moves_with = letters[axis];
    f.direction = source_() % 3;
    f.ratio = between(-2, 2);
  }

  MachineFrame frame(char letter, bool of_work, double shift_m, double turn_rad, double size_m,
                     bool line_errors) {
    MachineFrame f;
    const std::size_t at = std::string("XYZABC").find(letter);
    f.kind = at == std::string::npos ? FrameKind::fixed
             : at < 3                ? FrameKind::linear
                                     : FrameKind::rotary;
    f.id = f.kind == FrameKind::fixed ? std::string("frame ") + letter : std::string(1, letter);
    f.direction = f.kind == FrameKind::fixed ? 0 : at % 3;
    f.carries_work = of_work;
    f.against_command = source_() % 2 == 1;
    f.point_moves = source_() % 2 == 1;
    f.at_m = place(size_m);
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      const double most = k < 3 ? shift_m : turn_rad;
      f.error[k].forward = {between(-most, most)};
      if (f.kind != FrameKind::fixed) {
        f.error[k].position = {f.kind == FrameKind::linear ? 0 : -3.0,
                               f.kind == FrameKind::linear ? size_m : 3.0};
        f.error[k].forward.push_back(between(-most, most));
      }
      if (line_errors && has_location(f, k)) f.location[k].value = between(-most, most);
    }
    return f;
  }

  std::mt19937 source_;
};

// ---- 4x4 matrices in long double ----

using Real = long double;
using Matrix4 = std::array<std::array<Real, 4>, 4>;

inline Matrix4 same() {
  return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

inline Matrix4 times(const Matrix4& a, const Matrix4& b) {
  Matrix4 c{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

inline Matrix4 shifted(const std::array<Real, 3>& by) {
  Matrix4 m = same();
  for (std::size_t i = 0; i < 3; ++i) m[i][3] = by[i];
  return m;
}

inline Matrix4 shifted(const Vec3& by, Real sign = 1) {
  return shifted(std::array<Real, 3>{sign * by[0], sign * by[1], sign * by[2]});
}

// Matrix of a rotation about X, Y or Z.
inline Matrix4 turned(std::size_t about, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  if (about == 0) return {{{1, 0, 0, 0}, {0, c, -s, 0}, {0, s, c, 0}, {0, 0, 0, 1}}};
  if (about == 1) return {{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}, {0, 0, 0, 1}}};
  return {{{c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

inline Matrix4 turned_xyz(Real a, Real b, Real c) {
  return times(turned(2, c), times(turned(1, b), turned(0, a)));
}

// Inverse by Gauss-Jordan elimination with pivots. It does not assume that the matrix is rigid.
inline Matrix4 inverse(Matrix4 m) {
  Matrix4 r = same();
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t best = i;
    for (std::size_t j = i; j < 4; ++j)
      if (std::abs(m[j][i]) > std::abs(m[best][i])) best = j;
    std::swap(m[i], m[best]);
    std::swap(r[i], r[best]);
    const Real by = m[i][i];
    for (std::size_t k = 0; k < 4; ++k) m[i][k] /= by, r[i][k] /= by;
    for (std::size_t j = 0; j < 4; ++j) {
      const Real f = m[j][i];
      for (std::size_t k = 0; j != i && k < 4; ++k) m[j][k] -= f * m[i][k], r[j][k] -= f * r[i][k];
    }
  }
  return r;
}

inline Real interpolated_error(const ErrorFunction& f, Real at) {
  if (f.forward.empty()) return 0;
  if (f.position.empty()) return f.forward[0];
  const Real part = (at - f.position[0]) / (Real(f.position[1]) - f.position[0]);
  return f.forward[0] + part * (Real(f.forward[1]) - f.forward[0]);
}

inline Matrix4 frame_matrix(const MachineFrame& f, Real command, bool with_errors) {
  const Real travel = f.moves_with != 0   ? f.ratio * command
                      : f.against_command ? -command
                                          : command;
  std::array<Real, 6> e{}, line{};
  for (std::size_t k = 0; with_errors && k < 6; ++k) {
    e[k] = interpolated_error(f.error[k], command);
    line[k] = f.location[k].value.value_or(0);
  }
  Matrix4 motion = same();
  std::array<Real, 3> point = {f.at_m[0], f.at_m[1], f.at_m[2]};
  const Matrix4 tilt = turned_xyz(line[3], line[4], line[5]);
  if (f.kind == FrameKind::linear || f.moves_with != 0) {
    for (std::size_t i = 0; i < 3; ++i) motion[i][3] = tilt[i][f.direction] * travel;
    if (f.point_moves) point[f.direction] += travel;
  } else if (f.kind == FrameKind::rotary) {
    std::array<Real, 3> to = point, back = point;
    for (std::size_t i = 0; i < 3; ++i) to[i] += line[i], back[i] = -to[i];
    motion = times(times(times(shifted(to), tilt), turned(f.direction, travel)),
                   times(inverse(tilt), shifted(back)));
  }
  const std::array<Real, 3> away = {-point[0], -point[1], -point[2]};
  std::array<Real, 3> to = point;
  for (std::size_t i = 0; i < 3; ++i) to[i] += e[i];
  return times(times(shifted(to), times(turned_xyz(e[3], e[4], e[5]), shifted(away))), motion);
}

// Pose of the tool in the coordinate system of the work.
inline Matrix4 tool_matrix(const Machine& machine, const algo::Command& command, bool with_errors) {
  Matrix4 work = same(), tool = same();
  for (const MachineFrame& f : machine.frames) {
    const std::string axis = f.moves_with != 0 ? std::string(1, f.moves_with) : f.id;
    const std::size_t at = std::string("XYZABC").find(axis);
    const Matrix4 m = frame_matrix(f, at == std::string::npos ? 0 : command[at], with_errors);
    if (f.carries_work)
      work = times(m, work);  // the next frame is nearer to the bed
    else
      tool = times(tool, m);  // the next frame is nearer to the tool
  }
  return times(inverse(work), times(tool, shifted(machine.tool_m)));
}

struct TrueError {
  std::array<Real, 3> place, angle;
};
inline TrueError true_error(const Machine& machine, const algo::Command& command) {
  const Matrix4 nominal = tool_matrix(machine, command, false);
  const Matrix4 actual = tool_matrix(machine, command, true);
  const Matrix4 R = times(actual, inverse(nominal));
  TrueError e{};
  for (std::size_t i = 0; i < 3; ++i) e.place[i] = actual[i][3] - nominal[i][3];
  e.angle = {std::atan2(R[2][1], R[2][2]), -std::asin(R[2][0]), std::atan2(R[1][0], R[0][0])};
  return e;
}

}  // namespace mdof::test
