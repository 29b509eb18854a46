// The paper's small-angle models: exact outputs (Eq. 2-7), the simplified solution
// (Eq. 8-12) and the exact solution. Local frame of the axis; m and rad.
//
// The fixture has three top probes (along ±z, on z = 0) and two side probes (along ±y, on y = h).
// Both output formulas are linear in the position of the probe,
//  Δz = c + q y - p x,   Δy (1 + εy²) = ... + x (εz - εx εy) - z (εx + εy εz),
// so p, q, c are determined by any three top probes that are not on one line, and the side slope r
// by any two side probes at different x. The distances l, l', l'' of the paper are a special case.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "algo/model/fixture.h"
#include "schema/base/result.h"
#include "schema/point.h"

namespace mdof::algo {

// Constants of a five-probe fixture. A B C are the top probes in the order of the rig. D E are the
// side probes; D has the smaller x.
struct SmallAngleFixture {
  std::array<std::size_t, 5> probe;  // index in the rig of A B C D E
  std::array<double, 5> sign;        // sign of the probe's direction along +z or +y
  // p, q, c = Σ weight · (A, B, C)
  std::array<double, 3> p_weight, q_weight, c_weight;
  double side_per_m;  // 1 / (xE - xD)
  double side_rise;   // (zE - zD) / (xE - xD); 0 in the paper's fixture
  double x_D, z_D;
  double h;                         // y coordinate of the side plane
  std::array<double, 5> x, across;  // of each probe: x; y of a top probe, z of a side probe
};

// Error: a fixture without three top probes and two side probes; the error states the reason and
// what to change.
Result<SmallAngleFixture> make_small_angle_fixture(const Fixture& fixture);

// Returns the exact readings of the probes in the order A B C D E, each along the direction of the
// probe. dx_m is the encoder error δx.
std::array<double, 5> exact_outputs(const SmallAngleFixture& f, double travel_m,
                                    const Errors5& local, double dx_m = 0.0);

// Solves n frames at once. `readings`: five columns A B C D E of n values; `out`: five columns in
// the order δy δz εx εy εz. Input and output must not overlap. The results are identical to the
// last bit for any n and any instruction set.
struct BatchIn {
  const double* travel_m;
  std::array<const double*, 5> reading_m;
};
struct BatchOut {
  std::array<double*, 5> local;
};
void solve_batch(Model model, const SmallAngleFixture& f, const BatchIn& in, const BatchOut& out,
                 std::size_t n);

// Solves one frame with the code of solve_batch().
Errors5 solve_small_angle(Model model, const SmallAngleFixture& f, double travel_m,
                          const std::array<double, 5>& reading_m);

}  // namespace mdof::algo
