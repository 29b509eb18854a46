// Settings of a Comedi board: the checked keys of its table.
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
  std::string board;                  // required name of the board; "": any
  std::optional<unsigned> subdevice;  // nullopt: the first that streams analogue inputs
  double rate_hz = 1000;
  std::optional<double> convert_us;  // time from input to input of a scan
  std::vector<InputSetting> inputs;
  EncoderOrigin encoder = {};  // if an input is the encoder, in volts
  BoardOpener open = open_board;
};

}  // namespace mdof::drivers::linux_comedi
