// Stops of logs that are slower than 20 Hz, with a rig that declares delays.
#include "daemon/measure/stops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "schema/rig/rig.h"

namespace mdof::daemon {
namespace {

constexpr double kStop_s = 20, kTravel_s = 2;
constexpr int kStops = 4;

// The axis stops at 0, 1, 2 and 3 mm; negative times are the first stop.
double travel_mm(double t_s) {
  const double step = std::floor(std::max(t_s, 0.0) / (kStop_s + kTravel_s));
  const double since_s = std::max(t_s, 0.0) - step * (kStop_s + kTravel_s);
  return std::min(step + std::max(0.0, since_s - kStop_s) / kTravel_s, kStops - 1.0);
}

// Each probe reads 1 µm per mm of travel, `late_s` after the axis was there.
std::string write_log(double rate_hz, double late_s) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("mdof-stops-" + std::to_string(::getpid()) + ".csv");
  std::ofstream csv(path);
  csv << "time_s,encoder_mm,A_um,B_um,C_um,D_um,E_um\n";
  csv.precision(9);
  for (int i = 0; i < kStops * (kStop_s + kTravel_s) * rate_hz; ++i) {
    const double t_s = i / rate_hz, read_um = travel_mm(t_s - late_s);
    csv << t_s << ',' << travel_mm(t_s);
    for (int probe = 0; probe < 5; ++probe) csv << ',' << read_um;
    csv << '\n';
  }
  return path;
}

TEST(Stops, DelaysOfSlowLogsAreCorrected) {
  Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  for (const double rate_hz : {1.0, 5.0, 10.0, 200.0})
    for (const double delay_s : {0.003, 0.03}) {
      for (Probe& probe : rig.probes) probe.delay_s = delay_s;
      const std::string path = write_log(rate_hz, delay_s);
      const auto found = read_stops(path, Axis::x, rig);
      std::filesystem::remove(path);
      ASSERT_TRUE(found) << rate_hz << " Hz: " << found.error().message;
      ASSERT_EQ(found->stops.size(), kStops) << rate_hz << " Hz";
      for (int k = 0; k < kStops; ++k)
        for (const double reading_m : found->stops[static_cast<std::size_t>(k)].probe_m)
          EXPECT_NEAR(reading_m, k * 1e-6, 1e-12) << rate_hz << " Hz, " << delay_s << " s";
    }
}

}  // namespace
}  // namespace mdof::daemon
