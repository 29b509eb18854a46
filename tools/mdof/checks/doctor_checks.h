// What may be wrong with this machine as a measuring PC, and what to do about it.
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
  std::string what;    // one line
  std::string remedy;  // what to do; empty: nothing
};

// The files of the machine, under `root` (/ but for tests).
struct Machine {
  std::filesystem::path root = "/";
  std::filesystem::path at(const char* path) const { return root / path; }
};

// Times of samples: a clock that is slow to read or coarse.
Diagnosis check_clock(const Machine& machine);
// The rules that give the group mdof its devices; wanted where one of them is on USB.
Diagnosis check_udev_rules(const Machine& machine, bool wanted);
// Room and right to write where the database and the recordings go.
Diagnosis check_storage(const daemon::Config& config);
// USB devices of the drivers' rows that are plugged in, and whether this user may open the node
// that the driver opens.
std::vector<Diagnosis> check_usb(const Machine& machine);
// Devices of classes of the kernel in the drivers' rows (boards of Linux Comedi), and whether this
// user may open them.
std::vector<Diagnosis> check_class_devices(const Machine& machine);

// Files of devices in sysfs in the drivers' rows (the rate of a capacitance converter, what a
// counter loads), which mdofd writes where its configuration asks for it: whether the group of its
// service (none: this user) may write them.
std::vector<Diagnosis> check_sysfs_files(const Machine& machine, std::optional<gid_t> service);
// The group that the packaged service is in; none: it is not installed.
std::optional<gid_t> service_group();

// What the readings of a rig's probes cannot reveal, and the check by hand that can; of rigs with
// more than five probes what their residuals reveal.
Diagnosis check_set_up(const Rig& rig);

const char* to_string(Diagnosis::Level level);  // "ok", "doubtful", "WRONG"

}  // namespace mdof::tools
