// Bulk data that flows in: several transfers are under way at any time, so that the device is asked
// again while its last answer is still being read.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "drivers/usb/handle.h"

namespace mdof::drivers::usb {

struct Transfer;

// Thread-bound, on the thread of its Handle, which may go before it. Ends its transfers when it
// goes.
class InStream {
 public:
  struct Options {
    std::uint8_t endpoint = 0;
    std::size_t bytes = 64;  // of a transfer; a multiple of 64. It ends early with a short packet
    std::size_t transfers = 8;
  };
  struct Chunk {
    std::string_view bytes;  // of one transfer; valid until the next call of next()
    std::int64_t received_ns = 0;
    bool any = false;  // false: nothing has come (a transfer may also bring no bytes)
  };

  static Result<InStream> start(const Handle& handle, const Options& options);
  ~InStream();
  InStream(InStream&&) noexcept;
  InStream& operator=(InStream&&) noexcept;

  // The oldest data not yet given out, in the device's order; waits at most until `deadline`.
  // An error ends the stream, after what came before it was given out.
  Result<Chunk> next(std::chrono::steady_clock::time_point deadline);
  // Takes back what is under way: what has come of it is given out by next(), then an error.
  void cancel();
  bool stalled() const { return stalled_; }  // the error was that the device stalled the endpoint

 private:
  InStream() = default;
  Status submit_given();
  void end();

  std::shared_ptr<Connection> connection_;
  std::vector<std::unique_ptr<Transfer>> transfers_;
  std::size_t oldest_ = 0;
  bool given_ = false;  // the oldest was given out and is to be submitted again
  bool stalled_ = false;
  Status ended_;
};

}  // namespace mdof::drivers::usb
