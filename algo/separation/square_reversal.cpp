#include "algo/separation/square_reversal.h"

#include <array>
#include <cmath>
#include <string>

#include "algo/uncertainty/coverage.h"

namespace mdof::algo {
namespace {

// Relative to u²: a smaller declared part is rounding.
constexpr double kLeastPart = 1e-12;

double declared(const Budget& b) {
  const double square = b.u * b.u - b.u_random * b.u_random;
  return square > kLeastPart * b.u * b.u ? std::sqrt(square) : 0;
}

Status check_corners(int first, int second) {
  if (first == 0 || second == 0)
    return bad_input(std::string("the ") + (first == 0 ? "first" : "second") +
                     " set-up does not state at which corner of the square the two faces meet; "
                     "give offset_mm in the [[plane]] tables of both rigs");
  if (first == second)
    return bad_input(
        "both set-ups contain the angle of the square with the same sign, so this angle cannot be "
        "separated from the angle of the machine. Turn the square over about X or Y in one of the "
        "set-ups, so that one of its two faces is on the other side. Give the new positions of the "
        "probes and of the [[plane]] in the rig of this set-up");
  return {};
}

}  // namespace

Result<SquareReversal> square_reversal(const SquareSetUp& first, const SquareSetUp& second) {
  MDOF_CHECK(check_corners(first.corner, second.corner));
  const Budget &a = first.budget, &b = second.budget;
  SquareReversal out;
  out.first_rad = a.value;
  out.second_rad = b.value;
  out.EC0Y_rad = (a.value + b.value) / 2;
  out.square_rad = first.corner * (b.value - a.value) / 2;
  out.u_random_rad = std::hypot(a.u_random, b.u_random) / 2;
  out.u_declared_rad = (declared(a) + declared(b)) / 2;
  out.u_rad = std::hypot(out.u_random_rad, out.u_declared_rad);
  const std::array<UncertaintyPart, 2> parts = {{{a.u / 2, a.freedom}, {b.u / 2, b.freedom}}};
  out.freedom = effective_freedom(parts);
  out.coverage_factor = coverage_factor(out.freedom);
  out.U_rad = out.coverage_factor * out.u_rad;
  out.noise_only = a.noise_only && b.noise_only;
  return out;
}

}  // namespace mdof::algo
