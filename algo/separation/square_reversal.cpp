#include "algo/separation/square_reversal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "algo/uncertainty/coverage.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// Relative to u²: a smaller declared part is rounding.
constexpr double kLeastPart = 1e-12;
// A difference of more than this number of standard uncertainties is a contradiction.
constexpr double kSameSquare = 3;

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

Notices square_notices(const SquareReversal& found, const std::vector<const Rig*>& rigs) {
  Notices all;
  std::vector<double> declared_rad;
  for (const Rig* rig : rigs) {
    const auto angle_rad = rig->artefact_angle_error_rad;
    if (!angle_rad ||
        std::find(declared_rad.begin(), declared_rad.end(), *angle_rad) != declared_rad.end())
      continue;
    const double u_rad = std::hypot(found.u_rad, rig->u_artefact_angle_rad.value_or(0));
    if (std::abs(found.square_rad - *angle_rad) > kSameSquare * u_rad)
      all.push_back(notice(NoticeCode::square_contradicts_rig, "",
                           {{"found_urad", to_urad(found.square_rad)},
                            {"declared_urad", to_urad(*angle_rad)},
                            {"u_urad", to_urad(u_rad)}}));
    if (!declared_rad.empty())
      all.push_back(notice(
          NoticeCode::rigs_declare_different_squares, "",
          {{"one_urad", to_urad(declared_rad.front())}, {"other_urad", to_urad(*angle_rad)}}));
    declared_rad.push_back(*angle_rad);
  }
  return all;
}

}  // namespace mdof::algo
