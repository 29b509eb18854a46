// A replacement of comedilib that each_device_test.py preloads into mdofd. It simulates a Comedi
// board, so that the real program reads a simulated machine.
// - The device "/dev/comedi0" stands for the address of a csv_stream of mdof-simulate.
// - Each row of the stream is one scan. Its columns, µm, are the inputs of the board, with 10
//   µm/V.
// - The readings of the board have an error of gain of 5 % and an offset of 50 mV. The calibration
//   file MDOF_COMEDI_CALIBRATION corrects both.
// - comedilib itself provides the functions that are not defined here.
#include <comedilib.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr double kUmPerV = 10, kGain = 1.05, kOffset_v = 0.05;
constexpr lsampl_t kMost = 65535;
comedi_range the_range{-10, 10, UNIT_volt};

int connected(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (colon == address.npos || ::getaddrinfo(address.substr(0, colon).c_str(),
                                             address.substr(colon + 1).c_str(), &hints, &found))
    return -1;
  int fd = ::socket(found->ai_family, SOCK_STREAM, 0);
  if (::connect(fd, found->ai_addr, found->ai_addrlen) != 0) {
    ::close(fd);
    fd = -1;
  }
  ::freeaddrinfo(found);
  return fd;
}

sampl_t code_of(double volts) {
  const double code = std::round((volts * kGain + kOffset_v + 10) / 20 * kMost);
  return static_cast<sampl_t>(std::clamp(code, 0.0, static_cast<double>(kMost)));
}

// Converts a row "time_s,A_um,…" to voltages; empty for the header.
std::vector<double> volts_of(const char* row) {
  std::vector<double> volts;
  char* end = nullptr;
  std::strtod(row, &end);
  if (end == row) return volts;
  while (*end == ',') {
    const char* field = end + 1;
    volts.push_back(std::strtod(field, &end) / kUmPerV);
  }
  return volts;
}

}  // namespace

struct comedi_t_struct {       // NOLINT(readability-identifier-naming): comedilib names it
  int rows = -1;               // the connection to mdof-simulate
  int ends[2] = {-1, -1};      // read end and write end of the pipe of samples
  std::vector<unsigned> list;  // numbers of the channels
  std::thread scanning;

  void scan() const {
    std::string line;
    std::array<char, 4096> bytes_read{};
    for (ssize_t n = 0; (n = ::read(rows, bytes_read.data(), bytes_read.size())) > 0;)
      for (ssize_t i = 0; i < n; ++i) {
        if (bytes_read[static_cast<std::size_t>(i)] != '\n') {
          line += bytes_read[static_cast<std::size_t>(i)];
          continue;
        }
        if (!pass_on(line)) return;
        line.clear();
      }
    ::shutdown(ends[1], SHUT_WR);
  }

  // Returns false if the read end of the pipe is closed.
  bool pass_on(const std::string& row) const {
    const auto volts = volts_of(row.c_str());
    if (volts.empty()) return true;
    std::vector<sampl_t> codes;
    for (const unsigned input : list) codes.push_back(code_of(volts.at(CR_CHAN(input))));
    const std::size_t bytes = codes.size() * sizeof(sampl_t);
    return ::write(ends[1], codes.data(), bytes) == static_cast<ssize_t>(bytes);
  }
};

extern "C" {

comedi_t* comedi_open(const char* address) {
  auto* board = new comedi_t;
  board->rows = connected(address);
  if (board->rows >= 0 && ::socketpair(AF_UNIX, SOCK_STREAM, 0, board->ends) == 0) return board;
  delete board;
  errno = ENODEV;
  return nullptr;
}

int comedi_close(comedi_t* board) {
  ::shutdown(board->rows, SHUT_RDWR);
  ::shutdown(board->ends[0], SHUT_RDWR);
  if (board->scanning.joinable()) board->scanning.join();
  for (const int fd : {board->rows, board->ends[0], board->ends[1]}) ::close(fd);
  delete board;
  return 0;
}

int comedi_errno() {
  return errno;
}
int comedi_fileno(comedi_t* board) {
  return board->ends[0];
}
const char* comedi_get_driver_name(comedi_t*) {
  return "rows";
}
const char* comedi_get_board_name(comedi_t*) {
  return "rows-of-csv";
}
int comedi_get_n_subdevices(comedi_t*) {
  return 1;
}
int comedi_get_subdevice_type(comedi_t*, unsigned) {
  return COMEDI_SUBD_AI;
}
int comedi_get_subdevice_flags(comedi_t*, unsigned) {
  return static_cast<int>(SDF_CMD_READ | SDF_GROUND | SDF_SOFT_CALIBRATED);
}
int comedi_get_n_channels(comedi_t*, unsigned) {
  return 8;
}
lsampl_t comedi_get_maxdata(comedi_t*, unsigned, unsigned) {
  return kMost;
}
int comedi_get_n_ranges(comedi_t*, unsigned, unsigned) {
  return 1;
}
comedi_range* comedi_get_range(comedi_t*, unsigned, unsigned, unsigned) {
  return &the_range;
}
int comedi_get_buffer_size(comedi_t*, unsigned) {
  return 65536;
}
char* comedi_get_default_calibration_path(comedi_t*) {
  const char* file = std::getenv("MDOF_COMEDI_CALIBRATION");
  return file ? ::strdup(file) : nullptr;
}
int comedi_poll(comedi_t*, unsigned) {
  return 0;
}
int comedi_set_read_subdevice(comedi_t*, unsigned) {
  return 0;
}

int comedi_get_cmd_src_mask(comedi_t*, unsigned subdevice, comedi_cmd* mask) {
  std::memset(mask, 0, sizeof *mask);
  mask->subdev = subdevice;
  mask->start_src = TRIG_NOW;
  mask->scan_begin_src = TRIG_TIMER;
  mask->convert_src = TRIG_NOW;
  mask->scan_end_src = TRIG_COUNT;
  mask->stop_src = TRIG_NONE;
  return 0;
}

// Every rate is accepted. The caller must request the rate of the rows.
int comedi_command_test(comedi_t*, comedi_cmd* command) {
  const bool fits = command->start_src == TRIG_NOW && command->scan_begin_src == TRIG_TIMER &&
                    command->convert_src == TRIG_NOW && command->stop_src == TRIG_NONE &&
                    command->scan_end_arg == command->chanlist_len;
  return fits ? 0 : 1;
}

int comedi_command(comedi_t* board, comedi_cmd* command) {
  board->list.assign(command->chanlist, command->chanlist + command->chanlist_len);
  board->scanning = std::thread([board] { board->scan(); });
  return 0;
}

}  // extern "C"
