// Checked settings of a Comedi board, from the keys of its table.
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
  unsigned number = 0;              // n of the input CHn
  double low_v = -10, high_v = 10;  // limits of the range
  Reference reference = Reference::ground;
};

struct Settings {
  std::string name;  // name of the device
  std::string device = "/dev/comedi0";
  std::string board;  // required name of the board; "": any board
  // Nullopt: the first subdevice that can stream analogue inputs.
  std::optional<unsigned> subdevice;
  double rate_hz = 1000;
  std::optional<double> convert_us;  // time between two successive inputs of a scan
  std::vector<InputSetting> inputs;
  EncoderOrigin encoder = {};  // valid if an input is the encoder, in volts
  BoardOpener open = open_board;
};

}  // namespace mdof::drivers::linux_comedi
