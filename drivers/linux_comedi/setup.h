// From the settings to a command that a board takes, and to volts of its codes.
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
  double buffer_s = 0;                  // that the kernel's buffer holds
  std::string description;
  Notices notices;
};

// Errors: the board is another, or has not what the settings ask for, with what it has.
Result<Setup> set_up(Board& board, const Settings& settings);

}  // namespace mdof::drivers::linux_comedi
