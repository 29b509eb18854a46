// What may be wrong with this machine as a measuring PC, and what to do about it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "daemon/measure/config.h"

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
// USB devices known to mdof that are plugged in, and whether this user may open their nodes.
std::vector<Diagnosis> check_usb(const Machine& machine);
// Boards of Linux Comedi that the kernel has, and whether this user may open them.
std::vector<Diagnosis> check_comedi(const Machine& machine);

const char* to_string(Diagnosis::Level level);  // "ok", "doubtful", "WRONG"

}  // namespace mdof::tools
