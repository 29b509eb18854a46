// A continuous bulk IN stream. Several transfers are always pending, so that the device is asked
// again while earlier data are processed.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "drivers/usb/handle.h"

namespace mdof::drivers::usb {

struct Transfer;

// Thread-bound to the thread of its Handle, which may be destroyed before it. The destructor ends
// the transfers.
class InStream {
 public:
  struct Options {
    std::uint8_t endpoint = 0;
    std::size_t bytes = 64;  // size of a transfer, a multiple of 64; a short packet ends it early
    std::size_t transfers = 8;
  };
  struct Chunk {
    std::string_view bytes;  // of one transfer; valid until the next call of next()
    std::int64_t received_ns = 0;
    bool any = false;  // false: no transfer has ended; a transfer may also have no bytes
  };

  static Result<InStream> start(const Handle& handle, const Options& options);
  ~InStream();
  InStream(InStream&&) noexcept;
  InStream& operator=(InStream&&) noexcept;

  // Returns the oldest data that were not returned yet, in the order of the device; waits until
  // `deadline` at most. An error ends the stream; it is returned after all data before it.
  Result<Chunk> next(std::chrono::steady_clock::time_point deadline);
  // Cancels pending transfers. next() then returns their data, and after that an error.
  void cancel();
  bool stalled() const { return stalled_; }  // the error was a stall of the endpoint

 private:
  InStream() = default;
  Status submit_returned_transfer();
  void end();

  std::shared_ptr<Connection> connection_;
  std::vector<std::unique_ptr<Transfer>> transfers_;
  std::size_t oldest_ = 0;
  bool given_ = false;  // the oldest was returned and must be submitted again
  bool stalled_ = false;
  Status ended_;
};

}  // namespace mdof::drivers::usb
