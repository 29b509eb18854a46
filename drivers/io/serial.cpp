#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "drivers/io/byte_stream.h"

namespace mdof::drivers {
namespace {

struct Rate {
  int baud;
  speed_t code;
};
constexpr Rate kRates[] = {{1200, B1200},     {2400, B2400},     {4800, B4800},
                           {9600, B9600},     {19200, B19200},   {38400, B38400},
                           {57600, B57600},   {115200, B115200}, {230400, B230400},
                           {460800, B460800}, {921600, B921600}};

const Rate* find_rate(int baud) {
  for (const Rate& rate : kRates)
    if (rate.baud == baud) return &rate;
  return nullptr;
}

tl::unexpected<Error> not_opened(const std::string& path, int error) {
  if (error == EACCES)
    return io_error(path + ": no permission", Remedy::install_udev_rules_for_serial);
  if (error == ENOENT)
    return io_error(path + ": does not exist; plug the device in or correct the path");
  if (error == EBUSY || error == EWOULDBLOCK)
    return io_error(path + ": is in use by another program; end that program");
  return io_error(path + ": " + std::strerror(error));
}

termios raw_mode(const SerialSettings& s, speed_t rate) {
  termios t{};
  ::cfmakeraw(&t);
  t.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | PARENB | PARODD | CRTSCTS);
  t.c_cflag |= CREAD | CLOCAL;
  if (s.stop_bits == 2) t.c_cflag |= CSTOPB;
  if (s.parity != 'N') t.c_cflag |= PARENB;
  if (s.parity == 'O') t.c_cflag |= PARODD;
  t.c_cc[VMIN] = 1;  // read() then returns EAGAIN if no bytes are pending, and 0 after a hang-up
  t.c_cc[VTIME] = 0;
  ::cfsetispeed(&t, rate);
  ::cfsetospeed(&t, rate);
  return t;
}

void set_line(int fd, int line, bool on) {
  ::ioctl(fd, on ? TIOCMBIS : TIOCMBIC, &line);  // fails for a pty, which has no such signals
}

}  // namespace

Result<ByteStream> open_serial(const std::string& path, const SerialSettings& settings) {
  const Rate* rate = find_rate(settings.baud);
  if (!rate)
    return bad_input(path + ": baud = " + std::to_string(settings.baud) +
                     " is not supported; give a standard rate, such as 9600, 19200 or 115200");
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return not_opened(path, errno);
  ByteStream port(fd, path);
  if (::ioctl(fd, TIOCEXCL) != 0 || ::flock(fd, LOCK_EX | LOCK_NB) != 0)
    return not_opened(path, errno);
  const termios t = raw_mode(settings, rate->code);
  if (::tcsetattr(fd, TCSANOW, &t) != 0)
    return io_error(path + ": " + std::strerror(errno) + "; check that the path is a serial port");
  set_line(fd, TIOCM_RTS, settings.rts);
  set_line(fd, TIOCM_DTR, settings.dtr);
  ::tcflush(fd, TCIOFLUSH);
  return port;
}

void pulse_dtr(const ByteStream& serial) {
  set_line(serial.fd(), TIOCM_DTR, false);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  set_line(serial.fd(), TIOCM_DTR, true);
}

}  // namespace mdof::drivers
