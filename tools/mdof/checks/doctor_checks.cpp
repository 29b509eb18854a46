#include "tools/mdof/checks/doctor_checks.h"

#include <glob.h>
#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>

#include "drivers/registry.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;
using Level = Diagnosis::Level;

constexpr double kMinFreeBytes = 1e9;  // bytes; enough for some hours of recording

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// The hexadecimal number in a file; 0: the file does not exist.
unsigned hex_in(const fs::path& file) {
  const std::string text = first_line(file);
  unsigned number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number, 16);
  return number;
}

bool is_usb_device(const drivers::UsbDevice& usb, const fs::path& device) {
  return hex_in(device / "idVendor") == usb.vendor &&
         (!usb.product || hex_in(device / "idProduct") == *usb.product) &&
         (*usb.manufacturer == '\0' || first_line(device / "manufacturer") == usb.manufacturer);
}

// The device node, such as "/dev/bus/usb/001/007", of a USB device with this folder in /sys.
fs::path usb_node(const Machine& machine, const fs::path& device) {
  const auto three = [](const std::string& number) {
    return std::string(3 - std::min<std::size_t>(number.size(), 3), '0') + number;
  };
  return machine.at("dev/bus/usb") / three(first_line(device / "busnum")) /
         three(first_line(device / "devnum"));
}

// The first device node that Linux has made for a device, such as "/dev/hidraw0" or "/dev/ttyUSB0".
// Empty: there is none.
fs::path device_node(const Machine& machine, const fs::path& device,
                     const drivers::UsbDevice& usb) {
  const bool hidraw = usb.node == drivers::UsbNode::hidraw;
  const std::string interface = ":1." + std::to_string(usb.interface) + "/";
  std::set<fs::path> nodes;
  std::error_code ec;
  const auto options = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(device, options, ec)) {
    const fs::path& path = entry.path();
    const bool of_interface = !hidraw || path.string().find(interface) != std::string::npos;
    if (of_interface && path.parent_path().filename() == (hidraw ? "hidraw" : "tty"))
      nodes.insert(machine.at("dev") / path.filename());
  }
  return nodes.empty() ? fs::path() : *nodes.begin();
}

bool may_write(const fs::path& file, std::optional<gid_t> group) {
  struct stat is {};
  if (!group) return ::access(file.c_str(), W_OK) == 0;
  if (::stat(file.c_str(), &is) != 0) return false;
  return (is.st_mode & S_IWOTH) != 0 || (is.st_gid == *group && (is.st_mode & S_IWGRP) != 0);
}

void sort_by_text(std::vector<Diagnosis>& all) {
  std::sort(all.begin(), all.end(),
            [](const Diagnosis& a, const Diagnosis& b) { return a.what < b.what; });
}

Diagnosis check_usb_device(const Machine& machine, const fs::path& device,
                           const drivers::UsbDevice& usb) {
  const std::string what =
      std::string("USB: ") + usb.name + ", serial " + first_line(device / "serial");
  const fs::path node = usb.node == drivers::UsbNode::bus ? usb_node(machine, device)
                                                          : device_node(machine, device, usb);
  if (node.empty())
    return {Level::bad,
            what + ": Linux has no " +
                (usb.node == drivers::UsbNode::tty ? "serial port" : "/dev/hidraw") +
                " for the device",
            "unplug the device and plug it in again; sudo dmesg prints the messages of the kernel "
            "about the device"};
  if (::access(node.c_str(), R_OK | W_OK) == 0) return {Level::good, what, ""};
  return {Level::bad, what + ": no permission for " + node.string(),
          "install the udev rules (above) and plug the device in again, or add yourself to the "
          "group mdof (sudo usermod -aG mdof $USER) and log in again"};
}

Diagnosis check_class_device(const Machine& machine, const std::string& device,
                             const drivers::ClassDevice& of) {
  const std::string what = std::string(of.name) + ": ", node = "/dev/" + device;
  if (::access((machine.at("dev") / device).c_str(), R_OK | W_OK) == 0)
    return {Level::good, what + node, ""};
  return {Level::bad, what + "no permission for " + node, of.remedy};
}

