// A continuous bulk IN stream. Several transfers are pending at any time, so that the host requests
// new data while earlier data are processed.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "drivers/usb/handle.h"

namespace mdof::drivers::usb {

struct Transfer;

// Use it only on the thread of its Handle. The stream may exist longer than the Handle. The
// destructor ends the transfers.
class InStream {
 public:
  struct Options {
    std::uint8_t endpoint = 0;
    // Size of a transfer, a multiple of 64; a packet that is not full ends the transfer.
    std::size_t bytes = 64;
    std::size_t transfers = 8;
  };
  struct Chunk {
    std::string_view bytes;  // bytes of one transfer; valid until the next call of next()
    std::int64_t received_ns = 0;
    bool any = false;  // false: no transfer has ended; if true, `bytes` may still be empty
  };

  static Result<InStream> start(const Handle& handle, const Options& options);
  ~InStream();
  InStream(InStream&&) noexcept;
  InStream& operator=(InStream&&) noexcept;

  // Returns the oldest data that were not returned yet, in the order in which the device sent them.
  // Waits until `deadline` at most. An error ends the stream; it is returned after all data that
  // precede it.
  Result<Chunk> next(std::chrono::steady_clock::time_point deadline);
  // Cancels pending transfers. next() then returns their data, and after that an error.
  void cancel();
  bool stalled() const { return stalled_; }  // true: the error was a stall of the endpoint

 private:
  InStream() = default;
  Status submit_returned_transfer();
  void end();

  std::shared_ptr<Connection> connection_;
  std::vector<std::unique_ptr<Transfer>> transfers_;
  std::size_t oldest_ = 0;
  bool given_ = false;  // true: the oldest transfer was returned and must be submitted again
  bool stalled_ = false;
  Status ended_;
};

}  // namespace mdof::drivers::usb
