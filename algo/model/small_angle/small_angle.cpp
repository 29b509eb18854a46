#include "algo/model/small_angle/small_angle.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>
#include <vector>

#include "algo/model/small_angle/small_angle_kernel.h"
#include "schema/base/instruction_set.h"

namespace mdof::algo {
namespace {

constexpr double kAlong = 1 - 1e-9;  // smallest cosine of a direction along an axis
constexpr double kSamePlane_m = 1e-9;

tl::unexpected<Error> not_of_this_kind(const std::string& why) {
  return bad_input(
      "the models \"simplified\" and \"exact\" need three probes along ±z on the plane z = 0 and "
      "two probes along ±y on one plane: " +
      why + "; use the model \"rigid\"");
}

struct Roles {
  std::vector<std::size_t> top, side;
};

Result<Roles> find_roles(const Fixture& fixture) {
  Roles roles;
  for (std::size_t i = 0; i < fixture.probes.size(); ++i) {
    const auto& probe = fixture.probes[i];
    if (!probe.flatness.empty()) {
      return not_of_this_kind(
          "probe " + probe.id +
          " measures a plane with a flatness map, which these models cannot use");
    }
    if (std::abs(probe.n_C.dot(probe.u_M)) < kAlong) {
      return not_of_this_kind("probe " + probe.id + " is not perpendicular to its plane");
    }
    if (std::abs(probe.u_M.z()) > kAlong) {
      roles.top.push_back(i);
    } else if (std::abs(probe.u_M.y()) > kAlong) {
      roles.side.push_back(i);
    } else {
      return not_of_this_kind("probe " + probe.id + " measures along neither ±z nor ±y");
    }
  }
  if (roles.top.size() != 3 || roles.side.size() != 2) {
    return not_of_this_kind("this rig has " + std::to_string(roles.top.size()) +
                            " probes along ±z and " + std::to_string(roles.side.size()) +
                            " along ±y");
  }
  return roles;
}

// Calculates the weights of three points for p, q, c in Δz = c + q y - p x. Returns false if the
// points are on one line.
bool top_weights(SmallAngleFixture& f) {
  Eigen::Matrix3d M;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    M.row(i) << -f.x[k], f.across[k], 1.0;
  }
  const double area = M.determinant();
  if (std::abs(area) < 1e-9) return false;  // m²: a triangle of 0.03 mm sides
  const Eigen::Matrix3d inverse = M.inverse();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    f.p_weight[k] = inverse(0, i);
    f.q_weight[k] = inverse(1, i);
    f.c_weight[k] = inverse(2, i);
  }
  return true;
}

BatchKernels batch_kernels(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return batch_kernels_avx512();
    case InstructionSet::avx2:
      return batch_kernels_avx2();
    case InstructionSet::baseline:
      break;
  }
  return batch_kernels_baseline();
}

}  // namespace

// Largest ratio of the distance of the side probes along z to their distance along the motion. Up
// to this ratio the iteration of `exact` converges (small_angle_kernel.h).
constexpr double kSteepest = 3;

Result<SmallAngleFixture> make_small_angle_fixture(const Fixture& fixture) {
  MDOF_TRY(Roles roles, find_roles(fixture));
  const auto x_of = [&](std::size_t i) { return fixture.probes[i].p_MP.x(); };
  if (x_of(roles.side[0]) > x_of(roles.side[1])) std::swap(roles.side[0], roles.side[1]);
  SmallAngleFixture f{};
  for (std::size_t k = 0; k < 5; ++k) {
    const bool top = k < 3;
    f.probe[k] = top ? roles.top[k] : roles.side[k - 3];
    const auto& probe = fixture.probes[f.probe[k]];
    f.sign[k] = (top ? probe.u_M.z() : probe.u_M.y()) < 0 ? -1.0 : 1.0;
    f.x[k] = probe.p_MP.x();
    f.across[k] = top ? probe.p_MP.y() : probe.p_MP.z();
    if (top && std::abs(probe.p_MP.z()) > kSamePlane_m) {
      return not_of_this_kind("probe " + probe.id + " does not measure a point on the plane z = 0");
    }
  }
  f.h = fixture.probes[f.probe[3]].p_MP.y();
  if (std::abs(fixture.probes[f.probe[4]].p_MP.y() - f.h) > kSamePlane_m) {
    return not_of_this_kind("the two probes along ±y measure different planes");
  }
  if (!top_weights(f)) return not_of_this_kind("the three probes along ±z are on one line");
  const double span = f.x[4] - f.x[3];
  if (span < 1e-5)
    return not_of_this_kind("the two probes along ±y have the same position along the motion");
  f.side_per_m = 1.0 / span;
  f.side_rise = (f.across[4] - f.across[3]) / span;
  if (std::abs(f.side_rise) > kSteepest)
    return not_of_this_kind(
        "the two probes along ±y are too close together along the motion, compared with their "
        "distance along z");
  f.x_D = f.x[3];
  f.z_D = f.across[3];
  return f;
}

std::array<double, 5> exact_outputs(const SmallAngleFixture& f, double travel_m, const Errors5& e,
                                    double dx_m) {
  const double dy = e[kDy], dz = e[kDz], ex = e[kEx], ey = e[kEy], ez = e[kEz];
  const double D = travel_m + dx_m;
  std::array<double, 5> reading{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = f.x[k], y = f.across[k];
    reading[k] =
        f.sign[k] *
        ((ex * (y - dy + (D - x) * ez) + ey * (D - x + (dy - y) * ez)) / (1 + ez * ez) + dz);
  }
  for (std::size_t k = 3; k < 5; ++k) {
    const double x = f.x[k], z = f.across[k];
    reading[k] = f.sign[k] * ((-ez * (D - x) + ex * ey * (D - x) - (ex + ey * ez) * (z - dz) +
                               f.h * (ex * ex + ez * ez)) /
                                  (1 + ey * ey) +
                              dy);
  }
  return reading;
}

void solve_batch(Model model, const SmallAngleFixture& f, const BatchIn& in, const BatchOut& out,
                 std::size_t n) {
  assert(model != Model::rigid);
  static const BatchKernels kernels = batch_kernels(best_instruction_set());
  (model == Model::simplified ? kernels.simplified : kernels.exact)(f, in, out, n);
}

Errors5 solve_small_angle(Model model, const SmallAngleFixture& f, double travel_m,
                          const std::array<double, 5>& reading_m) {
  Errors5 local{};
  BatchIn in{&travel_m, {}};
  BatchOut out{};
  for (std::size_t k = 0; k < 5; ++k) {
    in.reading_m[k] = &reading_m[k];
    out.local[k] = &local[k];
  }
  solve_batch(model, f, in, out, 1);
  return local;
}

}  // namespace mdof::algo
