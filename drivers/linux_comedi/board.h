// Interface to a Comedi board, in plain values. libcomedi.cpp implements it with comedilib; tests
// implement it without the kernel.
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

// Reference of an input: AREF_… of comedi.h.
enum class Reference : std::uint8_t { ground = 0, common = 1, differential = 2, other = 3 };

// Sources of a command's events: TRIG_… of comedi.h.
enum Source : unsigned { kNone = 0x01, kNow = 0x02, kFollow = 0x04, kTimer = 0x10, kCount = 0x20 };
inline constexpr unsigned kWakeEachScan = 0x20;  // a flag of a command, TRIG_WAKE_EOS

struct Subdevice {
  bool analogue_input = false;
  bool streams = false;          // supports commands that read
  bool long_samples = false;     // samples have 32 bits; false: 16 bits
  bool soft_calibrated = false;  // a calibration file corrects its codes
  unsigned references = 0;       // bit n: Reference n
  unsigned channels = 0;
};

struct Range {
  double low = 0, high = 0;  // V if `volts`
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
  unsigned source = 0, argument = 0;  // a mask: all sources that are possible
};
// A comedi_cmd: repeated scans of the inputs.
struct Command {
  unsigned subdevice = 0, flags = 0;
  Event start, scan_begin, convert, scan_end, stop;
  std::vector<BoardInput> inputs;
};

struct Calibration {
  std::string file;  // expected path
  bool found = false;
  std::string wrong;                                // why the existing file is not used
  std::vector<std::optional<Polynomial>> to_volts;  // for each input; nullopt: use its range
};

enum class StreamState : std::uint8_t {
  runs,
  overran,  // the buffer of the kernel or of the board has overrun; all earlier data were returned
  ended,
};
struct Received {
  std::size_t bytes = 0;
  StreamState stream = StreamState::runs;
};

// An open board. Errors contain comedilib's text, without the name of the device.
class Board {
 public:
  virtual ~Board() = default;  // the kernel ends the command
  virtual std::string driver() const = 0;
  virtual std::string name() const = 0;
  virtual std::vector<Subdevice> subdevices() = 0;
  virtual std::vector<Range> ranges(unsigned subdevice, unsigned channel) = 0;
  // Greatest code of an input; 0: not known.
  virtual std::uint32_t greatest_code(unsigned subdevice, unsigned channel) = 0;
  virtual std::size_t buffer_bytes(unsigned subdevice) = 0;
  // Reads the calibration file and applies its settings to hardware that can be set.
  virtual Calibration calibrate(unsigned subdevice, const std::vector<BoardInput>& inputs) = 0;
  // All sources that the board supports for the events of a command.
  virtual Result<Command> sources(unsigned subdevice) = 0;
  // Returns 0 if the board can execute the command; otherwise the number of the failed step. The
  // board has then changed arguments that it can fit.
  virtual Result<int> test(Command& command) = 0;
  virtual Status start(const Command& command) = 0;
  // Waits at most `timeout` for samples in host byte order. The data may end within a sample.
  virtual Result<Received> receive(std::span<char> into, std::chrono::milliseconds timeout) = 0;
};

using BoardOpener = std::function<Result<std::unique_ptr<Board>>(const std::string& device)>;
// Opens a board with comedilib. Errors name the device and the remedy.
Result<std::unique_ptr<Board>> open_board(const std::string& device);

}  // namespace mdof::drivers::linux_comedi
