// A two-way byte stream to a device: TCP, a serial port, a pipe. Only this class uses the
// descriptors of the operating system; protocols work on bytes.
#pragma once

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
  explicit ByteStream(int fd, std::string name);  // owns fd and makes it non-blocking
  ~ByteStream();
  ByteStream(ByteStream&& other) noexcept;
  ByteStream& operator=(ByteStream&& other) noexcept;

  // Reads at most into.size() received bytes; 0: none arrived before the time-out. Error: the other
  // side has closed the connection, or the descriptor failed. The stream is then unusable.
  Result<std::size_t> read(std::span<char> into, std::chrono::milliseconds timeout);
  // Sends all of `bytes`. After an error it is unknown how many bytes were sent.
  Status write(std::string_view bytes, std::chrono::milliseconds timeout);
  // Discards received bytes until none has arrived for `quiet`, for at most `limit`. Returns the
  // number of bytes. Errors as in read().
  Result<std::size_t> drain(std::chrono::milliseconds quiet, std::chrono::milliseconds limit);

  int fd() const { return fd_; }
  const std::string& name() const { return name_; }  // for messages: "192.168.0.5:502"

 private:
  int fd_ = -1;
  std::string name_;
};

// "192.168.0.5:502", "probe-box:23", "[fe80::1]:502".
struct Endpoint {
  std::string host;
  int port = 0;
  std::string text() const;
};
// Uses `default_port` if the text has no port. Errors: no host, an invalid port.
Result<Endpoint> parse_endpoint(const std::string& text, int default_port);

// Connects within `timeout`; tries each address of a name in turn. A peer that does not acknowledge
// data is given up after 5 s (TCP_USER_TIMEOUT); keep-alive tests an idle peer every 5 s. Therefore
// a dead link causes an error of read().
Result<ByteStream> connect_tcp(const Endpoint& to, std::chrono::milliseconds timeout);

struct SerialSettings {
  int baud = 9600;
  char parity = 'N';  // N, E, O
  int stop_bits = 1;  // 1, 2
  bool rts = true, dtr = true;
};
// Raw mode, no flow control, exclusive; received bytes are discarded. Errors state the remedy: the
// port does not exist, no permission, in use, a rate that Linux does not support.
Result<ByteStream> open_serial(const std::string& path, const SerialSettings& settings);
// Sets DTR low for 10 ms, which resets a device that is wired for it. Has no effect on a line
// without DTR (a pty).
void pulse_dtr(const ByteStream& serial);

}  // namespace mdof::drivers
