// With more than five probes the readings may contradict each other by as much as the rig declares.
// The surfaces are sums of plane waves, and the probes of the fixture are displaced; the mean of χ²
// must equal its degrees of freedom.
#include "algo/uncertainty/effects/reading_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>

#include "algo/model/rigid.h"
#include "algo/uncertainty/chi_square.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/drawn_surface.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

constexpr double kWhite_m = 1e-9, kFlatness_m = 0.5e-6;

struct PlacedProbe {
  const char* id;
  double x_mm, y_mm, z_mm;
  bool top;
};
constexpr PlacedProbe kSevenProbes[] = {{"A", 10, 0, 0, true},    {"B", 0, 10, 0, true},
                                        {"C", 0, -10, 0, true},   {"D", 0, 15, 20, false},
                                        {"E", 10, 15, 20, false}, {"F", -10, 5, 0, true},
                                        {"G", -10, 15, 10, false}};

Rig rig_of_seven(double flatness_length_mm) {
  std::string text = "name = \"seven\"\naxis = \"X\"\n";
  for (const PlacedProbe& p : kSevenProbes)
    text += std::string("[[probe]]\nid = \"") + p.id + "\"\nposition_mm = [" +
            std::to_string(p.x_mm) + ", " + std::to_string(p.y_mm) + ", " + std::to_string(p.z_mm) +
            "]\nmeasures = \"" + (p.top ? "+Z" : "+Y") + "\"\nrange_um = 200\n";
  const std::string flatness =
      flatness_length_mm > 0
          ? "u_flatness_um = 0.5\nflatness_length_mm = " + std::to_string(flatness_length_mm) + "\n"
          : "";
  text += "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n" + flatness +
          "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\n" + flatness;
  return parse_rig(text, "seven.toml").value();
}

// Sums of χ² and of the degrees of freedom.
struct ChiSquares {
  double sum = 0, freedom = 0;
  double ratio() const { return sum / freedom; }
  void add(const Agreement& agreement) {
    sum += agreement.chi_square;
    freedom += agreement.freedom;
  }
};

Agreement agreement_of(const Rig& rig, const Solver& solver, double d,
                       const std::vector<double>& readings_m) {
  const AxisErrors errors = solver.solve(d, readings_m, std::vector<double>(7, kWhite_m));
  Eigen::MatrixXd covariance = declared_covariance(rig, solver, d, errors.local, readings_m, 0.0);
  covariance.diagonal().array() += kWhite_m * kWhite_m;
  return agreement(solver, d, readings_m, covariance, errors);
}

std::vector<double> heights_m(const test_faults::DrawnSurface& top,
                              const test_faults::DrawnSurface& side, double d) {
  std::vector<double> all;
  for (const PlacedProbe& p : kSevenProbes)
    all.push_back(p.top ? top.above_zero_m(1e-3 * p.x_mm, 1e-3 * p.y_mm, d)
                        : side.above_zero_m(1e-3 * p.x_mm, 1e-3 * p.z_mm, d));
  return all;
}

// Waves far shorter than the distances between the probes change each reading independently. The
// variance of the change is twice the variance of the heights, because the height at which the
// probe was zeroed varies, too. Waves far longer appear as tilts and bows, which the five errors
// explain almost completely.
TEST(ReadingCovariance, SurfaceMatchesWavesOfAnyLength) {
  std::mt19937_64 engine(21);
  std::normal_distribution<> normal(0, kWhite_m);
  for (const double length_mm : {4.0, 30.0, 400.0}) {
    const Rig rig = rig_of_seven(length_mm);
    const Solver solver = Solver::create(rig, Model::rigid).value();
    ChiSquares all;
    for (int surface = 0; surface < 500; ++surface) {
      const test_faults::DrawnSurface top(kFlatness_m, length_mm * 1e-3, engine);
      const test_faults::DrawnSurface side(kFlatness_m, length_mm * 1e-3, engine);
      for (const double d : {7e-3, 20e-3, 40e-3}) {
        std::vector<double> readings_m = heights_m(top, side, d);
        for (double& reading : readings_m) reading += normal(engine);
        all.add(agreement_of(rig, solver, d, readings_m));
      }
    }
    std::printf("flatness length %3.0f mm: chi-square / freedom %.3f\n", length_mm, all.ratio());
    EXPECT_NEAR(all.ratio(), 1, 0.15) << length_mm;
  }
}

