// Commands, codes and volts of Comedi. Pure. Sources: Linux-Comedi/comedilib demo/cmd.c
// (prepare_cmd, main), lib/cmd.c (__generic_timed), lib/range.c (comedi_to_phys), lib/calib.c
// (apply_polynomial).
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

// Index of the range with these limits; nullopt: there is none.
std::optional<unsigned> range_index(const std::vector<Range>& ranges, double low_v, double high_v);
std::string text_of(const Range& range);  // "-10 to 10 V"

struct ScanTiming {
  double rate_hz = 0;
  std::optional<double> convert_us;  // time between inputs; nullopt: simultaneous if possible
};
// A command that scans `inputs` until it is stopped. `sources`: the sources that the board
// supports. Error: the board has no timer for scans.
Result<Command> timed_command(const Command& sources, unsigned subdevice,
                              const std::vector<BoardInput>& inputs, const ScanTiming& timing);
double rate_of(const Command& command);  // scans a second
// Time from input to input; 0: simultaneous.
double convert_us(const Command& command);
const char* failed_step(int test);  // text of comedilib for a result of Board::test()

// Cuts received bytes of any length into the codes of whole scans.
class CodeSplitter {
 public:
  CodeSplitter(std::size_t inputs, bool long_samples);
  // Appends the codes of the scans that end in `bytes`, scan by scan.
  void take(std::string_view bytes, std::vector<std::uint32_t>& codes);

 private:
  std::size_t inputs_, size_;
  std::string begun_;
};

// Conversion for a board without a calibration file.
Polynomial nominal(const Range& range, std::uint32_t greatest_code);
double volts(std::uint32_t code, const Polynomial& to_volts);
// Whether the code is at an end of the range, where comedi_to_phys returns NaN.
inline bool at_rail(std::uint32_t code, std::uint32_t greatest_code) {
  return code == 0 || code >= greatest_code;
}

}  // namespace mdof::drivers::linux_comedi
