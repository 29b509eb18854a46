// Makes, from the settings, a command for the board and the conversion of the board's codes to
// volts.
#pragma once

#include <string>
#include <vector>

#include "drivers/linux_comedi/board.h"
#include "drivers/linux_comedi/protocol.h"
#include "drivers/linux_comedi/settings.h"
#include "schema/notice/notice.h"

namespace mdof::drivers::linux_comedi {

struct Conversion {  // for one input
  Polynomial to_volts;
  std::uint32_t greatest_code = 0;
};

struct Setup {
  Command command;
  bool long_samples = false;
  std::vector<Conversion> conversions;  // one for each input
  double buffer_s = 0;                  // duration of the data that fit into the kernel's buffer
  std::string description;
  Notices notices;
};

// Errors: the board is not the required one, or the board lacks something that the settings need.
// The message lists what the board supports.
Result<Setup> set_up(Board& board, const Settings& settings);

}  // namespace mdof::drivers::linux_comedi
