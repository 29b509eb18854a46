// Every driver by the name it has in the configuration: one row each in registry.cpp.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/simulator/machine.h"
#include "schema/base/result.h"
#include "schema/base/toml_reader.h"
#include "schema/rig/rig.h"

namespace mdof::drivers {

struct DriverContext {
  std::string name;  // of the device
  Rig rig;
  ForwardModel forward;   // for the simulator
  std::string base_path;  // folder of the configuration, to which file names are relative
  double settle_s = 0;    // that a stop is given before it counts; 0: not known
};

// What a source that is a file knows of itself once it has been read to its end.
struct SourceInfo {
  std::string sha256;
  std::vector<std::string> warnings;
};

// A driver as configured, ready to be made on the thread that will own it.
struct DriverSpec {
  std::string driver, name;
  bool live = true;      // samples come as time passes; false: as fast as they are taken
  bool recorded = true;  // its samples go into a recording; false: they come from one
  bool simulated = false;
  std::vector<std::string> channels;  // ids it gives; empty: all of the rig
  EncoderOrigin encoder;              // where it gives one
  std::string source_path;            // of a replay
  // The device itself, whatever it is called in the configuration (io/device_lock.h): while a
  // driver that make() made has it open, nobody else opens it. Empty: its bus sees to that.
  std::function<std::string()> identity;
  bool shared = false;  // a device that speaks with several drivers of one program at a time
  std::function<Result<std::unique_ptr<Driver>>()> make;
  std::function<SourceInfo(const Driver&)> source_info;  // of the driver that make() made
};

// Reads the driver's keys from `table` (whose `driver` and `name` the caller has taken) and
// finishes it. Errors name file, line and key; for an unknown driver the known ones.
Result<DriverSpec> configure_driver(const std::string& driver, TomlTable& table,
                                    const DriverContext& context);
std::vector<std::string> known_drivers();

// The driver that reads a log: a recording (by its magic), else CSV, plain or gzip.
DriverSpec log_driver(const std::string& name, const std::string& path);

}  // namespace mdof::drivers
