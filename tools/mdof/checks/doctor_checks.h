// Checks whether this computer is ready for measurements. Each diagnosis of a problem states a
// remedy.
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
  std::string what;    // The finding, in one line.
  std::string remedy;  // Empty: nothing has to be done.
};

// The file system of the checked computer. `root` is "/"; tests use another folder.
struct Machine {
  std::filesystem::path root = "/";
  std::filesystem::path at(const char* path) const { return root / path; }
};

// Checks the clock that gives samples their times: its resolution must be fine, and reading it must
// be fast.
Diagnosis check_clock(const Machine& machine);
// Checks the udev rules that permit the group mdof to use devices. `wanted`: the configuration
// contains a device on USB.
Diagnosis check_udev_rules(const Machine& machine, bool wanted);
// Checks the folders of the database and of the recordings: their free space and the permission to
// write.
Diagnosis check_storage(const daemon::Config& config);
// Finds the connected USB devices that mdof has drivers for. Checks whether this user may open the
// device nodes that the drivers open.
std::vector<Diagnosis> check_usb(const Machine& machine);
// Finds the boards of Linux Comedi that mdof has drivers for. Checks whether this user may open
// them.
std::vector<Diagnosis> check_class_devices(const Machine& machine);

// Checks whether the group `service` may write the sysfs files to which mdofd writes settings of a
// device, such as the rate of a capacitance converter or the load value of a counter. If `service`
// is nullopt, checks the permission of this user.
std::vector<Diagnosis> check_sysfs_files(const Machine& machine, std::optional<gid_t> service);
// The group of the packaged service; nullopt: the service is not installed.
std::optional<gid_t> service_group();

// Describes faults of a setup that the readings of its probes cannot show, and how the user can
// check for them. If the rig has more than five probes, the residuals show some of these faults.
Diagnosis check_set_up(const Rig& rig);

const char* to_string(Diagnosis::Level level);  // "ok", "doubtful", "WRONG"

}  // namespace mdof::tools