// The files that match the shell patterns in `of`, in the folder of a device.
std::vector<fs::path> files_of(const drivers::SysfsFile& of, const fs::path& device) {
  std::vector<fs::path> files;
  std::istringstream patterns(of.files);
  for (std::string pattern; patterns >> pattern;) {
    glob_t found{};
    if (::glob((device / pattern).c_str(), 0, nullptr, &found) == 0)
      files.insert(files.end(), found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
  }
  return files;
}

// Checks the files of one device. `of` describes the files of a kind of devices. nullopt: the
// device is of another kind, or has no such files.
std::optional<Diagnosis> check_sysfs_device(const fs::path& device, const drivers::SysfsFile& of,
                                            std::optional<gid_t> service) {
  const std::string name = first_line(device / "name"), names = std::string("|") + of.devices + "|";
  const auto files = files_of(of, device);
  if (name.empty() || names.find("|" + name + "|") == std::string::npos || files.empty())
    return std::nullopt;
  const std::string what =
      std::string(of.name) + ": " + device.filename().string() + " (" + name + ")";
  const auto closed = std::find_if(files.begin(), files.end(), [service](const fs::path& file) {
    return !may_write(file, service);
  });
  if (closed == files.end()) return Diagnosis{Level::good, what, ""};
  return Diagnosis{
      Level::doubtful,
      what + ": " + (service ? "the group mdof" : "this user") + " has no permission to write " +
          closed->string() + "; if mdofd.toml contains the key \"" + of.key +
          "\", mdofd has to write this file",
      std::string(
          "install the udev rules (60-mdof.rules, above), which give the group mdof permission to "
          "write this file. If the device was connected before the installation, also run: sudo "
          "udevadm control --reload && sudo udevadm trigger --action=add --subsystem-match=") +
          of.subsystem};
}

}  // namespace

Diagnosis check_clock(const Machine& machine) {
  const std::string source =
      first_line(machine.at("sys/devices/system/clocksource/clocksource0/current_clocksource"));
  if (source.empty()) return {Level::doubtful, "clock source: unknown", ""};
  for (const char* slow : {"hpet", "acpi_pm", "jiffies", "pit"}) {
    if (source == slow)
      return {Level::doubtful, "clock source: " + source + " (slow, with a coarse resolution)",
              "if the processor has a constant TSC, add \"tsc=reliable clocksource=tsc\" to the "
              "kernel command line"};
  }
  return {Level::good, "clock source: " + source, ""};
}

Diagnosis check_udev_rules(const Machine& machine, bool wanted) {
  for (const char* folder : {"etc/udev/rules.d", "usr/lib/udev/rules.d", "lib/udev/rules.d",
                             "usr/local/lib/udev/rules.d"}) {
    if (fs::exists(machine.at(folder) / "60-mdof.rules"))
      return {Level::good, "udev rules: installed in /" + std::string(folder), ""};
  }
  return {wanted ? Level::bad : Level::doubtful, "udev rules: not installed",
          "run: sudo cp daemon/systemd/60-mdof.rules /etc/udev/rules.d/ && sudo udevadm control "
          "--reload && sudo udevadm trigger"};
}

Diagnosis check_storage(const daemon::Config& config) {
  std::error_code ec;
  fs::path folder = fs::absolute(config.database).parent_path();
  while (!folder.empty() && !fs::exists(folder, ec)) folder = folder.parent_path();
  const std::string what = "storage: " + config.database.string();
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return {Level::doubtful, what + ": this user has no permission to write in " + folder.string(),
            "only the user of mdofd needs this permission; to check this permission, run mdof "
            "doctor as that user"};
  const auto room = fs::space(folder, ec);
  if (!ec && static_cast<double>(room.available) < kMinFreeBytes)
    return {Level::bad, what + ": less than 1 GB is free",
            "delete files on this disk, or move the database to another disk"};
  return {Level::good, what, ""};
}

