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
  ForwardModel forward;  // for the simulator
  // Folder of the configuration file; relative file names start from this folder.
  std::string base_path;
  double settle_s = 0;  // time that the axis needs to settle after it has stopped; 0: not known
  // Further axes whose channels are connected to this device. A driver that supports further axes
  // adds their channels.
  std::vector<FurtherAxis> further = {};
};

// Facts about a source file. They are known after the driver has read the file to its end.
struct SourceInfo {
  std::string sha256;
  Notices notices;
};

// A configured driver. make() must be called on the thread that will own the driver.
struct DriverSpec {
  std::string driver, name;  // configure_driver() sets both
  // true: samples arrive in real time; false: they arrive as fast as they are read.
  bool live = true;
  bool recorded = true;  // true: the samples are recorded; false: they come from a recording
  bool simulated = false;
  std::vector<std::string> channels;  // ids of its channels; empty: all channels of the rig
  EncoderOrigin encoder;              // valid if the device has an encoder
  // For further axes, by the name of the channel.
  std::map<std::string, EncoderOrigin> further_encoders = {};
  // The channels that belong to this axis, if the device serves several axes. Empty: the device
  // serves this axis only.
  ChannelPart part = {};
  // Key `same_as`: the table of another axis contains the keys of this device.
  bool is_declared_elsewhere = false;
  std::string source_path;  // path of the replayed file
  // Identity of the device, independent of its name in the configuration (io/device_lock.h). While
  // a driver that make() created has the device open, no other driver can open the device. Empty:
  // the bus of the device already prevents this.
  std::function<std::string()> identity;
  bool shared = false;  // true: the device serves several drivers of one program at the same time
  std::function<Result<std::unique_ptr<Driver>>()> make;
  // Call it with a driver that make() created.
  std::function<SourceInfo(const Driver&)> source_info = [](const Driver&) { return SourceInfo{}; };
};

// The usual DriverSpec::make: constructs Device with copies of the arguments.
template <class Device, class... Arguments>
std::function<Result<std::unique_ptr<Driver>>()> make_of(Arguments... arguments) {
  return
      [=]() -> Result<std::unique_ptr<Driver>> { return std::make_unique<Device>(arguments...); };
}

}  // namespace mdof::drivers
