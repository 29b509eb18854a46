// Compares file names and numbers with the kernel's driver: torvalds/linux,
// drivers/iio/cdc/ad7746.c.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "drivers/linux_iio/simulated_linux_iio.h"

namespace mdof::drivers {
namespace {

namespace fs = std::filesystem;

std::string line_of(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file) >> std::ws, line);
  return line;
}

TEST(LinuxIioVectors, SimulatedDeviceHasTheKernelsFiles) {
  const fs::path root = fs::temp_directory_path() / ("mdof_ad7746_" + std::to_string(::getpid()));
  ASSERT_TRUE(make_ad7746_tree(root));
  const fs::path device = root / "bus/iio/devices/iio:device0";
  // Files according to ad7746_channels: each channel has RAW, a single input has OFFSET, a
  // differential input has ZEROPOINT. SCALE and SAMP_FREQ are shared by type.
  for (const char* file :
       {"in_capacitance0_raw", "in_capacitance0_offset", "in_capacitance1_raw",
        "in_capacitance1_offset", "in_capacitance0-capacitance2_raw",
        "in_capacitance0-capacitance2_zeropoint", "in_capacitance1-capacitance3_raw",
        "in_capacitance1-capacitance3_zeropoint", "in_capacitance_scale",
        "in_capacitance_sampling_frequency"})
    EXPECT_TRUE(fs::exists(device / file)) << file;
  EXPECT_EQ(line_of(device / "in_capacitance_sampling_frequency_available"),
            "91 84 50 26 16 13 11 9");  // ad7746_cap_samp_freq
  // ad7746_read_raw, IIO_CHAN_INFO_SCALE: 8.192 pF / 2^24. The kernel writes this number with nano
  // resolution.
  EXPECT_EQ(line_of(device / "in_capacitance_scale"), "0.000000488");
  fs::remove_all(root);
}

}  // namespace
}  // namespace mdof::drivers
