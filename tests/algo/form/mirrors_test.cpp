// Simulates the mirror of the paper, 295 x 95 mm with pixels of 0.66 mm, from the clamping over the
// passes to the release. The results are distributions over many mirrors. MDOF_MIRRORS is the
// number of mirrors: by default 3; the campaign uses 200 and checks the limits. The random share is
// assumed to be drift over the hours of a pass, so its waves are as long as those of the other
// shares. Its contribution to the PV depends on this assumption (tests/CAMPAIGNS.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "algo/form/clamping.h"
#include "algo/form/cutting.h"
#include "algo/form/map_figures.h"

namespace mdof::algo {
namespace {

// RMS in um from the maps of the paper. Numbers that the paper does not state are calculated from
// the maps (README.md).
constexpr double kBefore = 0.467, kClamping = 0.934, kCutting = 0.296, kRelease = 0.074,
                 kRandom = 0.048, kNoise = 0.003, kBeforeWithClamping = -0.414,
                 kCuttingWithClamping = -0.131, kFig17 = 0.064;
// Smoothing of the correction, whose waves are 50 mm and longer.
constexpr double kSmooth_m = 10e-3;

class Mirror {
 public:
  explicit Mirror(unsigned seed) : engine_(seed) {}

  // A map with an RMS of 1 um and without a plane. Its waves have all directions and lengths from
  // least_mm to most_mm.
  SurfaceMap waves(double least_mm, double most_mm) {
    SurfaceMap map = blank();
    std::vector<double> cx(map.nx), sx(map.nx);
    for (int wave = 0; wave < 60; ++wave) {
      const double length = least_mm * std::pow(most_mm / least_mm, uniform_(engine_)),
                   way = 2 * std::numbers::pi * uniform_(engine_),
                   phase = 2 * std::numbers::pi * uniform_(engine_), size = normal_(engine_),
                   kx = 2 * std::numbers::pi / length * 0.66 * std::cos(way),
                   ky = 2 * std::numbers::pi / length * 0.66 * std::sin(way);
      for (std::size_t i = 0; i < map.nx; ++i) {
        cx[i] = size * std::cos(kx * static_cast<double>(i) + phase);
        sx[i] = size * std::sin(kx * static_cast<double>(i) + phase);
      }
      for (std::size_t j = 0; j < map.ny; ++j) {
        const double c = std::cos(ky * static_cast<double>(j)),
                     s = std::sin(ky * static_cast<double>(j));
        for (std::size_t i = 0; i < map.nx; ++i) map.z_m[j * map.nx + i] += c * cx[i] - s * sx[i];
      }
    }
    return normed(map);
  }
  // A map with an RMS of 1 um and the given correlation to `other`, which also has an RMS of 1 um.
  SurfaceMap correlated(SurfaceMap map, const SurfaceMap& other, double correlation) {
    add(map, other, -product(map, other));
    map = normed(map);
    SurfaceMap result = blank();
    add(result, other, correlation);
    add(result, map, std::sqrt(1 - correlation * correlation));
    return normed(result);
  }
  SurfaceMap measured(SurfaceMap map) {
    const double tilt = normal_(engine_), piston = normal_(engine_);
    for (std::size_t k = 0; k < map.z_m.size(); ++k)
      map.z_m[k] += 1e-6 * (kNoise * normal_(engine_) + piston +
                            tilt * static_cast<double>(k % map.nx) / static_cast<double>(map.nx));
    return map;
  }
  // A measurement of a part that remains clamped, so no tilt is added.
  SurfaceMap measured_in_place(SurfaceMap map) {
    for (double& z : map.z_m) z += 1e-6 * kNoise * normal_(engine_);
    return map;
  }
  static void add(SurfaceMap& to, const SurfaceMap& map, double factor) {
    for (std::size_t k = 0; k < to.z_m.size(); ++k) to.z_m[k] += factor * map.z_m[k];
  }
  static SurfaceMap sum(SurfaceMap a, const SurfaceMap& b, double factor = 1) {
    add(a, b, factor);
    return a;
  }
  static SurfaceMap times(const SurfaceMap& map, double factor) {
    return sum(blank(), map, factor);
  }
  static double rms_um(const SurfaceMap& map) { return figures_of(map).rms_m * 1e6; }

