// A byte stream to and from a device: TCP, a serial port, a pipe. Only this class uses the file
// descriptors of these connections; protocols work on bytes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::drivers {

// Thread-bound. The destructor closes the descriptor.
class ByteStream {
 public:
  explicit ByteStream(int fd, std::string name);  // takes ownership of fd and makes it non-blocking
  ~ByteStream();
  ByteStream(ByteStream&& other) noexcept;
  ByteStream& operator=(ByteStream&& other) noexcept;

  // Reads at most into.size() received bytes and returns their number; 0: no byte arrived before
  // the time-out. Error: the other side has closed the connection, or the descriptor failed. The
  // stream is unusable after an error.
  Result<std::size_t> read(std::span<char> into, std::chrono::milliseconds timeout);
  // Asks the kernel for the times at which bytes arrive. Only TCP supports this. The first bytes
  // after this call may have no time.
  void keep_arrival_times();
  // The time at which the newest byte of the last read() arrived. Without a time from the kernel,
  // this is the time of the read().
  std::chrono::steady_clock::time_point arrival() const { return arrival_; }
  // Sends all of `bytes`. After an error the number of bytes that were sent is unknown.
  Status write(std::string_view bytes, std::chrono::milliseconds timeout);
  // Discards received bytes until no byte has arrived for `quiet`, but for at most `limit`. Returns
  // the number of discarded bytes. Errors as in read().
  Result<std::size_t> drain(std::chrono::milliseconds quiet, std::chrono::milliseconds limit);

  int fd() const { return fd_; }
  const std::string& name() const { return name_; }  // for messages: "192.168.0.5:502"

 private:
  ssize_t receive(std::span<char> into);

  int fd_ = -1;
  std::string name_;
  bool keeps_arrival_times_ = false;
  std::chrono::steady_clock::time_point arrival_;
};

// An address such as "192.168.0.5:502", "probe-box:23" or "[fe80::1]:502".
struct Endpoint {
  std::string host;
  int port = 0;
  std::string text() const;
};
// Uses `default_port` if the text has no port. Errors: no host, an invalid port.
Result<Endpoint> parse_endpoint(const std::string& text, int default_port);

// Connects within `timeout`. If a host name has several addresses, it tries them one after the
// other. The kernel closes the connection if the peer does not acknowledge data for 5 s
// (TCP_USER_TIMEOUT); keep-alive tests an idle peer every 5 s. Therefore a broken link causes an
// error of read().
Result<ByteStream> connect_tcp(const Endpoint& to, std::chrono::milliseconds timeout);

struct SerialSettings {
  int baud = 9600;
  char parity = 'N';  // N, E, O
  int stop_bits = 1;  // 1, 2
  bool rts = true, dtr = true;
};
// Opens the port in raw mode, without flow control, for exclusive use. Discards the bytes that were
// received before. Errors state the remedy: the port does not exist; the user has no permission;
// the port is in use; Linux does not support the baud rate.
Result<ByteStream> open_serial(const std::string& path, const SerialSettings& settings);
// Sets DTR low for 10 ms. This resets a device whose reset input is wired to DTR. Has no effect on
// a line without DTR (a pty).
void pulse_dtr(const ByteStream& serial);

}  // namespace mdof::drivers
