// A user's configuration of LinuxCNC: its ini file, and what its HAL files net and add to threads.
// The grammar is that of LinuxCNC's own manual (INI Configuration; HAL TWOPASS, Basic HAL).
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

  const IniEntry* find(const std::string& section, const std::string& key) const;  // the first
  std::vector<const IniEntry*> all(const std::string& section, const std::string& key) const;
  std::string value(const std::string& section, const std::string& key) const;  // empty: none
};

// Errors: those of reading; a line that is neither section, key nor comment; #INCLUDE.
Result<LinuxCncIni> read_linuxcnc_ini(const std::filesystem::path& file);

// [TRAJ]LINEAR_UNITS. Error: neither mm nor inch; it does not name the file.
Result<bool> is_inch_machine(const LinuxCncIni& ini);

struct HalFunction {
  std::string name, thread;
};

struct HalWiring {
  std::map<std::string, std::string> signal_of;  // pin: the signal that it is netted to
  std::vector<HalFunction> functions;            // in the order in which their thread calls them
  std::vector<std::string> not_read;             // Tcl files, LIB: files

  std::string signal(const std::string& pin, const std::string& otherwise) const;
};

// HALFILE and POSTGUI_HALFILE but the one named `leave_out`. Errors: those of reading; an addf
// whose place cannot be known.
Result<HalWiring> read_hal_files(const LinuxCncIni& ini, const std::string& leave_out);

}  // namespace mdof::tools
