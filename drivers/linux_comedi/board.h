// What the driver asks of a Comedi board, in plain values: libcomedi.cpp asks a real one of
// comedilib, tests one without the kernel.
//
// Sources of the facts: Linux-Comedi/comedilib (include/comedi.h, include/comedilib.h, lib/cmd.c,
// lib/calib.c, demo/cmd.c) and the kernel's drivers/comedi/comedi_fops.c.
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

// What an input is measured against: AREF_… of comedi.h.
enum class Reference : std::uint8_t { ground = 0, common = 1, differential = 2, other = 3 };

// Of a command's events: TRIG_… of comedi.h.
enum Source : unsigned { kNone = 0x01, kNow = 0x02, kFollow = 0x04, kTimer = 0x10, kCount = 0x20 };
inline constexpr unsigned kWakeEachScan = 0x20;  // a flag of a command, TRIG_WAKE_EOS

struct Subdevice {
  bool analogue_input = false;
  bool streams = false;          // takes commands that read
  bool long_samples = false;     // of 32 bits, else of 16
  bool soft_calibrated = false;  // its codes are to be corrected by a calibration file
  unsigned references = 0;       // bit n: Reference n
  unsigned channels = 0;
};

struct Range {
  double low = 0, high = 0;  // V, if it is one of volts
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
  unsigned source = 0, argument = 0;  // as a mask: all sources that it can have
};
// A comedi_cmd: one scan of the inputs after the other.
struct Command {
  unsigned subdevice = 0, flags = 0;
  Event start, scan_begin, convert, scan_end, stop;
  std::vector<BoardInput> inputs;
};

struct Calibration {
  std::string file;  // where it is looked for
  bool found = false;
  std::string wrong;                                // why it is not used, though it is there
  std::vector<std::optional<Polynomial>> to_volts;  // of each input; none: by its range
};

enum class StreamState : std::uint8_t {
  runs,
  overran,  // the kernel's buffer, or the board's: all that came before it has been given
  ended,
};
struct Received {
  std::size_t bytes = 0;
  StreamState stream = StreamState::runs;
};

// An open board. Errors say what comedilib says, without the device's name.
class Board {
 public:
  virtual ~Board() = default;  // the kernel ends its command
  virtual std::string driver() const = 0;
  virtual std::string name() const = 0;
  virtual std::vector<Subdevice> subdevices() = 0;
  virtual std::vector<Range> ranges(unsigned subdevice, unsigned channel) = 0;
  // Of this input; 0: it is not known.
  virtual std::uint32_t greatest_code(unsigned subdevice, unsigned channel) = 0;
  virtual std::size_t buffer_bytes(unsigned subdevice) = 0;
  // Sets what hardware the file has settings for.
  virtual Calibration calibrate(unsigned subdevice, const std::vector<BoardInput>& inputs) = 0;
  // All that its events can have.
  virtual Result<Command> sources(unsigned subdevice) = 0;
  // 0: can be; else the step at which it fails, and what could be made to fit has been.
  virtual Result<int> test(Command& command) = 0;
  virtual Status start(const Command& command) = 0;
  // Waits at most `timeout` for samples, in the machine's byte order; they may end within a sample.
  virtual Result<Received> receive(std::span<char> into, std::chrono::milliseconds timeout) = 0;
};

using BoardOpener = std::function<Result<std::unique_ptr<Board>>(const std::string& device)>;
// By comedilib. Errors name the device and the remedy.
Result<std::unique_ptr<Board>> open_board(const std::string& device);

}  // namespace mdof::drivers::linux_comedi
