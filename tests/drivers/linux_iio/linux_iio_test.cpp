#include "drivers/linux_iio/linux_iio.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "drivers/linux_iio/configure.h"
#include "drivers/linux_iio/simulated_linux_iio.h"
#include "tests/drivers/collect.h"

namespace mdof::drivers {
namespace {

TEST(Ad7746, ConvertsCountsToPicofarads) {
  EXPECT_EQ(ad7746_pF(0, 0), 0);
  EXPECT_EQ(ad7746_pF(-8'388'608, 0), -4.096);
  EXPECT_DOUBLE_EQ(ad7746_pF(1'000'000, 0), 0.48828125);
  // 127 steps of the CAPDAC are 21 pF.
  EXPECT_NEAR(ad7746_pF(0, 127 * 338'646), 21, 1e-4);
}

TEST(GapLaw, PlateLawGivesTheGap) {
  const GapLaw law{5, 0.25, {}};
  // eps0 · 5 mm² / 20 µm = 2.213546954700 pF
  const SysfsReading reading = gap_um(law, 2.2135469547 + 0.25);
  EXPECT_NEAR(reading.value, 20, 1e-9);
  EXPECT_EQ(reading.quality, Quality::good);
  for (const double pF : {0.25, 0.1, -3.0}) {
    EXPECT_TRUE(std::isnan(gap_um(law, pF).value));
    EXPECT_EQ(gap_um(law, pF).quality, Quality::over_range);
  }
}

TEST(GapLaw, TableKeepsItsEndValuesBeyondItsEnds) {
  const GapLaw law{0, 0, {{1, 90}, {2, 45}, {3, 30}}};
  EXPECT_EQ(gap_um(law, 1).value, 90);
  EXPECT_EQ(gap_um(law, 1.5).value, 67.5);
  EXPECT_EQ(gap_um(law, 2).value, 45);
  EXPECT_EQ(gap_um(law, 3).value, 30);
  EXPECT_EQ(gap_um(law, 3).quality, Quality::good);
  EXPECT_EQ(gap_um(law, 0.9).value, 90);
  EXPECT_EQ(gap_um(law, 0.9).quality, Quality::over_range);
  EXPECT_EQ(gap_um(law, 3.1).value, 30);
  EXPECT_EQ(gap_um(law, 3.1).quality, Quality::over_range);
}

TEST(GapLaw, InterpolationErrorIsAsStatedInTheManual) {
  GapLaw table;
  const GapLaw plate{5, 0, {}};
  const double step_pF = 0.07;
  for (double pF = 1.4; pF < 4; pF += step_pF) table.table.push_back({pF, gap_um(plate, pF).value});
  for (double pF = 1.41; pF < 3.9; pF += 0.01) {
    const double gap = gap_um(plate, pF).value;
    // Bound of the manual: gap · (step / C)² / 4. C is the capacitance at the beginning of the
    // interval.
    const double bound = gap * std::pow(step_pF / (pF - step_pF), 2) / 4;
    ASSERT_LE(std::abs(gap_um(table, pF).value - gap), 1.2 * bound) << pF;
  }
}

TEST(Ad7746, ReadingsAtTheEndsOfTheRangeAreOverRange) {
  const GapLaw law{5, 0, {}};
  EXPECT_EQ(ad7746_gap_um(law, 8'388'607, 0).quality, Quality::over_range);
  EXPECT_EQ(ad7746_gap_um(law, -8'388'608, 43'008'000).quality, Quality::over_range);
  EXPECT_EQ(ad7746_gap_um(law, 8'388'606, 0).quality, Quality::good);
}

class LinuxIio : public testing::Test {
 protected:
  LinuxIio() {
    options_.sysfs_root = root_.string();
    options_.rate_hz = 20;
    options_.sampling_hz = 91;
    options_.channels = {{"A", "capacitance0", 0, ""}};
    options_.laws = {{5, 0, {}}};
    auto tree = make_ad7746_tree(root_);
    EXPECT_TRUE(tree);
    tree_.emplace(*tree);
    options_.read = tree_->reads();
  }
  ~LinuxIio() override { std::filesystem::remove_all(root_); }
  void expect_refused(const std::string& part) {
    const auto status = make_linux_iio("probes", options_)->open();
    ASSERT_FALSE(status) << part;
    EXPECT_NE(status.error().message.find(part), std::string::npos) << status.error().message;
  }
  std::filesystem::path root_ = std::filesystem::temp_directory_path() /
                                ("mdof_linux_iio_test." + std::to_string(::getpid()));
  std::optional<SimulatedTree> tree_;
  LinuxIioOptions options_;
};

TEST_F(LinuxIio, ReadsGapsOfBothKindsOfInputs) {
  options_.channels.push_back({"B", "capacitance1-capacitance3", 0, ""});
  options_.laws.push_back({0, 0, {{-1, 100}, {1, 0}}});
  ASSERT_TRUE(tree_->set("in_capacitance0_raw", "1000000"));
  ASSERT_TRUE(tree_->set("in_capacitance0_offset", "3386460"));
  ASSERT_TRUE(tree_->set("in_capacitance1-capacitance3_raw", "-1024000"));
  const auto driver = make_linux_iio("probes", options_);
  const auto status = driver->open();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(driver->info().channels, (std::vector<Channel>{{"A", Unit::um}, {"B", Unit::um}}));
  const Collected all = collect(*driver, 3);
  ASSERT_EQ(all.scans.size(), 3u) << all.error;
  EXPECT_NEAR(all.scans[0][0], 8.8541878188 * 5 / (4'386'460 * 8.192 / 16'777'216), 1e-9);
  EXPECT_NEAR(all.scans[0][1], 75, 1e-9);
  EXPECT_EQ(all.first_quality(0), Quality::good);
  expect_growing(all.time_ns);
  EXPECT_EQ(read_sysfs((root_ / "bus/iio/devices/iio:device0/in_capacitance_sampling_frequency"))
                ->value(),
            "91");
}

// Runs a test in a child process, either as another user or with a read-only /sys. The child
// process has its own rights and mounts.
constexpr int kNotPossibleHere = 77;

template <class Restrict>
int exit_of_child(const LinuxIioOptions& options, const std::string& part, Restrict restrict) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (!restrict()) ::_exit(kNotPossibleHere);
    const auto status = make_linux_iio("probes", options)->open();
    const bool reported = !status && status.error().message.find(part) != std::string::npos;
    if (!reported && !status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
    ::_exit(reported ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(LinuxIio, RateWithoutPermissionIsRefusedWithTheRule) {
  const auto file = root_ / "bus/iio/devices/iio:device0/in_capacitance_sampling_frequency";
  std::filesystem::permissions(file, std::filesystem::perms(0444));
  constexpr uid_t kNobody = 65534;
  EXPECT_EQ(
      exit_of_child(options_,
                    file.string() + ": Permission denied; members of the group mdof can write",
                    [] { return ::geteuid() != 0 || ::seteuid(kNobody) == 0; }),
      0);
}

TEST_F(LinuxIio, RateInReadOnlySysfsIsRefusedWithTheDropIn) {
  const auto read_only = [this] {
    const char* root = root_.c_str();
    return ::unshare(CLONE_NEWNS) == 0 &&
           ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           ::mount(root, root, nullptr, MS_BIND, nullptr) == 0 &&
           ::mount("none", root, nullptr, MS_BIND | MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  };
  const int exit = exit_of_child(options_, "ReadWritePaths=-/sys/devices", read_only);
  if (exit == kNotPossibleHere) GTEST_SKIP() << "mounting needs root; not tested here";
  EXPECT_EQ(exit, 0);
}

TEST_F(LinuxIio, ReadingWithoutAProbeIsMissing) {
  const auto driver = make_linux_iio("probes", options_);  // the reading is 0 pF
  ASSERT_TRUE(driver->open());
  const Collected all = collect(*driver, 1);
  EXPECT_TRUE(std::isnan(all.scans.at(0)[0]));
  EXPECT_EQ(all.first_quality(0), Quality::missing);
}

TEST_F(LinuxIio, I2cErrorIsReported) {
  options_.rate_hz = 50;
  const auto driver = make_linux_iio("probes", options_);
  ASSERT_TRUE(driver->open());
  tree_->fail_reads(EREMOTEIO);
  EXPECT_NE(collect(*driver, 20).error.find("check the wires, the supply"), std::string::npos);
  tree_->fail_reads(0, 0);
  ASSERT_TRUE(tree_->set("in_capacitance0_raw", "99999999"));
  ASSERT_TRUE(driver->open());
  EXPECT_NE(collect(*driver, 20).error.find("has more than 24 bits"), std::string::npos);
}

TEST_F(LinuxIio, RefusesOtherChips) {
  options_.rate_hz = 91;
  expect_refused("lower rate_hz or raise sampling_hz");
  ASSERT_TRUE(tree_->set("in_capacitance_scale", "0.488"));
  expect_refused("expects 0.000000488 pF");
  ASSERT_TRUE(tree_->set("name", "bme280"));
  expect_refused("is \"bme280\", but must be \"ad7745\" or \"ad7746\"");
  options_.device = "iio:device9";
  expect_refused("to list the devices, run: grep");
}

TEST_F(LinuxIio, Ad7745HasNoSecondInput) {
  options_.channels[0].input = "capacitance1";
  tree_->remove("in_capacitance1_raw");
  expect_refused("in_capacitance1_raw: No such file");
}

std::string configured(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  if (!table) return table.error().message;
  DriverContext context;
  context.name = "probes";
  context.rig.probes.resize(1);
  context.rig.probes[0].id = "A";
  context.rig.probes[0].calibration.reads_stated = true;
  const auto spec = configure_linux_iio(*table, context);
  if (!spec) return spec.error().message;
  const auto driver = spec->make();
  return (*driver)->info().driver;
}

TEST(LinuxIioConfiguration, ReadsKeysAndReportsErrors) {
  const std::string channel = "\n[[channel]]\nid = \"A\"\ninput = \"capacitance0\"\n";
  EXPECT_EQ(configured("sampling_hz = 91\nrate_hz = 50" + channel + "area_mm2 = 5\nstray_pF = 1"),
            "linux_iio");
  EXPECT_EQ(configured(channel + "gap_table = [[1, 90], [2, 45]]"), "linux_iio");
  const std::pair<std::string, const char*> wrong[] = {
      {channel, "area_mm2: is missing"},
      {channel + "area_mm2 = 0", "must be the area"},
      {channel + "gap_table = [[1, 90]]", "at least two rows"},
      {channel + "gap_table = [[2, 90], [1, 45]]", "increasing pF"},
      {channel + "gap_table = [[1, 90], [2, 45]]\narea_mm2 = 5", "contradicts gap_table"},
      {"rate_hz = 1000" + channel + "area_mm2 = 5", "rate_hz: must be from 0.01 to 91"},
      {"sampling_hz = 90" + channel + "area_mm2 = 5", "must be one of 91"},
      {"[[channel]]\nid = \"A\"\ninput = \"voltage0\"\narea_mm2 = 5",
       "no input \"voltage0\"; the inputs of the device are capacitance0"},
  };
  for (const auto& [toml, message] : wrong)
    EXPECT_NE(configured(toml).find(message), std::string::npos) << configured(toml);
}

}  // namespace
}  // namespace mdof::drivers