// A fault as large as the flatness error must be found if the surface cannot cause it, and must not
// be found if the surface can.
TEST(ReadingCovariance, FindsAFaultButNotTheSurface) {
  std::mt19937_64 engine(22);
  std::normal_distribution<> normal(0, kWhite_m);
  const std::vector<double> range_m(7, 200e-6);
  const auto accused = [&](double length_mm, double fault_m) {
    const Rig rig = rig_of_seven(length_mm);
    const Solver solver = Solver::create(rig, Model::rigid).value();
    const Residuals residuals(solver, range_m, rig, 0);
    int found = 0;
    for (int surface = 0; surface < 2000; ++surface) {
      const test_faults::DrawnSurface top(kFlatness_m, length_mm * 1e-3, engine);
      const test_faults::DrawnSurface side(kFlatness_m, length_mm * 1e-3, engine);
      constexpr double d = 20e-3;
      MeasuredPoint p;
      p.point.position_m = d;
      p.point.probe_m = heights_m(top, side, d);
      for (double& reading : p.point.probe_m) reading += normal(engine);
      p.point.probe_m[5] += fault_m;
      p.point.probe_u_m.assign(7, kWhite_m);
      p.errors = solver.solve(d, p.point.probe_m, p.point.probe_u_m);
      residuals.test(p);
      found += p.point.flags.empty() ? 0 : 1;
    }
    return found;
  };
  EXPECT_EQ(accused(4, 0), 0);
  EXPECT_EQ(accused(400, 0), 0);
  EXPECT_EQ(accused(400, 0.5e-6), 2000);
}

// A calibration determines the zeros and positions of F and G. At a tilt of 5 mrad the effect of
// each zero almost compensates the effect of the position of the same probe.
constexpr double kPlace_m = 20e-6, kTilt_rad = 5e-3, kCorrelation = 0.95;

TEST(ReadingCovariance, CalibrationKeepsItsCorrelations) {
  Rig rig = rig_of_seven(0);
  const double u_zero_m = kPlace_m * kTilt_rad;
  CalibrationRecord& record = rig.records.emplace_back();
  record.covariance.of = {"F.x", "F.zero", "G.x", "G.zero"};
  record.covariance.m2.assign(4, std::vector<double>(4));
  for (const std::size_t i : {0u, 2u}) {
    const double both = kCorrelation * kPlace_m * u_zero_m;
    record.covariance.m2[i][i] = kPlace_m * kPlace_m;
    record.covariance.m2[i + 1][i + 1] = u_zero_m * u_zero_m;
    record.covariance.m2[i][i + 1] = record.covariance.m2[i + 1][i] = both;
    Probe& probe = rig.probes[i == 0 ? 5 : 6];
    probe.uncertainty.position.u[0] = kPlace_m;
    probe.uncertainty.calibration.u = u_zero_m;
  }
  const Solver solver = Solver::create(rig, Model::rigid).value();
  const Fixture nominal = make_fixture(rig).value();
  // The top falls by 5 µm per millimetre along x, and the side comes nearer to its probes.
  const Errors5 tilted = {0, 0, 0, kTilt_rad, -kTilt_rad};
  std::mt19937_64 engine(23);
  std::normal_distribution<> normal;
  ChiSquares all;
  for (int trial = 0; trial < 1500; ++trial) {
    Fixture as_is = nominal;
    std::vector<double> zero_m(7);
    for (const std::size_t k : {5u, 6u}) {
      const double place = normal(engine), other = normal(engine);
      as_is.probes[k].p_MP.x() += kPlace_m * place;
      zero_m[k] =
          u_zero_m * (kCorrelation * place + std::sqrt(1 - kCorrelation * kCorrelation) * other);
    }
    constexpr double d = 1e-3;
    const Eigen::VectorXd readings = rigid_readings(as_is, d, tilted) -
                                     rigid_readings(as_is, 0, Errors5{}) +
                                     rigid_readings(nominal, 0, Errors5{});
    std::vector<double> readings_m;
    for (std::size_t k = 0; k < 7; ++k)
      readings_m.push_back(readings(static_cast<Eigen::Index>(k)) + zero_m[k] +
                           kWhite_m * normal(engine));
    all.add(agreement_of(rig, solver, d, readings_m));
  }
  std::printf("calibration: chi-square / freedom %.3f\n", all.ratio());
  EXPECT_NEAR(all.ratio(), 1, 0.15);
}

