#include "tools/mdof/checks/doctor_checks.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

TEST(CheckClassDevices, ChecksEachBoardOfTheKernel) {
  const Machine machine{fs::temp_directory_path() /
                        ("mdof_doctor_checks_test." + std::to_string(::getpid()))};
  EXPECT_TRUE(check_class_devices(machine).empty());
  for (const char* part : {"comedi0", "comedi0_subd0", "comedi1"})
    fs::create_directories(machine.at("sys/class/comedi") / part);
  fs::create_directories(machine.at("dev"));
  std::ofstream(machine.at("dev/comedi1")) << "";  // there is no node for comedi0
  const auto found = check_class_devices(machine);
  fs::remove_all(machine.root);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Diagnosis::Level::good);
  EXPECT_EQ(found[0].what, "Comedi board: /dev/comedi1");
  EXPECT_EQ(found[1].level, Diagnosis::Level::bad);
  EXPECT_EQ(found[1].what, "Comedi board: no permission for /dev/comedi0");
  EXPECT_NE(found[1].remedy.find("iocard"), std::string::npos);
}

// A simulated computer that consists of files: devices in /sys and nodes in /dev. This user may
// open the nodes, or there are no nodes.
class CheckUsb : public testing::Test {
 protected:
  ~CheckUsb() override { fs::remove_all(machine.root); }
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((machine.root / file).parent_path());
    std::ofstream(machine.root / file) << text << "\n";
  }
  void plug(const fs::path& place, const std::string& vendor, const std::string& product,
            const std::string& manufacturer) const {
    const fs::path device = "sys/bus/usb/devices" / place;
    write(device / "idVendor", vendor);
    write(device / "idProduct", product);
    write(device / "manufacturer", manufacturer);
    write(device / "serial", "77");
    write(device / "busnum", "1");
    write(device / "devnum", "9");
  }
  const Machine machine{fs::temp_directory_path() /
                        ("mdof_check_usb_test." + std::to_string(::getpid()))};
};

TEST_F(CheckUsb, ChecksTheNodeThatTheDriverOpens) {
  plug("1-1", "0cd5", "0006", "LabJack");
  plug("1-2", "1dc3", "1001", "PoLabs");
  plug("1-3", "0403", "6001", "US Digital");
  write("dev/bus/usb/001/009", "");
  // A keyboard.
  write("sys/bus/usb/devices/1-2/1-2:1.0/0003:1DC3:1001.0001/hidraw/hidraw0/dev", "");
  write("sys/bus/usb/devices/1-2/1-2:1.1/0003:1DC3:1001.0002/hidraw/hidraw1/dev", "");
  write("sys/bus/usb/devices/1-3/1-3:1.0/ttyUSB0/tty/ttyUSB0/dev", "");
  write("dev/ttyUSB0", "");
  const auto found = check_usb(machine);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].what, "USB: LabJack, serial 77");
  EXPECT_EQ(found[1].what,
            "USB: PoKeys, serial 77: no permission for " + machine.at("dev/hidraw1").string());
  EXPECT_NE(found[1].remedy.find("udev rules"), std::string::npos);
  EXPECT_EQ(found[2].what, "USB: US Digital QSB, serial 77");
  EXPECT_EQ(found[0].level, Diagnosis::Level::good);
  EXPECT_EQ(found[1].level, Diagnosis::Level::bad);
  EXPECT_EQ(found[2].level, Diagnosis::Level::good);
}

TEST_F(CheckUsb, IgnoresDevicesOfOtherMakers) {
  plug("1-1", "0403", "6001", "FTDI");  // a QSB has the same chip; this cable is from another maker
  plug("1-2", "09db", "0001", "MCC");
  EXPECT_TRUE(check_usb(machine).empty());
}

TEST_F(CheckUsb, ReportsADeviceWithoutANode) {
  plug("1-2", "1dc3", "1001", "PoLabs");
  const auto found = check_usb(machine);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].what, "USB: PoKeys, serial 77: Linux has no /dev/hidraw for the device");
}

// In the first case the files have the permissions that the udev rules set. In the second case
// they do not.
TEST(CheckSysfsFiles, TheServiceMustBeAbleToWriteTheRate) {
  const Machine machine{fs::temp_directory_path() /
                        ("mdof_doctor_iio_test." + std::to_string(::getpid()))};
  EXPECT_TRUE(check_sysfs_files(machine, std::nullopt).empty());
  const auto device = [&](const char* node, const char* name, fs::perms perms) {
    const fs::path folder = machine.at("sys/bus/iio/devices") / node;
    fs::create_directories(folder);
    std::ofstream(folder / "name") << name << "\n";
    std::ofstream(folder / "in_capacitance_sampling_frequency") << "16\n";
    fs::permissions(folder / "in_capacitance_sampling_frequency", perms);
  };
  using enum fs::perms;
  device("iio:device0", "ad7746", owner_all | group_read | group_write | others_read);
  device("iio:device1", "ad7745", owner_all | group_read | others_read);
  device("iio:device2", "bme280", owner_all);
  const auto mine = check_sysfs_files(machine, ::getegid());
  const auto others = check_sysfs_files(machine, ::getegid() + 1);
  fs::remove_all(machine.root);
  ASSERT_EQ(mine.size(), 2U);
  EXPECT_EQ(mine[0].level, Diagnosis::Level::good);
  EXPECT_EQ(mine[0].what, "IIO converter: iio:device0 (ad7746)");
  EXPECT_EQ(mine[1].level, Diagnosis::Level::doubtful);
  EXPECT_NE(mine[1].what.find("iio:device1 (ad7745): the group mdof has no permission to write"),
            std::string::npos);
  EXPECT_NE(mine[1].what.find("device1/in_capacitance_sampling_frequency"), std::string::npos);
  EXPECT_NE(mine[1].remedy.find("60-mdof.rules"), std::string::npos);
  EXPECT_NE(mine[1].remedy.find("udevadm trigger --action=add --subsystem-match=iio"),
            std::string::npos);
  ASSERT_EQ(others.size(), 2U);
  EXPECT_EQ(others[0].level, Diagnosis::Level::doubtful);
}

// A counter has several files for each count. The check reports the first file that may not be
// written.
TEST(CheckSysfsFiles, EachCountOfACounterMustBeWritable) {
  const Machine machine{fs::temp_directory_path() /
                        ("mdof_doctor_counter_test." + std::to_string(::getpid()))};
  const fs::path counter = machine.at("sys/bus/counter/devices/counter0");
  for (const char* count : {"count0", "count1"}) {
    fs::create_directories(counter / count);
    for (const char* file : {"preset", "preset_enable"}) {
      std::ofstream(counter / count / file) << "0\n";
      fs::permissions(counter / count / file, fs::perms::group_write, fs::perm_options::add);
    }
  }
  std::ofstream(counter / "name") << "104-quad-8\n";
  const auto open = check_sysfs_files(machine, ::getegid());
  fs::permissions(counter / "count1/preset", fs::perms::owner_all);
  const auto closed = check_sysfs_files(machine, ::getegid());
  fs::remove_all(machine.root);
  ASSERT_EQ(open.size(), 1U);
  EXPECT_EQ(open[0].level, Diagnosis::Level::good);
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_EQ(closed[0].level, Diagnosis::Level::doubtful);
  EXPECT_NE(closed[0].what.find("count1/preset; if mdofd.toml contains the key \"index_mm\""),
            std::string::npos);
  EXPECT_NE(closed[0].remedy.find("--subsystem-match=counter"), std::string::npos);
}

}  // namespace
}  // namespace mdof::tools
