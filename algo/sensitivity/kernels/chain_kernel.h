// Calculates a chain of frames by the full product of rotations, with one vector of trials at a
// time. SI.
#pragma once

#include "algo/machine/tiny_angle.h"
#include "algo/sensitivity/kernels/chain.h"
#include "algo/sensitivity/kernels/vector.h"

namespace mdof::algo {
namespace {

struct ChainPoint {
  Vector x[3];
};

struct TrialColumns {
  const double* first;  // first number of this vector of trials in the first column
  std::size_t stride;

  Vector sum(const ChainProgram& chain, const ChainSum& of) const {
    Vector total = broadcast(of.constant);
    for (std::size_t i = of.first; i < of.last; ++i) {
      const ChainTerm& term = chain.terms[i];
      total += (read(first + term.column * stride) - term.centre) * term.factor;
    }
    return total;
  }
};

// Rotation Rz(c) Ry(b) Rx(a). Angles that are 0 in all trials are skipped.
struct ChainTurn {
  bool turns[3];
  Vector sine[3], cosine[3];

  ChainTurn(const ChainProgram& chain, const TrialColumns& columns, const ChainSum* angle) {
    for (std::size_t i = 0; i < 3; ++i) {
      turns[i] = angle[i].constant != 0 || angle[i].first != angle[i].last;
      if (!turns[i]) continue;
      const Vector at = columns.sum(chain, angle[i]);
      sine[i] = tiny_sin(at);
      cosine[i] = tiny_cos(at);
    }
  }
  void one(std::size_t i, Vector s, ChainPoint& p) const {
    if (!turns[i]) return;
    Vector &u = p.x[(i + 1) % 3], &v = p.x[(i + 2) % 3];
    const Vector turned = cosine[i] * u - s * v;
    v = s * u + cosine[i] * v;
    u = turned;
  }
  void forward(ChainPoint& p) const {
    for (std::size_t i = 0; i < 3; ++i) one(i, sine[i], p);
  }
  void backward(ChainPoint& p) const {
    for (std::size_t i = 3; i-- > 0;) one(i, -sine[i], p);
  }
};

// Applies the errors of a body, x -> point + e + R (x - point), or the inverse.
inline void by_errors(const ChainProgram& chain, const ChainStep& step, const TrialColumns& columns,
                      ChainPoint& p) {
  const ChainTurn turn(chain, columns, &step.error[3]);
  for (std::size_t i = 0; i < 3; ++i) {
    p.x[i] -= step.point[i];
    if (step.inverse) p.x[i] -= columns.sum(chain, step.error[i]);
  }
  step.inverse ? turn.backward(p) : turn.forward(p);
  for (std::size_t i = 0; i < 3; ++i) {
    p.x[i] += step.point[i];
    if (!step.inverse) p.x[i] += columns.sum(chain, step.error[i]);
  }
}

inline void by_line(const ChainProgram& chain, const ChainStep& step, const TrialColumns& columns,
                    ChainPoint& p) {
  const double travel = step.inverse ? -step.travel : step.travel;
  ChainPoint along;
  for (std::size_t i = 0; i < 3; ++i) along.x[i] = broadcast(i == step.direction ? travel : 0.0);
  ChainTurn(chain, columns, &step.line[3]).forward(along);
  for (std::size_t i = 0; i < 3; ++i) p.x[i] += along.x[i];
}

// Applies a rotary motion T, x -> q + R0 T R0' (x - q). q is the centre plus the shift errors of
// the axis line, R0 the rotation by the angle errors of the axis line, R0' its transpose.
inline void by_turn(const ChainProgram& chain, const ChainStep& step, const TrialColumns& columns,
                    ChainPoint& p) {
  const ChainTurn line(chain, columns, &step.line[3]);
  Vector centre[3];
  for (std::size_t i = 0; i < 3; ++i) {
    centre[i] = step.centre[i] + columns.sum(chain, step.line[i]);
    p.x[i] -= centre[i];
  }
  line.backward(p);
  ChainPoint turned;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto of = [&](std::size_t j) { return step.turn[step.inverse ? 3 * j + i : 3 * i + j]; };
    turned.x[i] = of(0) * p.x[0] + of(1) * p.x[1] + of(2) * p.x[2];
  }
  line.forward(turned);
  for (std::size_t i = 0; i < 3; ++i) p.x[i] = turned.x[i] + centre[i];
}

inline void by_motion(const ChainProgram& chain, const ChainStep& step, const TrialColumns& columns,
                      ChainPoint& p) {
  if (step.motion == ChainMotion::linear) by_line(chain, step, columns, p);
  if (step.motion == ChainMotion::rotary) by_turn(chain, step, columns, p);
}

inline void chain_kernel(const ChainProgram& chain, const double* columns, std::size_t stride,
                         std::size_t n, double* const* error) {
  for (std::size_t j = 0; j < n; j += kPerVector) {
    const TrialColumns here{columns + j, stride};
    ChainPoint p;
    for (std::size_t i = 0; i < 3; ++i) p.x[i] = broadcast(chain.tool[i]);
    for (std::size_t k = 0; k < chain.count; ++k) {
      const ChainStep& step = chain.steps[k];
      if (step.inverse) by_errors(chain, step, here, p);
      by_motion(chain, step, here, p);
      if (!step.inverse) by_errors(chain, step, here, p);
    }
    const std::size_t some = n - j < kPerVector ? n - j : kPerVector;
    for (std::size_t i = 0; i < 3; ++i) write_some(error[i] + j, p.x[i] - chain.nominal[i], some);
  }
}

}  // namespace
}  // namespace mdof::algo
