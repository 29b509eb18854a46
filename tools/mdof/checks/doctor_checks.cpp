#include "tools/mdof/checks/doctor_checks.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;
using Level = Diagnosis::Level;

constexpr double kLittleRoom = 1e9;  // bytes: some hours of recording

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

struct Known {
  const char *vendor, *product, *name;  // product "": any
};
constexpr std::array kKnown = {
    Known{"0cd5", "", "LabJack"},
    Known{"09db", "00ea", "MCC USB-1608FS-Plus"},
    Known{"1dc3", "", "PoKeys"},
};

const Known* known(const std::string& vendor, const std::string& product) {
  for (const Known& k : kKnown)
    if (vendor == k.vendor && (*k.product == '\0' || product == k.product)) return &k;
  return nullptr;
}

// "/dev/bus/usb/001/007" of a device's folder in /sys.
fs::path usb_node(const Machine& machine, const fs::path& device) {
  const auto three = [](const std::string& number) {
    return std::string(3 - std::min<std::size_t>(number.size(), 3), '0') + number;
  };
  return machine.at("dev/bus/usb") / three(first_line(device / "busnum")) /
         three(first_line(device / "devnum"));
}

void sort_by_text(std::vector<Diagnosis>& all) {
  std::sort(all.begin(), all.end(),
            [](const Diagnosis& a, const Diagnosis& b) { return a.what < b.what; });
}

}  // namespace

Diagnosis check_clock(const Machine& machine) {
  const std::string source =
      first_line(machine.at("sys/devices/system/clocksource/clocksource0/current_clocksource"));
  if (source.empty()) return {Level::doubtful, "clock source: not known", ""};
  for (const char* slow : {"hpet", "acpi_pm", "jiffies", "pit"}) {
    if (source == slow)
      return {Level::doubtful, "clock source: " + source + ", slow to read and coarse",
              "add tsc=reliable clocksource=tsc to the kernel's command line if the processor has "
              "a constant TSC"};
  }
  return {Level::good, "clock source: " + source, ""};
}

Diagnosis check_udev_rules(const Machine& machine, bool wanted) {
  for (const char* folder : {"etc/udev/rules.d", "usr/lib/udev/rules.d", "lib/udev/rules.d",
                             "usr/local/lib/udev/rules.d"}) {
    if (fs::exists(machine.at(folder) / "60-mdof.rules"))
      return {Level::good, "udev rules: installed in /" + std::string(folder), ""};
  }
  return {
      wanted ? Level::bad : Level::doubtful, "udev rules: not installed",
      "sudo cp daemon/systemd/60-mdof.rules /etc/udev/rules.d/ && sudo udevadm control --reload "
      "&& sudo udevadm trigger"};
}

Diagnosis check_storage(const daemon::Config& config) {
  std::error_code ec;
  fs::path folder = fs::absolute(config.database).parent_path();
  while (!folder.empty() && !fs::exists(folder, ec)) folder = folder.parent_path();
  const std::string what = "storage: " + config.database.string();
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return {Level::doubtful, what + ": this user may not write in " + folder.string(),
            "right for mdofd's own user is enough; run mdof doctor as that user to be sure"};
  const auto room = fs::space(folder, ec);
  if (!ec && static_cast<double>(room.available) < kLittleRoom)
    return {Level::bad, what + ": less than 1 GB of room", "make room, or move the database"};
  return {Level::good, what, ""};
}

std::vector<Diagnosis> check_usb(const Machine& machine) {
  std::vector<Diagnosis> all;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(machine.at("sys/bus/usb/devices"), ec)) {
    const fs::path& device = entry.path();
    const Known* k = known(first_line(device / "idVendor"), first_line(device / "idProduct"));
    if (!k) continue;
    const fs::path node = usb_node(machine, device);
    const std::string what =
        std::string("USB: ") + k->name + ", serial " + first_line(device / "serial");
    if (::access(node.c_str(), R_OK | W_OK) == 0) {
      all.push_back({Level::good, what, ""});
    } else {
      all.push_back({Level::bad, what + ": no permission for " + node.string(),
                     "install the udev rules (above) and plug it in again, or add yourself to the "
                     "group: sudo usermod -aG mdof $USER, then log in anew"});
    }
  }
  sort_by_text(all);
  return all;
}

std::vector<Diagnosis> check_comedi(const Machine& machine) {
  std::vector<Diagnosis> all;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(machine.at("sys/class/comedi"), ec)) {
    const std::string board = entry.path().filename().string();
    if (board.find('_') != std::string::npos) continue;  // comedi0_subd0 is a part of comedi0
    const fs::path node = machine.at("dev") / board;
    if (::access(node.c_str(), R_OK | W_OK) == 0) {
      all.push_back({Level::good, "Comedi board: /dev/" + board, ""});
    } else {
      all.push_back(
          {Level::bad, "Comedi board: no permission for /dev/" + board,
           "sudo usermod -aG iocard $USER, then log in anew; the rules of libcomedi0 give "
           "boards to that group"});
    }
  }
  sort_by_text(all);
  return all;
}

const char* to_string(Level level) {
  return level == Level::good ? "ok" : level == Level::doubtful ? "doubtful" : "WRONG";
}

}  // namespace mdof::tools
