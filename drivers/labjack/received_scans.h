// Scans of a stream that the driver has received and not returned yet.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drivers/labjack/samples.h"
#include "drivers/scan_block.h"
#include "schema/base/result.h"

namespace mdof::drivers::labjack {

class ReceivedScans {
 public:
  void clear() { *this = {}; }
  std::vector<Scan>& scans() { return scans_; }
  bool has_error() const { return !broken_; }

  // If all scans were returned, calls `receive`, which appends to scans(). Scans that were received
  // before an error are returned before the error. `place`: the device, for the error.
  template <class Receive>
  Status next(const std::string& place, const Receive& receive) {
    if (returned_ < scans_.size()) return {};
    scans_.clear();
    returned_ = 0;
    if (!broken_) return broken_;
    Status received = receive();
    if (received) return {};
    broken_ = in_context(place, std::move(received.error()));
    return scans_.empty() ? broken_ : Status{};
  }

  // Calls append(scan) for the scans of one block. A block ends before lost scans. The next block
  // then contains their number in `lost`.
  template <class Append>
  void fill(SampleBlock& block, const Append& append) {
    reserve_scans(block, scans_.size() - returned_);
    for (; returned_ < scans_.size(); ++returned_) {
      const Scan& scan = scans_[returned_];
      if (scan.lost > 0 && block.scans() > 0) return;
      append(scan);
    }
  }

 private:
  std::vector<Scan> scans_;
  std::size_t returned_ = 0;  // number of scans that were returned
  Status broken_;             // the error that ended the stream
};

}  // namespace mdof::drivers::labjack
