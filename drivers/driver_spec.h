// A configured driver: the inputs of a driver's configure function and its result.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drivers/channels.h"
#include "drivers/driver.h"
#include "drivers/simulator/machine.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof::drivers {

struct DriverContext {
  std::string name;  // name of the device
  Rig rig;
  ForwardModel forward;   // for the simulator
  std::string base_path;  // folder of the configuration; file names are relative to it
  double settle_s = 0;    // settling time of a stop; 0: not known
  // Further axes that use channels of this device. A driver that supports them adds their channels.
  std::vector<FurtherAxis> further = {};
};

// Facts about a source file, known after the driver has read the file to its end.
struct SourceInfo {
  std::string sha256;
  Notices notices;
};

// A configured driver. make() creates it on the thread that will own it.
struct DriverSpec {
  std::string driver, name;
  bool live = true;      // samples arrive in real time; false: as fast as they are read
  bool recorded = true;  // its samples are recorded; false: they come from a recording
  bool simulated = false;
  std::vector<std::string> channels;  // ids of its channels; empty: all channels of the rig
  EncoderOrigin encoder;              // if it has an encoder
  std::map<std::string, EncoderOrigin> further_encoders = {};  // of further axes, by channel
  // The channels of this axis, if the device serves several axes. Empty: it serves this axis only.
  ChannelPart part = {};
  bool is_declared_elsewhere = false;  // `same_as`: the table of another axis holds its keys
  std::string source_path;             // of a replayed file
  // Identity of the device, independent of its name in the configuration (io/device_lock.h). While
  // a driver that make() created has the device open, no other driver can open it. Empty: the bus
  // of the device ensures this.
  std::function<std::string()> identity;
  bool shared = false;  // the device serves several drivers of one program at a time
  std::function<Result<std::unique_ptr<Driver>>()> make;
  std::function<SourceInfo(const Driver&)> source_info;  // for a driver that make() created
};

}  // namespace mdof::drivers