 private:
  static SurfaceMap blank() {
    SurfaceMap map{"mirror", 0, 0, 0.66e-3, 0.66e-3, 447, 144, {}, {}};
    map.z_m.assign(map.nx * map.ny, 0.0);
    return map;
  }
  static SurfaceMap normed(SurfaceMap map) {
    remove_plane(map);
    return times(map, 1 / rms_um(map));
  }
  static double product(const SurfaceMap& a, const SurfaceMap& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.z_m.size(); ++k) sum += a.z_m[k] * b.z_m[k];
    return sum * 1e12 / static_cast<double>(a.z_m.size());
  }
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

using Figures = std::map<std::string, std::vector<double>>;

void note(Figures& figures, const std::string& name, const SurfaceMap& map) {
  SurfaceMap flat = map;
  remove_plane(flat);
  figures[name + " RMS"].push_back(figures_of(flat).rms_m * 1e6);
  figures[name + " PV"].push_back(figures_of(flat).pv_m * 1e6);
}

// Simulates four passes and returns the error of each cut relative to `wanted`. `second` is set to
// the cut of the second pass.
std::vector<SurfaceMap> passes(Mirror& mirror, const SurfaceMap& wanted, const SurfaceMap& repeats,
                               const std::vector<SurfaceMap>& random, CuttingGain gain,
                               SurfaceMap& second, double smooth_m = 0) {
  CuttingPasses request{wanted, {}, false, gain, smooth_m, 1e-6 * kRandom};
  SurfaceMap path = wanted;
  std::vector<SurfaceMap> errors;
  for (std::size_t k = 0; k < random.size(); ++k) {
    const SurfaceMap cut = Mirror::sum(Mirror::sum(path, repeats), random[k]);
    errors.push_back(Mirror::sum(cut, wanted, -1));
    if (k == 1) second = cut;
    request.cuts.push_back(mirror.measured_in_place(cut));
    path = next_cut(request)->next;
  }
  return errors;
}

void simulate_paper_mirror(unsigned seed, Figures& figures) {
  Mirror mirror(seed);
  const SurfaceMap shape = mirror.waves(60, 400), before = Mirror::times(shape, kBefore);
  const SurfaceMap bent = mirror.correlated(mirror.waves(70, 400), shape, kBeforeWithClamping),
                   clamping = Mirror::times(bent, kClamping);
  const double share = std::sqrt(kCutting * kCutting - kRandom * kRandom);
  const SurfaceMap repeats =
      Mirror::times(mirror.correlated(mirror.waves(50, 300), bent, kCuttingWithClamping), share);
  const SurfaceMap release = Mirror::times(mirror.waves(30, 200), kRelease);
  std::vector<SurfaceMap> random;
  for (int k = 0; k < 4; ++k) random.push_back(mirror.waves(80, 400));
  note(figures, "8 the same, passes drawn alone",
       Mirror::times(Mirror::sum(random[1], random[0], -1), kRandom));
  // Passes have only the repeatable share in common. The random shares are uncorrelated in each
  // mirror and not just on average, so their difference is sqrt(2) sigma.
  for (std::size_t k = 1; k < 4; ++k)
    for (std::size_t j = 0; j < k; ++j) random[k] = mirror.correlated(random[k], random[j], 0);
  for (SurfaceMap& pass : random) pass = Mirror::times(pass, kRandom);

  // The form of the clamped part and the first path are calculated from measured maps.
  const SurfaceMap after = Mirror::sum(before, clamping);
  const SurfaceMap wanted =
      clamping_by_K(mirror.measured(before), mirror.measured(after), 0)->elastic;
  note(figures, "1 before clamping", before);
  note(figures, "2 after clamping", after);
  note(figures, "3 clamping", wanted);
  SurfaceMap second, unused;
  const auto one = passes(mirror, wanted, repeats, random, CuttingGain::one, second);
  const auto mean = passes(mirror, wanted, repeats, random, CuttingGain::mean, unused);
  const auto smooth =
      passes(mirror, wanted, repeats, random, CuttingGain::optimal, unused, kSmooth_m);
  note(figures, "4 first machining", Mirror::sum(wanted, one[0]));
  note(figures, "5 cutting error", one[0]);
  note(figures, "6 second machining", second);
  note(figures, "8 cutting error, second", one[1]);
  note(figures, "8 the same, smoothed, optimal gain", smooth[1]);
  note(figures, "8 the same, repeatable error known exactly", random[1]);
  note(figures, "8 the same, at the RMS of Fig. 17",
       Mirror::times(one[1], kFig17 / Mirror::rms_um(one[1])));
  for (std::size_t k = 1; k < 4; ++k) {
    figures["gain 1, pass " + std::to_string(k + 1) + " RMS"].push_back(Mirror::rms_um(one[k]));
    figures["mean, pass " + std::to_string(k + 1) + " RMS"].push_back(Mirror::rms_um(mean[k]));
  }
  for (int k = 0; k < 3; ++k)  // Table 2 of the paper
    note(figures, "repeated cut", Mirror::sum(repeats, random[static_cast<std::size_t>(k)]));
  // On release the part springs back by the clamping deformation; the effect of the release is
  // added.
  const SurfaceMap spring = Mirror::sum(clamping, release);
  SurfaceMap released = Mirror::sum(second, spring, -1);
  remove_plane(released);
  note(figures, "7 final", released);
  SurfaceMap by_release = Mirror::sum(released, one[1], -1);
  remove_plane(by_release);
  figures["clamping taken out"].push_back(1 - Mirror::rms_um(by_release) / Mirror::rms_um(spring));
  figures["share of the release in the final square"].push_back(
      std::pow(Mirror::rms_um(by_release) / Mirror::rms_um(released), 2));
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1) + 0.5)];
}

