#include "drivers/io/serial_settings.h"

namespace mdof::drivers {

void read_serial_settings(TomlTable& table, SerialSettings& line) {
  line.baud = static_cast<int>(table.integer("baud", line.baud));
  if (line.baud < 1) table.reject("baud", "must be a baud rate, such as 19200");
  const std::string parity = table.string("parity", std::string(1, line.parity));
  if (parity == "none" || parity == "even" || parity == "odd" || parity == "N" || parity == "E" ||
      parity == "O")
    line.parity = static_cast<char>(parity[0] & ~0x20);
  else
    table.reject("parity", "must be \"none\", \"even\" or \"odd\"");
  line.stop_bits = static_cast<int>(table.integer("stop_bits", line.stop_bits));
  if (line.stop_bits != 1 && line.stop_bits != 2) table.reject("stop_bits", "must be 1 or 2");
}

}  // namespace mdof::drivers
