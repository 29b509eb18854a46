#include "drivers/registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "drivers/udev_rules.h"
#include "schema/base/files.h"

namespace mdof::drivers {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = fs::path(MDOF_TEST_DATA).parent_path().parent_path();

// Checks that a file has the expected contents. If MDOF_ACCEPT is set, writes them first.
void expect_file(const fs::path& file, const std::string& expected) {
  if (std::getenv("MDOF_ACCEPT")) std::ofstream(kRoot / file) << expected;
  EXPECT_EQ(read_text_file(kRoot / file).value(), expected)
      << file << " does not agree with drivers/registry.cpp; MDOF_ACCEPT=1 writes it anew";
}

// Checks in the same way one table of a file. `head`: the heading lines of this table.
void expect_table(const fs::path& file, const std::string& head, const std::string& rows) {
  const std::string text = read_text_file(kRoot / file).value();
  const std::size_t begin = text.find(head);
  ASSERT_NE(begin, std::string::npos) << file << " has no table " << head;
  const std::size_t end = text.find("\n\n", begin);
  ASSERT_NE(end, std::string::npos);
  expect_file(file, text.substr(0, begin) + head + rows + text.substr(end + 1));
}

std::string code(const std::string& word) {
  return "`" + word + "`";
}

TEST(Registry, RowsAreSortedByName) {
  EXPECT_TRUE(
      std::is_sorted(driver_rows().begin(), driver_rows().end(),
                     [](const auto& a, const auto& b) { return a.name < std::string(b.name); }));
  for (const DriverRow& row : driver_rows()) EXPECT_EQ(find_driver(row.name), &row);
  EXPECT_EQ(find_driver("lab"), nullptr);
}

TEST(Registry, EveryDriverFolderHasACompleteRow) {
  std::set<std::string> folders;
  for (const auto& entry : fs::directory_iterator(kRoot / "drivers"))
    if (fs::exists(entry.path() / "configure.h")) folders.insert(entry.path().filename());
  for (const DriverRow& row : driver_rows()) {
    SCOPED_TRACE(row.name);
    EXPECT_EQ(folders.erase(row.folder), 1U) << "no drivers/" << row.folder << "/configure.h";
    EXPECT_NE(std::string(row.devices), "");
    const fs::path twin =
        kRoot / "drivers" / row.folder / ("simulated_" + std::string(row.folder) + ".h");
    EXPECT_EQ(fs::exists(twin), row.simulated.has_value()) << twin;
  }
  EXPECT_EQ(folders, std::set<std::string>()) << "without a row";
}

TEST(Registry, EveryDriverIsInTheManPageAndALiveTest) {
  const std::string man = read_text_file(kRoot / "daemon/mdofd.toml.5").value();
  const std::string setups = read_text_file(kRoot / "tests/daemon/device_setups.py").value();
  for (const DriverRow& row : driver_rows()) {
    EXPECT_NE(man.find(row.name), std::string::npos) << row.name;
    const bool device = row.simulated || row.node;
    EXPECT_EQ(setups.find("driver = \"" + std::string(row.name) + "\"") != std::string::npos,
              device)
        << row.name;
  }
}

TEST(Registry, ReadmeHasTheTableOfDrivers) {
  std::string rows;
  for (const DriverRow& row : driver_rows())
    rows += "| " + code(std::string(row.folder) + "/") + " | " + code(row.name) + " | " +
            row.devices + " |\n";
  expect_table("drivers/README.md", "| folder | driver | through |\n|---|---|---|\n", rows);
}

TEST(Registry, ReadmeOfMdofSimulateHasTheTableOfKinds) {
  std::string rows;
  for (const DriverRow& row : driver_rows())
    if (row.simulated)
      rows += "| " + code(row.name) + " | " + row.simulated->inputs + " | " +
              row.simulated->reached + " |\n";
  expect_table("tools/mdof_simulate/README.md",
               "| kind | inputs | where it is reached |\n|---|---|---|\n", rows);
}

TEST(UdevRules, FileIsMadeFromTheRows) {
  expect_file("daemon/systemd/60-mdof.rules", udev_rules(driver_rows()));
}

// The udev rules of one fictitious driver; returns the first rule.
std::string rule_for(const LinuxNode& node) {
  const std::string text = udev_rules({{"made_up", "made_up", "", nullptr, node}});
  const std::size_t begin = text.find("SUBSYSTEM");
  return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(UdevRules, NewDeviceNeedsOnlyARow) {
  const std::string group = R"(MODE="0660", GROUP="mdof", TAG+="uaccess")";
  EXPECT_EQ(rule_for(UsbDevice{.name = "A", .vendor = 0xABC, .product = 0x12}),
            R"(SUBSYSTEM=="usb", ENV{DEVTYPE}=="usb_device", ATTR{idVendor}=="0abc", )"
            R"(ATTR{idProduct}=="0012", )" +
                group + R"(, SYMLINK+="mdof/$attr{serial}")");
  EXPECT_EQ(
      rule_for(UsbDevice{
          .name = "A", .vendor = 0xABC, .product = 0x12, .node = UsbNode::hidraw, .interface = 10}),
      R"(SUBSYSTEM=="hidraw", ATTRS{modalias}=="usb:v0ABCp0012*in0A", )" + group);
  EXPECT_EQ(rule_for(UsbDevice{.name = "A", .vendor = 0xABC, .node = UsbNode::tty}),
            R"(SUBSYSTEM=="tty", ATTRS{idVendor}=="0abc", )" + group);
  EXPECT_EQ(rule_for(ClassDevice{.name = "A", .subsystem = "dac", .group = "io", .remedy = ""}),
            R"(SUBSYSTEM=="dac", KERNEL=="dac[0-9]*", MODE="0660", GROUP="io", TAG+="uaccess")");
}

TEST(UdevRules, RowWithoutANodeHasNoRule) {
  EXPECT_EQ(udev_rules({{"made_up", "made_up", "", nullptr}}), udev_rules({}));
}

}  // namespace
}  // namespace mdof::drivers
