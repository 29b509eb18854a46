// What a Comedi board is configured to do: the keys of its table, checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/linux_comedi/board.h"
#include "schema/sample.h"

namespace mdof::drivers::linux_comedi {

struct InputSetting {
  Channel channel;
  unsigned number = 0;              // CHn
  double low_v = -10, high_v = 10;  // of its range
  Reference reference = Reference::ground;
};

struct Settings {
  std::string name;  // of the device
  std::string device = "/dev/comedi0";
  std::string board;                  // what its name must be; "": any
  std::optional<unsigned> subdevice;  // none: the first with analogue inputs that streams
  double rate_hz = 1000;
  std::optional<double> convert_us;  // from input to input of a scan
  std::vector<InputSetting> inputs;
  EncoderOrigin encoder = {};  // where an input gives its volts
  BoardOpener open = open_board;
};

}  // namespace mdof::drivers::linux_comedi
