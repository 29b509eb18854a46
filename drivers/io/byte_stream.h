// A two-way stream of bytes to a device: TCP, a serial port, a pipe. The only place where drivers
// meet the operating system's descriptors; protocols see bytes.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::drivers {

// Thread-bound. Closes its descriptor when it goes.
class ByteStream {
 public:
  explicit ByteStream(int fd, std::string name);  // owns fd, which it makes non-blocking
  ~ByteStream();
  ByteStream(ByteStream&& other) noexcept;
  ByteStream& operator=(ByteStream&& other) noexcept;

  // What has come, at most into.size() bytes; 0: nothing within the time-out. Error: the other side
  // has closed, or the descriptor failed; the stream is of no more use.
  Result<std::size_t> read(std::span<char> into, std::chrono::milliseconds timeout);
  // All of `bytes`, or an error: nothing is known then of how much was sent.
  Status write(std::string_view bytes, std::chrono::milliseconds timeout);
  // Throws away what has come until nothing has for `quiet`, at most for `limit`; gives the number
  // of bytes. Error as read().
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
// `default_port` where the text has none. Error: no host, a port that is none.
Result<Endpoint> parse_endpoint(const std::string& text, int default_port);

// Connects within `timeout`, each address of a name in turn. A peer that falls silent with data
// unacknowledged is given up after 5 s (TCP_USER_TIMEOUT), an idle one is asked every 5 s
// (keep-alive): a dead link ends in an error of read().
Result<ByteStream> connect_tcp(const Endpoint& to, std::chrono::milliseconds timeout);

struct SerialSettings {
  int baud = 9600;
  char parity = 'N';  // N, E, O
  int stop_bits = 1;  // 1, 2
  bool rts = true, dtr = true;
};
// Raw mode, no flow control, exclusive; what had been received is thrown away. Errors name the
// remedy: not there, no permission, in use, a rate that Linux has not.
Result<ByteStream> open_serial(const std::string& path, const SerialSettings& settings);
// Pulls DTR low for 10 ms: resets a device that is wired so. Not every line has it (a pty):
// ignored.
void pulse_dtr(const ByteStream& serial);

}  // namespace mdof::drivers
