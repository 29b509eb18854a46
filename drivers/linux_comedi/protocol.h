// Conversions of Comedi's commands, codes and volts. Pure. Sources: Linux-Comedi/comedilib
// demo/cmd.c (prepare_cmd, main), lib/cmd.c (__generic_timed), lib/range.c (comedi_to_phys),
// lib/calib.c (apply_polynomial).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/linux_comedi/board.h"

namespace mdof::drivers::linux_comedi {

const char* name_of(Reference reference);
std::optional<Reference> reference_of(const std::string& name);

// Index of the range with these limits; nullopt: no range has these limits.
std::optional<unsigned> range_index(const std::vector<Range>& ranges, double low_v, double high_v);
std::string text_of(const Range& range);  // "-10 to 10 V"

struct ScanTiming {
  double rate_hz = 0;
  // Time between two inputs; nullopt: simultaneous if the board can do this.
  std::optional<double> convert_us;
};
// Returns a command that scans `inputs` until the command is stopped. `sources`: the sources that
// the board supports. Error: the board has no timer for scans.
Result<Command> timed_command(const Command& sources, unsigned subdevice,
                              const std::vector<BoardInput>& inputs, const ScanTiming& timing);
double rate_of(const Command& command);  // scans per second
// Time between two successive inputs of a scan; 0: simultaneous.
double convert_us(const Command& command);
const char* failed_step(int test);  // comedilib's text for a result of Board::test()

// Divides received bytes into the codes of complete scans. The bytes may arrive in portions of any
// size.
class CodeSplitter {
 public:
  CodeSplitter(std::size_t inputs, bool long_samples);
  // Appends the codes of the scans that end in `bytes`, one scan after the other.
  void take(std::string_view bytes, std::vector<std::uint32_t>& codes);

 private:
  std::size_t inputs_, size_;
  std::string begun_;
};

// Conversion to volts for a board without a calibration file.
Polynomial nominal(const Range& range, std::uint32_t greatest_code);
double volts(std::uint32_t code, const Polynomial& to_volts);
// Whether the code is at an end of the range, where comedi_to_phys returns NaN.
inline bool at_rail(std::uint32_t code, std::uint32_t greatest_code) {
  return code == 0 || code >= greatest_code;
}

}  // namespace mdof::drivers::linux_comedi
