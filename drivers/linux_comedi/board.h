// Interface to a Comedi board with plain values. libcomedi.cpp implements the interface with
// comedilib; tests implement it without the kernel.
//
// Sources: Linux-Comedi/comedilib (include/comedi.h, include/comedilib.h, lib/cmd.c, lib/calib.c,
// demo/cmd.c) and the kernel's drivers/comedi/comedi_fops.c.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::drivers::linux_comedi {

// Electrical reference of an input: AREF_… in comedi.h.
enum class Reference : std::uint8_t { ground = 0, common = 1, differential = 2, other = 3 };

// Sources of the events of a command: TRIG_… in comedi.h.
enum Source : unsigned { kNone = 0x01, kNow = 0x02, kFollow = 0x04, kTimer = 0x10, kCount = 0x20 };
inline constexpr unsigned kWakeEachScan = 0x20;  // flag of a command: TRIG_WAKE_EOS

struct Subdevice {
  bool analogue_input = false;
  bool streams = false;          // supports commands that read samples
  bool long_samples = false;     // true: samples have 32 bits; false: 16 bits
  bool soft_calibrated = false;  // a calibration file corrects the codes
  unsigned references = 0;       // bit n is set: the Reference with the value n is possible
  unsigned channels = 0;
};

struct Range {
  double low = 0, high = 0;  // in V if `volts` is true
  bool volts = true;
};

// volts = Σ coefficients[i] · (code - origin)^i
struct Polynomial {
  std::array<double, 4> coefficients{};
  double origin = 0;
};

struct BoardInput {
  unsigned channel = 0, range = 0;
  Reference reference = Reference::ground;
};

struct Event {
  // `source`: bit mask of Source. In the result of Board::sources() it contains all sources that
  // the board supports.
  unsigned source = 0, argument = 0;
};
// A comedi_cmd: the board scans the inputs repeatedly.
struct Command {
  unsigned subdevice = 0, flags = 0;
  Event start, scan_begin, convert, scan_end, stop;
  std::vector<BoardInput> inputs;
};

struct Calibration {
  std::string file;  // path at which the file is expected
  bool found = false;
  std::string wrong;  // reason why the existing file is not used
  // One for each input; nullopt: convert with the range of the input.
  std::vector<std::optional<Polynomial>> to_volts;
};

enum class StreamState : std::uint8_t {
  runs,
  // The buffer of the kernel or of the board has overflowed; all data before the overflow were
  // returned.
  overran,
  ended,
};
struct Received {
  std::size_t bytes = 0;
  StreamState stream = StreamState::runs;
};

// An open board. Errors contain the text of comedilib, but not the name of the device.
class Board {
 public:
  virtual ~Board() = default;  // the kernel then ends the command
  virtual std::string driver() const = 0;
  virtual std::string name() const = 0;
  virtual std::vector<Subdevice> subdevices() = 0;
  virtual std::vector<Range> ranges(unsigned subdevice, unsigned channel) = 0;
  // Greatest code of an input; 0: not known.
  virtual std::uint32_t greatest_code(unsigned subdevice, unsigned channel) = 0;
  virtual std::size_t buffer_bytes(unsigned subdevice) = 0;
  // Reads the calibration file. If the hardware has adjustable settings, applies the settings of
  // the file.
  virtual Calibration calibrate(unsigned subdevice, const std::vector<BoardInput>& inputs) = 0;
  // Returns all sources that the board supports for each event of a command.
  virtual Result<Command> sources(unsigned subdevice) = 0;
  // Returns 0 if the board can execute the command; otherwise the number of the step at which the
  // test failed. The board may have changed arguments of the command to values that it supports.
  virtual Result<int> test(Command& command) = 0;
  virtual Status start(const Command& command) = 0;
  // Waits at most `timeout` for samples. They have the byte order of the host. The data may end
  // inside a sample.
  virtual Result<Received> receive(std::span<char> into, std::chrono::milliseconds timeout) = 0;
};

using BoardOpener = std::function<Result<std::unique_ptr<Board>>(const std::string& device)>;
// Opens a board with comedilib. Errors name the device and the remedy.
Result<std::unique_ptr<Board>> open_board(const std::string& device);

}  // namespace mdof::drivers::linux_comedi
