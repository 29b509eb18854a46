// A driver as the configuration has it: what a family of devices gets, and what it gives back.
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
  std::string name;  // of the device
  Rig rig;
  ForwardModel forward;   // for the simulator
  std::string base_path;  // folder of the configuration, to which file names are relative
  double settle_s = 0;    // that a stop is given before it counts; 0: not known
  // Who else takes channels of this device. A driver that can give them adds them to its own.
  std::vector<FurtherAxis> further = {};
};

// What a source that is a file knows of itself once it has been read to its end.
struct SourceInfo {
  std::string sha256;
  Notices notices;
};

// A driver as configured, ready to be made on the thread that will own it.
struct DriverSpec {
  std::string driver, name;
  bool live = true;      // samples come as time passes; false: as fast as they are taken
  bool recorded = true;  // its samples go into a recording; false: they come from one
  bool simulated = false;
  std::vector<std::string> channels;  // ids it gives; empty: all of the rig
  EncoderOrigin encoder;              // where it gives one
  std::map<std::string, EncoderOrigin> further_encoders = {};  // of further axes, by channel
  // Of a device of several axes what is for this one. Empty: it is this axis' alone.
  ChannelPart part = {};
  bool of_other_axis = false;  // the table of another axis has its keys; `same_as`
  std::string source_path;     // of a replay
  // The device itself, whatever it is called in the configuration (io/device_lock.h): while a
  // driver that make() made has it open, nobody else opens it. Empty: its bus sees to that.
  std::function<std::string()> identity;
  bool shared = false;  // a device that speaks with several drivers of one program at a time
  std::function<Result<std::unique_ptr<Driver>>()> make;
  std::function<SourceInfo(const Driver&)> source_info;  // of the driver that make() made
};

}  // namespace mdof::drivers
