// Reads a user's configuration of LinuxCNC: the ini file, and the nets and thread functions in the
// HAL files. The syntax is described in the manual of LinuxCNC (INI Configuration; HAL TWOPASS,
// Basic HAL).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::tools {

struct IniEntry {
  std::string section, key, value;
  int line = 0;
};

struct LinuxCncIni {
  std::filesystem::path file;
  std::vector<IniEntry> entries;

  // The first entry with this section and key; nullptr: none.
  const IniEntry* find(const std::string& section, const std::string& key) const;
  std::vector<const IniEntry*> all(const std::string& section, const std::string& key) const;
  // The value of the first entry; empty if there is no entry.
  std::string value(const std::string& section, const std::string& key) const;
};

// Errors: the file cannot be read; a line is neither a section, a key nor a comment; the file uses
// #INCLUDE.
Result<LinuxCncIni> read_linuxcnc_ini(const std::filesystem::path& file);

// Whether [TRAJ]LINEAR_UNITS is inch. Error: it is neither mm nor inch; the message does not name
// the file.
Result<bool> is_inch_machine(const LinuxCncIni& ini);

struct AxisJoint {
  char axis = 'X';
  int number = 0;
};
// The joints of axes X, Y and Z, by axis; a gantry axis has several joints. trivkins assigns the
// letters of its parameter coordinates= to joints 0, 1, 2, ... Error: another kinematics, in which
// a joint is not an axis; the message does not name the file.
Result<std::vector<AxisJoint>> trivkins_joints(const LinuxCncIni& ini);

struct HalFunction {
  std::string name, thread;
};

struct HalWiring {
  std::map<std::string, std::string> signal_of;  // [pin] signal that a net command connects to it
  std::vector<HalFunction> functions;            // In the order of their calls in the thread.
  std::vector<std::string> not_read;  // Files that mdof does not read: Tcl files, LIB: files.

  std::string signal(const std::string& pin, const std::string& otherwise) const;
};

// Reads the files in HALFILE and POSTGUI_HALFILE, except a file named `leave_out`. Errors: a file
// cannot be read; an addf command states an invalid position in its thread.
Result<HalWiring> read_hal_files(const LinuxCncIni& ini, const std::string& leave_out);

}  // namespace mdof::tools