// Tests each kind of calibrated quantity separately. Expected: half the difference between the
// readings of two fixtures in which the quantity is increased or decreased by its u. Each fixture
// is zeroed at the travel 0.
TEST(ReadingCovariance, CalibratedQuantitiesMatchADisplacedFixture) {
  const Errors5 carriage = {20e-6, -10e-6, 1e-3, 6e-3, -4e-3};
  constexpr double d = 12e-3, kBy = 1e-3;
  struct Named {
    const char* name;
    std::size_t probe;
    Eigen::Index place, direction;  // component of the position or direction; -1: not displaced
    double u;
  };
  for (const Named& of : {Named{"A.y", 0, 1, -1, 2e-5},
                          {"G.z", 6, 2, -1, 3e-5},
                          {"C.nx", 2, -1, 0, kBy},
                          {"G.nz", 6, -1, 2, kBy},
                          {"E.zero", 4, -1, -1, 4e-8}}) {
    Rig rig = rig_of_seven(0);
    CalibrationRecord& record = rig.records.emplace_back();
    record.covariance.of = {of.name};
    record.covariance.m2 = {{of.u * of.u}};
    const Solver solver = Solver::create(rig, Model::rigid).value();
    const auto zeroed = [&](double sign) {
      Fixture displaced = solver.fixture();
      FixtureProbe& probe = displaced.probes[of.probe];
      if (of.place >= 0) probe.p_MP(of.place) += sign * of.u;
      if (of.direction >= 0) {
        probe.u_M(of.direction) += sign * of.u;
        probe.u_M.normalize();
      }
      return Eigen::VectorXd(rigid_readings(displaced, d, carriage) -
                             rigid_readings(displaced, 0, Errors5{}));
    };
    Eigen::VectorXd by = (zeroed(1) - zeroed(-1)) / 2;
    if (of.place < 0 && of.direction < 0) by = of.u * Eigen::VectorXd::Unit(7, 4);
    const Eigen::MatrixXd found =
        declared_covariance(rig, solver, d, carriage, std::vector<double>(7, 1e-6), 0);
    EXPECT_GT(by.norm(), 5e-11) << of.name;
    EXPECT_LT((found - by * by.transpose()).norm(), 1e-3 * by.squaredNorm()) << of.name;
  }
}

// Neither noise alone nor the flatness error alone explains the fault; together they do.
TEST(ReadingCovariance, NoiseAndDeclaredUncertaintiesAdd) {
  const Rig waves = rig_of_seven(4);
  Rig exact = waves;
  for (TargetPlane& plane : exact.planes) plane.u_flatness.u = 0;
  const Solver solver = Solver::create(waves, Model::rigid).value();
  constexpr double d = 20e-3;
  const auto is_flagged = [&](const Rig& rig, double noise_m, double fault_m) {
    MeasuredPoint p;
    p.point.position_m = d;
    p.point.probe_m.assign(7, 0.0);
    p.point.probe_m[5] = fault_m;
    p.point.probe_u_m.assign(7, noise_m);
    p.errors = solver.solve(d, p.point.probe_m, p.point.probe_u_m);
    Residuals(solver, std::vector<double>(7, 200e-6), rig, 0).test(p);
    return !p.point.flags.empty();
  };
  // The smallest fault that is flagged. The noise is √2 times the declared flatness u, because the
  // heights at the point and where the probe was zeroed both vary.
  const auto least_flagged_m = [&](const Rig& rig, double noise_m) {
    double low = 1e-8, high = 1e-4;
    for (int i = 0; i < 40; ++i) {
      const double middle = std::sqrt(low * high);
      (is_flagged(rig, noise_m, middle) ? high : low) = middle;
    }
    return high;
  };
  const double noise_m = std::sqrt(2.0) * kFlatness_m;
  const double by_noise_m = least_flagged_m(exact, noise_m),
               by_waves_m = least_flagged_m(waves, kWhite_m),
               by_both_m = least_flagged_m(waves, noise_m);
  EXPECT_NEAR(by_waves_m / by_noise_m, 1, 0.2);
  EXPECT_NEAR(by_both_m / std::hypot(by_noise_m, by_waves_m), 1, 0.05);
}

// Effect of an error of the travel d on the readings, to first order of Eq. 2-7: a top reading
// changes by the error times the pitch, a side reading by the error times -yaw.
constexpr double kPitch_rad = 200e-6, kYaw_rad = -300e-6;

Eigen::MatrixXd covariance_of(const std::string& declared, double travel_m) {
  const Rig rig = test::rig_x_with("", "", declared);
  const Solver solver = Solver::create(rig, Model::rigid).value();
  Errors5 carriage{};
  carriage[kEy] = kPitch_rad;
  carriage[kEz] = kYaw_rad;
  return declared_covariance(rig, solver, travel_m, carriage, std::vector<double>(5, 0.0), 0);
}

