// A simulated machine with an X axis whose target is clamped at several tilts. The planes are
// calculated from three rotated points and intersected with the lines of the probes. This code
// shares nothing with algo/calibration.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "algo/calibration/mounting.h"
#include "tests/algo/rigs.h"

namespace mdof::test {

struct TrueProbe {
  Vec3 place{}, way{};
  bool top = true;  // true: faces the plane z = 0; false: faces y = h
  double zero = 0, scale = 1;
};

struct TrueClamping {
  Vec3 angle{}, offset{};
};

inline Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Rotates p about x, then y, then z.
inline Vec3 turned(const Vec3& angle, const Vec3& p) {
  Vec3 q = p;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double c = std::cos(angle[k]), s = std::sin(angle[k]), a = q[i], b = q[j];
    q[i] = c * a - s * b;
    q[j] = s * a + c * b;
  }
  return q;
}

inline double reading(const TrueProbe& probe, const TrueClamping& clamping, const Vec3& travel) {
  constexpr double h = 0.015;
  std::array<Vec3, 3> corners = {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}};
  if (!probe.top) corners = {{{0, h, 0}, {0.01, h, 0}, {0, h, 0.01}}};
  for (Vec3& corner : corners) {
    corner = turned(clamping.angle, corner);
    for (std::size_t k = 0; k < 3; ++k) corner[k] += clamping.offset[k] + travel[k];
  }
  const Vec3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const double s = dot(normal, minus(corners[0], probe.place)) / dot(normal, probe.way);
  return probe.scale * s + probe.zero;
}

struct TiltedTarget {
  std::vector<TrueProbe> probes;
  std::vector<TrueClamping> clampings;
  double noise_m = 10e-9, range_m = 200e-6, reach_m = 4e-3;
  int stops = 5;
  std::vector<Axis> travels = {Axis::x, Axis::y};

  // The default fixture, mounted by hand. The arguments are the standard uncertainties of the
  // positions, directions and zeros of its probes.
  TiltedTarget(std::mt19937_64& rng, double u_place_m, double u_way_rad, double u_zero_m) {
    const std::array<Vec3, 5> places = {
        {{.01, 0, 0}, {0, .01, 0}, {0, -.01, 0}, {0, .015, .02}, {.01, .015, .02}}};
    std::normal_distribution<> normal;
    for (std::size_t k = 0; k < places.size(); ++k) {
      TrueProbe p{places[k], k < 3 ? Vec3{0, 0, 1} : Vec3{0, 1, 0}, k < 3, 0, 1};
      const std::size_t across = k < 3 ? 1 : 2;
      p.place[0] += u_place_m * normal(rng);
      p.place[across] += u_place_m * normal(rng);
      p.way[0] = u_way_rad * normal(rng);
      p.way[across] = u_way_rad * normal(rng);
      const double length = std::sqrt(dot(p.way, p.way));
      for (double& x : p.way) x /= length;
      p.zero = u_zero_m * normal(rng);
      probes.push_back(p);
    }
  }

  // Clamps the target n times, at pairs of opposite tilts. The axis of the tilt differs from pair
  // to pair.
  void clamp(int n, double tilt_rad, std::mt19937_64& rng) {
    const std::array<Vec3, 6> tilts = {
        {{1, 1, 1}, {-1, -1, -1}, {1, -1, -1}, {-1, 1, 1}, {-1, 1, -1}, {1, -1, 1}}};
    std::uniform_real_distribution<> away(-10e-6, 10e-6), more(0.9, 1.0);
    for (int i = 0; i < n; ++i) {
      TrueClamping c;
      for (std::size_t k = 0; k < 3; ++k) {
        c.angle[k] = tilts[static_cast<std::size_t>(i) % 6][k] * tilt_rad * more(rng);
        c.offset[k] = away(rng);
      }
      // The side probes are 20 mm above the axis. The offset keeps the target in their range.
      const Vec3 side = turned(c.angle, {0.005, 0.015, 0.02}), top = turned(c.angle, {0.003, 0, 0});
      c.offset[1] -= side[1] - 0.015;
      c.offset[2] -= top[2];
      clampings.push_back(c);
    }
  }

  std::vector<algo::Clamping> logs(std::mt19937_64& rng) const {
    std::normal_distribution<> normal;
    std::vector<algo::Clamping> all;
    for (const TrueClamping& clamping : clampings) {
      algo::Clamping logs;
      for (const Axis axis : travels) {
        algo::Traverse traverse{axis, {}};
        for (int i = 0; i < stops; ++i) {
          const double at = reach_m * (2.0 * i / (stops - 1) - 1);
          Vec3 travel{};
          travel[static_cast<std::size_t>(axis)] = at;
          algo::TraverseStop stop{at + 0.1, {}, {}};
          for (const TrueProbe& p : probes) {
            const double s = reading(p, clamping, travel);
            const bool in_range = std::abs(s) < range_m / 2;
            stop.reading_m.push_back(in_range ? s + noise_m * normal(rng) : std::nan(""));
            stop.u_reading_m.push_back(noise_m);
          }
          traverse.stops.push_back(stop);
        }
        logs.traverses.push_back(traverse);
      }
      all.push_back(logs);
    }
    return all;
  }
};

inline std::string mounting_rig_toml(const std::string& of_probes, double range_um = 200) {
  std::string text = rig_x_toml();
  const std::string range = "range_um = 200\n";
  for (auto at = text.find(range); at != std::string::npos; at = text.find(range, at + 1))
    text.replace(at, range.size(), of_probes + "range_um = " + std::to_string(range_um) + "\n");
  return text;
}

}  // namespace mdof::test
