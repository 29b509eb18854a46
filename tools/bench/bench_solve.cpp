// Compares the speed of the batch solver with that of copying the same bytes: six input columns and
// five output columns, which are larger than any cache. Limit: the solver has at least half the
// rate of the copy.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "algo/model/small_angle/small_angle.h"
#include "schema/rig/rig.h"

namespace {

using mdof::Model;
constexpr std::size_t kFrames = 4'000'000;
constexpr int kRounds = 7;

const char* const kRig = R"(
name = "default"
axis = "X"
probe = [
  {id = "A", position_mm = [10, 0, 0], measures = "+Z", range_um = 200},
  {id = "B", position_mm = [0, 10, 0], measures = "+Z", range_um = 200},
  {id = "C", position_mm = [0, -10, 0], measures = "+Z", range_um = 200},
  {id = "D", position_mm = [0, 15, 20], measures = "+Y", range_um = 200},
  {id = "E", position_mm = [10, 15, 20], measures = "+Y", range_um = 200},
]
)";

// The shortest time of several rounds, s.
template <class Work>
double best_s(Work work) {
  double best = 1e9;
  for (int i = 0; i < kRounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    best = std::min(best, took.count());
  }
  return best;
}

}  // namespace

int main() {
  const auto rig = mdof::parse_rig(kRig, "default").value();
  const auto f =
      mdof::algo::make_small_angle_fixture(mdof::algo::make_fixture(rig).value()).value();
  std::vector<std::vector<double>> in(6, std::vector<double>(kFrames));
  std::vector<std::vector<double>> out(6, std::vector<double>(kFrames));
  for (std::size_t i = 0; i < kFrames; ++i) {
    for (std::size_t k = 0; k < 6; ++k) in[k][i] = 1e-8 * static_cast<double>((i * (k + 3)) % 5000);
  }
  mdof::algo::BatchIn from{in[0].data(), {}};
  mdof::algo::BatchOut to{};
  for (std::size_t k = 0; k < 5; ++k) {
    from.reading_m[k] = in[k + 1].data();
    to.local[k] = out[k].data();
  }
  // The copy moves the same bytes: it copies five columns and only reads the sixth column, to sum
  // it.
  double sum = 0;
  const double copy_s = best_s([&] {
    for (std::size_t k = 0; k < 5; ++k) std::memcpy(out[k].data(), in[k].data(), 8 * kFrames);
    double partial[8] = {};
    for (std::size_t i = 0; i + 8 <= kFrames; i += 8) {
      for (std::size_t j = 0; j < 8; ++j) partial[j] += in[5][i + j];
    }
    for (const double p : partial) sum += p;
  });
  const double gigabytes = 11.0 * 8.0 * kFrames / 1e9;
  std::printf("copy        %6.2f GB/s for %.2f GB (checksum %g)\n", gigabytes / copy_s, gigabytes,
              sum);
  for (const Model model : {Model::simplified, Model::exact}) {
    const double solve_s = best_s([&] { mdof::algo::solve_batch(model, f, from, to, kFrames); });
    std::printf(
        "%-10s  %6.2f GB/s, %.2f ns a frame; speed relative to the copy %.2f (required 0.50)\n",
        mdof::to_string(model), gigabytes / solve_s, solve_s / kFrames * 1e9, copy_s / solve_s);
  }
  return 0;
}
