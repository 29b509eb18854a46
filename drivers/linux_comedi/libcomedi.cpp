// Real boards, through comedilib. Only this file calls comedilib.
#include <comedilib.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <utility>

#include "drivers/linux_comedi/board.h"

namespace mdof::drivers::linux_comedi {
namespace {

using std::chrono::milliseconds;

// The numbers of board.h must equal those of comedi.h.
static_assert(kNone == TRIG_NONE && kNow == TRIG_NOW && kFollow == TRIG_FOLLOW);
static_assert(kTimer == TRIG_TIMER && kCount == TRIG_COUNT && kWakeEachScan == TRIG_WAKE_EOS);
static_assert(static_cast<int>(Reference::ground) == AREF_GROUND &&
              static_cast<int>(Reference::common) == AREF_COMMON &&
              static_cast<int>(Reference::differential) == AREF_DIFF &&
              static_cast<int>(Reference::other) == AREF_OTHER);
static_assert(sizeof(sampl_t) == 2 && sizeof(lsampl_t) == 4);
static_assert(COMEDI_MAX_NUM_POLYNOMIAL_COEFFICIENTS ==
              std::tuple_size_v<decltype(Polynomial::coefficients)>);

struct Freed {
  void operator()(char* text) const { std::free(text); }  // NOLINT: comedilib uses malloc
  void operator()(comedi_t* device) const { comedi_close(device); }
  void operator()(comedi_calibration_t* file) const { comedi_cleanup_calibration(file); }
};
using Device = std::unique_ptr<comedi_t, Freed>;
using CalibrationFile = std::unique_ptr<comedi_calibration_t, Freed>;

std::string last_error() {
  return comedi_strerror(comedi_errno());
}

std::string text(const char* from) {
  return from ? from : "";
}

std::string open_error(const std::string& device, int error) {
  std::string what = device + ": " + comedi_strerror(error);
  if (error == ENOENT)
    return what +
           "; check that the board is installed and that its driver is loaded (to list the boards, "
           "run: ls /dev/comedi*); attach an ISA board with comedi_config";
  if (error == ENODEV || error == ENXIO)
    return what +
           "; no board is attached to this file, because the board is unplugged or has another "
           "number; correct the key \"device\"";
  if (error == EACCES || error == EPERM)
    return what +
           "; on Debian, a user of Comedi boards must be a member of the group iocard; if this "
           "user "
           "is not, run \"sudo usermod -aG iocard $USER\", then log in again";
  if (error == ENOTTY) return what + "; this is not a Comedi device; correct the key \"device\"";
  return what;
}

unsigned references_of(int flags) {
  unsigned references = 0;
  constexpr int kFlags[] = {SDF_GROUND, SDF_COMMON, SDF_DIFF, SDF_OTHER};
  for (unsigned n = 0; n < 4; ++n)
    if ((flags & kFlags[n]) != 0) references |= 1U << n;
  return references;
}

// The returned command is valid as long as `inputs` exists.
comedi_cmd raw_command(const Command& command, std::vector<unsigned>& inputs) {
  inputs.clear();
  for (const BoardInput& input : command.inputs)
    inputs.push_back(CR_PACK(input.channel, input.range, static_cast<unsigned>(input.reference)));
  comedi_cmd raw{};
  raw.subdev = command.subdevice;
  raw.flags = command.flags;
  raw.start_src = command.start.source;
  raw.start_arg = command.start.argument;
  raw.scan_begin_src = command.scan_begin.source;
  raw.scan_begin_arg = command.scan_begin.argument;
  raw.convert_src = command.convert.source;
  raw.convert_arg = command.convert.argument;
  raw.scan_end_src = command.scan_end.source;
  raw.scan_end_arg = command.scan_end.argument;
  raw.stop_src = command.stop.source;
  raw.stop_arg = command.stop.argument;
  raw.chanlist = inputs.data();
  raw.chanlist_len = static_cast<unsigned>(inputs.size());
  return raw;
}

void read_events(const comedi_cmd& raw, Command& command) {
  command.flags = raw.flags;
  command.start = {raw.start_src, raw.start_arg};
  command.scan_begin = {raw.scan_begin_src, raw.scan_begin_arg};
  command.convert = {raw.convert_src, raw.convert_arg};
  command.scan_end = {raw.scan_end_src, raw.scan_end_arg};
  command.stop = {raw.stop_src, raw.stop_arg};
}

bool has_dacs(const comedi_calibration_t& file, unsigned subdevice) {
  return std::any_of(file.settings, file.settings + file.num_settings, [&](const auto& setting) {
    return setting.subdevice == subdevice && setting.num_caldacs > 0;
  });
}

bool one_way(const std::vector<BoardInput>& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [&](const BoardInput& input) {
    return input.range == inputs.front().range && input.reference == inputs.front().reference;
  });
}

std::optional<Polynomial> to_volts(const comedi_calibration_t& file, unsigned subdevice,
                                   const BoardInput& input) {
  comedi_polynomial_t raw{};
  if (comedi_get_softcal_converter(subdevice, input.channel, input.range, COMEDI_TO_PHYSICAL, &file,
                                   &raw) < 0)
    return std::nullopt;
  Polynomial polynomial;
  polynomial.origin = raw.expansion_origin;
  for (unsigned i = 0; i < polynomial.coefficients.size() && i <= raw.order; ++i)
    polynomial.coefficients[i] = raw.coefficients[i];
  return polynomial;
}

class LibraryBoard final : public Board {
 public:
  explicit LibraryBoard(Device device) : device_(std::move(device)) {}