void expect_travel_covariance(const Eigen::MatrixXd& found, double u_m) {
  const double by[] = {kPitch_rad, kPitch_rad, kPitch_rad, -kYaw_rad, -kYaw_rad};
  for (Eigen::Index a = 0; a < 5; ++a)
    for (Eigen::Index b = 0; b < 5; ++b) {
      const double expected = by[a] * by[b] * u_m * u_m;
      EXPECT_NEAR(found(a, b), expected, 1e-3 * std::abs(expected)) << a << b;
    }
}

TEST(EncoderCovariance, IsCommonToAllReadings) {
  expect_travel_covariance(covariance_of("[encoder]\nu_um = 20\n", 0.03), 20e-6);
  EXPECT_EQ(covariance_of("", 0.03).norm(), 0);
}

// A direction in the calibration record of a probe replaces the direction of the rig: its X and Y
// components for a top probe, its X and Z components for a side probe.
TEST(CalibratedDirections, ReplaceTheDirectionsOfTheRig) {
  for (const auto& [id, across] : {std::pair("A", 1U), {"B", 1U}, {"D", 2U}, {"E", 2U}}) {
    const auto covariance = [id = std::string(id), across = across](const std::string& keys) {
      Rig rig = test::rig_x_with(id, keys);
      CalibrationRecord& record = rig.records.emplace_back();
      record.covariance.of = {direction_name(id, 0), direction_name(id, across)};
      record.covariance.m2 = {{4e-8, 1e-8}, {1e-8, 9e-8}};
      const Solver solver = Solver::create(rig, Model::rigid).value();
      Errors5 carriage{};
      carriage[kEx] = carriage[kEy] = carriage[kEz] = 1e-3;
      return declared_covariance(rig, solver, 0.03, carriage, std::vector<double>(5, 0.0), 0);
    };
    const Eigen::MatrixXd recorded = covariance("");
    EXPECT_GT(recorded.norm(), 0) << id;
    EXPECT_EQ((covariance("u_direction_mrad = 5") - recorded).norm(), 0) << id;
  }
}

// The fixture was installed with a turn and an offset about and along each axis of the machine.
// Expected: half the difference of the readings of two fixtures that are moved as a whole and
// zeroed at the travel 0.
TEST(InstallationCovariance, MatchesAMovedFixture) {
  constexpr double d = 30e-3;
  const double angle_mrad[] = {0.5, 0.7, 0.9}, offset_mm[] = {0.02, 0.03, 0.05};
  const Errors5 carriage = {20e-6, -10e-6, 1e-3, 6e-3, -4e-3};
  for (int which = 0; which < 6; ++which) {
    const auto axis = which % 3;
    const bool is_turn = which < 3;
    std::string values[3] = {"0", "0", "0"};
    values[axis] = std::to_string(is_turn ? angle_mrad[axis] : offset_mm[axis]);
    const Rig rig = test::rig_x_with("", "",
                                     std::string("[installation]\n") +
                                         (is_turn ? "u_angle_mrad" : "u_offset_mm") + " = [" +
                                         values[0] + ", " + values[1] + ", " + values[2] + "]\n");
    const Solver solver = Solver::create(rig, Model::rigid).value();
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    const auto zeroed = [&](double sign) {
      Fixture moved = solver.fixture();
      for (FixtureProbe& probe : moved.probes) {
        if (is_turn) {
          const Eigen::AngleAxisd turn(sign * 1e-3 * angle_mrad[axis], unit);
          probe.p_MP = turn * probe.p_MP;
          probe.u_M = turn * probe.u_M;
        } else {
          probe.p_MP += sign * 1e-3 * offset_mm[axis] * unit;
        }
      }
      return Eigen::VectorXd(rigid_readings(moved, d, carriage) -
                             rigid_readings(moved, 0, Errors5{}));
    };
    const Eigen::VectorXd by = (zeroed(1) - zeroed(-1)) / 2;
    const Eigen::MatrixXd found =
        declared_covariance(rig, solver, d, carriage, std::vector<double>(5, 0.0), 0);
    EXPECT_GT(by.norm(), 1e-9) << which;
    EXPECT_LT((found - by * by.transpose()).norm(), 1e-3 * by.squaredNorm()) << which;
  }
}

}  // namespace
}  // namespace mdof::algo
