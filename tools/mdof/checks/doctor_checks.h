// Checks this computer as a measuring PC. Each finding has a remedy.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/measure/configuration/config.h"

namespace mdof::tools {

struct Diagnosis {
  enum class Level { good, doubtful, bad } level = Level::good;
  std::string what;    // One line.
  std::string remedy;  // Empty: nothing has to be done.
};

// File system of the checked computer below `root`. Tests use another root.
struct Machine {
  std::filesystem::path root = "/";
  std::filesystem::path at(const char* path) const { return root / path; }
};

// Checks the clock that gives samples their times: it must be neither slow to read nor coarse.
Diagnosis check_clock(const Machine& machine);
// Checks the udev rules that give the group mdof access to devices. `wanted`: a configured device
// is on USB.
Diagnosis check_udev_rules(const Machine& machine, bool wanted);
// Checks the free space and the write permission where the database and the recordings are stored.
Diagnosis check_storage(const daemon::Config& config);
// Finds the connected USB devices that drivers support. Checks whether this user may open the
// device node that the driver opens.
std::vector<Diagnosis> check_usb(const Machine& machine);
// Finds devices in a class of the kernel (boards of Linux Comedi) that drivers support. Checks
// whether this user may open them.
std::vector<Diagnosis> check_class_devices(const Machine& machine);

// Checks the sysfs files to which mdofd writes settings of a device (the rate of a capacitance
// converter, the load value of a counter): may the group `service` write them? Without a group, the
// function checks the permission of this user.
std::vector<Diagnosis> check_sysfs_files(const Machine& machine, std::optional<gid_t> service);
// Group of the packaged service; none: the service is not installed.
std::optional<gid_t> service_group();

// Describes the faults of a setup that the readings of the rig's probes cannot reveal, and the
// manual check that reveals them. With more than five probes, the residuals reveal some faults.
Diagnosis check_set_up(const Rig& rig);

const char* to_string(Diagnosis::Level level);  // "ok", "doubtful", "WRONG"

}  // namespace mdof::tools