std::vector<Diagnosis> check_usb(const Machine& machine) {
  std::vector<Diagnosis> all;
  for (const drivers::DriverRow& row : drivers::driver_rows()) {
    const auto* usb = row.node ? std::get_if<drivers::UsbDevice>(&*row.node) : nullptr;
    if (!usb) continue;
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(machine.at("sys/bus/usb/devices"), ec))
      if (is_usb_device(*usb, entry.path()))
        all.push_back(check_usb_device(machine, entry.path(), *usb));
  }
  sort_by_text(all);
  return all;
}

std::vector<Diagnosis> check_class_devices(const Machine& machine) {
  std::vector<Diagnosis> all;
  for (const drivers::DriverRow& row : drivers::driver_rows()) {
    const auto* of = row.node ? std::get_if<drivers::ClassDevice>(&*row.node) : nullptr;
    if (!of) continue;
    std::error_code ec;
    for (const auto& entry : fs::directory_iterator(machine.at("sys/class") / of->subsystem, ec)) {
      const std::string device = entry.path().filename().string();
      if (device.find('_') == std::string::npos)  // comedi0_subd0 is a part of comedi0
        all.push_back(check_class_device(machine, device, *of));
    }
  }
  sort_by_text(all);
  return all;
}

std::optional<gid_t> service_group() {
  const struct group* entry = ::getgrnam("mdof");
  return entry ? std::optional<gid_t>(entry->gr_gid) : std::nullopt;
}

std::vector<Diagnosis> check_sysfs_files(const Machine& machine, std::optional<gid_t> service) {
  std::vector<Diagnosis> all;
  for (const drivers::DriverRow& row : drivers::driver_rows()) {
    const auto* of = row.node ? std::get_if<drivers::SysfsFile>(&*row.node) : nullptr;
    if (!of) continue;
    std::error_code ec;
    const fs::path devices = machine.at("sys/bus") / of->subsystem / "devices";
    for (const auto& entry : fs::directory_iterator(devices, ec))
      if (const auto found = check_sysfs_device(entry.path(), *of, service)) all.push_back(*found);
  }
  sort_by_text(all);
  return all;
}

Diagnosis check_set_up(const Rig& rig) {
  const std::string what = "set-up of axis " + std::string(1, letter(rig.axis)) + ": ";
  const char* const remedy =
      "check the set-up once by hand. Push the target along each direction in which probes "
      "measure. The readings of all probes of this direction must change by the length of the "
      "push. The reading of no other probe may change. The change must be positive if the push is "
      "in the direction of the probe (key \"measures\" or \"direction\" in the rig), and negative "
      "if the push is in the opposite direction. Tilt the target by a known angle about each axis. "
      "Move the axis by a known length: the encoder must show this length and direction. To find a "
      "drift that depends on the axis position, measure again with other dwell times, or with "
      "another order of targets";
  const std::string locked =
      "A drift that depends on the position of the axis (heat of drive or scale, pull of cables) "
      "repeats in each run. The errors contain this drift, but u does not. One run cannot separate "
      "this drift from the errors";
  if (rig.probes.size() > 5)
    return {Level::good,
            what + std::to_string(rig.probes.size()) +
                " probes give redundant readings. If one probe is exchanged or turned, or has a "
                "wrong gain or position, the readings contradict each other and mdof warns. A run "
                "does not detect a reversed encoder, a wrong sign or gain of all probes, or a "
                "common scale error of all lengths. " +
                locked,
            remedy};
  return {Level::good,
          what +
              "five probes give no redundant reading, so the readings cannot contradict each "
              "other. The following faults give wrong errors without a warning: exchanged or "
              "turned probes, a wrong sign or gain (of one probe or of all), wrong positions, the "
              "rig of another axis, a reversed encoder. " +
              locked,
          remedy};
}

const char* to_string(Level level) {
  return level == Level::good ? "ok" : level == Level::doubtful ? "doubtful" : "WRONG";
}

}  // namespace mdof::tools