  std::string driver() const override { return text(comedi_get_driver_name(device_.get())); }
  std::string name() const override { return text(comedi_get_board_name(device_.get())); }
  std::vector<Subdevice> subdevices() override;
  std::vector<Range> ranges(unsigned subdevice, unsigned channel) override;
  std::uint32_t greatest_code(unsigned subdevice, unsigned channel) override {
    return comedi_get_maxdata(device_.get(), subdevice, channel);
  }
  std::size_t buffer_bytes(unsigned subdevice) override {
    return static_cast<std::size_t>(std::max(0, comedi_get_buffer_size(device_.get(), subdevice)));
  }
  Calibration calibrate(unsigned subdevice, const std::vector<BoardInput>& inputs) override;
  Result<Command> sources(unsigned subdevice) override;
  Result<int> test(Command& command) override;
  Status start(const Command& command) override;
  Result<Received> receive(std::span<char> into, milliseconds timeout) override;

 private:
  Status set_hardware(const comedi_calibration_t& file, unsigned subdevice,
                      const std::vector<BoardInput>& inputs);

  Device device_;
  unsigned subdevice_ = 0;  // subdevice that executes the command
};

std::vector<Subdevice> LibraryBoard::subdevices() {
  std::vector<Subdevice> all;
  const int count = comedi_get_n_subdevices(device_.get());
  for (int n = 0; n < count; ++n) {
    const auto index = static_cast<unsigned>(n);
    const int flags = std::max(0, comedi_get_subdevice_flags(device_.get(), index));
    Subdevice one;
    one.analogue_input = comedi_get_subdevice_type(device_.get(), index) == COMEDI_SUBD_AI;
    one.streams = (flags & SDF_CMD_READ) != 0;
    one.long_samples = (flags & SDF_LSAMPL) != 0;
    one.soft_calibrated = (flags & SDF_SOFT_CALIBRATED) != 0;
    one.references = references_of(flags);
    one.channels = static_cast<unsigned>(std::max(0, comedi_get_n_channels(device_.get(), index)));
    all.push_back(one);
  }
  return all;
}

std::vector<Range> LibraryBoard::ranges(unsigned subdevice, unsigned channel) {
  std::vector<Range> all;
  const int count = comedi_get_n_ranges(device_.get(), subdevice, channel);
  for (int n = 0; n < count; ++n) {
    const comedi_range* range =
        comedi_get_range(device_.get(), subdevice, channel, static_cast<unsigned>(n));
    all.push_back(range ? Range{range->min, range->max, range->unit == UNIT_volt}
                        : Range{0, 0, false});
  }
  return all;
}

// Compares driver and board with the calibration file. This is necessary because
// comedi_get_softcal_converter accepts the file of another board (comedi_apply_parsed_calibration
// does not).
Calibration LibraryBoard::calibrate(unsigned subdevice, const std::vector<BoardInput>& inputs) {
  Calibration calibration;
  const std::unique_ptr<char, Freed> path(comedi_get_default_calibration_path(device_.get()));
  calibration.file = text(path.get());
  if (!path || ::access(path.get(), F_OK) != 0) return calibration;
  calibration.found = true;
  const CalibrationFile file(comedi_parse_calibration_file(path.get()));
  if (!file) {
    calibration.wrong = "cannot be read, or is not a calibration file";
  } else if (driver() != text(file->driver_name) || name() != text(file->board_name)) {
    calibration.wrong = "belongs to the board \"" + text(file->board_name) + "\" (driver " +
                        text(file->driver_name) + ")";
  } else if (auto set = set_hardware(*file, subdevice, inputs); !set) {
    calibration.wrong = set.error().message;
  } else {
    for (const BoardInput& input : inputs)
      calibration.to_volts.push_back(to_volts(*file, subdevice, input));
  }
  return calibration;
}

Status LibraryBoard::set_hardware(const comedi_calibration_t& file, unsigned subdevice,
                                  const std::vector<BoardInput>& inputs) {
  if (!has_dacs(file, subdevice)) return {};
  if (!one_way(inputs))
    return io_error(
        "calibrates the board for one range and one reference only; give all channels the same "
        "range_v and reference");
  for (const BoardInput& input : inputs)
    if (comedi_apply_parsed_calibration(device_.get(), subdevice, input.channel, input.range,
                                        static_cast<unsigned>(input.reference), &file) < 0)
      return io_error("cannot be applied to CH" + std::to_string(input.channel));
  return {};
}

Result<Command> LibraryBoard::sources(unsigned subdevice) {
  comedi_cmd raw{};
  if (comedi_get_cmd_src_mask(device_.get(), subdevice, &raw) < 0)
    return io_error("cannot query the commands of the board: " + last_error());
  Command command;
  command.subdevice = subdevice;
  read_events(raw, command);
  return command;
}

Result<int> LibraryBoard::test(Command& command) {
  std::vector<unsigned> inputs;
  comedi_cmd raw = raw_command(command, inputs);
  const int failed = comedi_command_test(device_.get(), &raw);
  if (failed < 0) return io_error("cannot test a command of the board: " + last_error());
  read_events(raw, command);
  return failed;
}

Status LibraryBoard::start(const Command& command) {
  if (comedi_set_read_subdevice(device_.get(), command.subdevice) < 0)
    return io_error("cannot read the subdevice: " + last_error());
  std::vector<unsigned> inputs;
  comedi_cmd raw = raw_command(command, inputs);
  if (comedi_command(device_.get(), &raw) < 0) {
    const bool busy = comedi_errno() == EBUSY;
    return io_error("the board refuses the command: " + last_error() +
                    (busy ? "; end the other program that reads the board" : ""));
  }
  subdevice_ = command.subdevice;
  return {};
}

// A board that was removed never becomes readable, so poll() does not report it. Only read()
// reports it (comedi_poll and comedi_read in the kernel's comedi_fops.c).
Result<Received> LibraryBoard::receive(std::span<char> into, milliseconds timeout) {
  const int fd = comedi_fileno(device_.get());
  pollfd ready{fd, POLLIN, 0};
  const auto longest = milliseconds(std::numeric_limits<int>::max());
  const int woken = ::poll(&ready, 1, static_cast<int>(std::min(timeout, longest).count()));
  // No data arrived. A board may keep samples until its FIFO is half full, so comedi_poll() asks
  // for these samples. Not every board supports comedi_poll().
  if (woken == 0) (void)comedi_poll(device_.get(), subdevice_);
  const ssize_t bytes = ::read(fd, into.data(), into.size());
  if (bytes > 0) return Received{static_cast<std::size_t>(bytes), StreamState::runs};
  if (bytes == 0) return Received{0, StreamState::ended};
  if (errno == EAGAIN || errno == EINTR) return Received{};
  if (errno == EPIPE) return Received{0, StreamState::overran};
  if (errno == ENODEV)
    return io_error("the board is gone; it was unplugged, or its driver was unloaded");
  return io_error(std::string("cannot be read: ") + comedi_strerror(errno));
}

}  // namespace

Result<std::unique_ptr<Board>> open_board(const std::string& device) {
  Device opened(comedi_open(device.c_str()));
  if (!opened) return io_error(open_error(device, comedi_errno()));
  const int fd = comedi_fileno(opened.get());
  if (::fcntl(fd, F_SETFD, FD_CLOEXEC) < 0 ||
      ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK) < 0)
    return io_error(device + ": the file descriptor cannot be set up: " + comedi_strerror(errno));
  return std::make_unique<LibraryBoard>(std::move(opened));
}

}  // namespace mdof::drivers::linux_comedi
