// Measures a volumetric table with 26 x 26 x 26 nodes: the processor time on one thread to build
// it, and to calculate its correction at one command.
//   bench_volume
#include <cstdio>
#include <ctime>
#include <string>

#include "algo/compensation/volumetric/volumetric.h"

namespace {

constexpr int kRounds = 5;
constexpr int kValues = 1'000'000;

double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// The TOML text of a machine with all errors of X, Y and Z at 21 positions.
std::string description() {
  std::string text =
      "name = \"mill\"\nmachine = {chain = \"w-X-b-Y-Z-t\"}\ntool = {point_mm = [0, 0, 50]}\n";
  for (const char axis : {'X', 'Y', 'Z'}) {
    text += std::string("[[axis]]\nid = \"") + axis +
            "\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n";
    for (const char direction : std::string("XYZABC")) {
      text += std::string("E") + direction + axis + (direction < 'D' ? "_urad = [" : "_um = [");
      for (int i = 0; i <= 20; ++i)
        text += "[" + std::to_string(5 * i) + ", " +
                std::to_string((i * 7 + direction + axis) % 13 - 6) + "],";
      text += "]\n";
    }
    if (axis == 'Y') text += "EC0Y_urad = 40\n";
    if (axis == 'Z') text += "EA0Z_urad = -20\nEB0Z_urad = 30\n";
  }
  return text;
}

}  // namespace

int main() {
  const auto machine = mdof::parse_machine(description(), "bench").value();
  mdof::algo::VolumetricRequest request;
  request.step_m = 0.004;
  const std::clock_t begin = std::clock();
  const auto table = mdof::algo::build_volumetric(machine, request).value();
  const double build_s = seconds_since(begin);
  std::vector<mdof::Vec3> at(kValues);
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      at[i][k] = 0.1 * static_cast<double>((i * (2 * k + 7919)) % 10007) / 10007;
  double best_s = 1e300, sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::clock_t from = std::clock();
    for (const auto& command : at) sum += mdof::algo::volumetric_at(table, command).correction_m[0];
    best_s = std::min(best_s, seconds_since(from));
  }
  std::printf("volume of %zu nodes: built in %.2f s; one value in %.0f ns (checksum %.6g)\n",
              table.nodes(), build_s, best_s / kValues * 1e9, sum);
}
