// Makes a command for the board from the settings, and the conversion of its codes to volts.
#pragma once

#include <string>
#include <vector>

#include "drivers/linux_comedi/board.h"
#include "drivers/linux_comedi/protocol.h"
#include "drivers/linux_comedi/settings.h"
#include "schema/notice/notice.h"

namespace mdof::drivers::linux_comedi {

struct Conversion {  // of an input
  Polynomial to_volts;
  std::uint32_t greatest_code = 0;
};

struct Setup {
  Command command;
  bool long_samples = false;
  std::vector<Conversion> conversions;  // [input]
  double buffer_s = 0;                  // duration that the kernel's buffer holds
  std::string description;
  Notices notices;
};

// Errors: another board, or a board without something that the settings need; the message lists
// what the board has.
Result<Setup> set_up(Board& board, const Settings& settings);

}  // namespace mdof::drivers::linux_comedi