double average(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

TEST(Mirrors, ReproduceThePaper) {
  const char* const asked = std::getenv("MDOF_MIRRORS");
  const unsigned mirrors = asked ? static_cast<unsigned>(std::atoi(asked)) : 3;
  ASSERT_GT(mirrors, 0u);
  Figures figures;
  for (unsigned k = 0; k < mirrors; ++k) simulate_paper_mirror(1000 + k, figures);
  std::printf("%-44s %8s %8s %8s\n", "", "mean", "5 %", "95 %");
  for (const auto& [name, values] : figures)
    std::printf("%-44s %8.4f %8.4f %8.4f\n", name.c_str(), average(values), quantile(values, 0.05),
                quantile(values, 0.95));
  // RMS values from the paper.
  const bool is_campaign = mirrors >= 100;
  const double few = is_campaign ? 1 : 4;  // the average of a few mirrors varies more
  EXPECT_NEAR(average(figures["2 after clamping RMS"]), 0.854, 0.002);
  EXPECT_NEAR(average(figures["4 first machining RMS"]), 0.942, 0.004 * few);
  EXPECT_NEAR(average(figures["6 second machining RMS"]), 0.925, 0.014 * few);
  EXPECT_NEAR(average(figures["7 final RMS"]), 0.098, 0.004 * few);
  EXPECT_GE(quantile(figures["clamping taken out"], 0.05), 0.9);
  // With gain 1 a third pass does not reduce the error. With the mean of three passes it does.
  EXPECT_NEAR(average(figures["gain 1, pass 3 RMS"]), 0.068, 0.002 * few);
  EXPECT_NEAR(average(figures["gain 1, pass 4 RMS"]), 0.068, 0.002 * few);
  EXPECT_NEAR(average(figures["mean, pass 4 RMS"]), 0.0554, 0.0006 * 2 * few);
  const auto within = [&](const char* name) {
    const auto& pv = figures[name];
    return 100.0 *
           static_cast<double>(
               std::count_if(pv.begin(), pv.end(), [](double x) { return x <= 0.4; })) /
           static_cast<double>(mirrors);
  };
  const double share = within("8 cutting error, second PV");
  std::printf("second cutting error PV <= 0.4 um in %.1f %% of %u mirrors; drawn alone %.1f %%\n",
              share, mirrors, within("8 the same, passes drawn alone PV"));
  const double smooth = within("8 the same, smoothed, optimal gain PV");
  std::printf("smoothed over 10 mm, with the optimal gain: in %.1f %%\n", smooth);
  // The best linear estimate of the repeatable error from one pass, which knows the spectra of both
  // shares, reaches 89 % (tests/CAMPAIGNS.md).
  const double known = within("8 the same, repeatable error known exactly PV");
  std::printf("with an oracle that knows the repeatable error exactly: in %.1f %%\n", known);
  const double at_fig_17 = within("8 the same, at the RMS of Fig. 17 PV");
  std::printf("at the RMS that the paper has left, 0.064 um, in %.1f %%\n", at_fig_17);
  if (!is_campaign) return;
  // Gain 1 cuts the noise of each pixel, 3 nm, into the part, which increases the PV. The
  // difference of two random shares remains with any method (tests/CAMPAIGNS.md).
  EXPECT_GE(share, 80);
  EXPECT_GE(smooth, 86);  // 90 is not reached; the standard deviation for 200 mirrors is 2
  EXPECT_GE(smooth, share);
  EXPECT_GE(known, 98);
  EXPECT_GE(at_fig_17, 90);
  EXPECT_LE(average(figures["mean, pass 4 RMS"]), 0.056);
  EXPECT_GE(average(figures["share of the release in the final square"]), 0.5);
}

}  // namespace
}  // namespace mdof::algo
