// Test requests ("sentinels") for an RTU line after an error. Pure.
//
// An RTU reply does not state to which request or register it belongs. It shows only its function
// and its length. A slave on one line answers the requests in order. A sentinel is a read request
// of a length that no request for values has. After its reply has arrived, no reply to an earlier
// request can follow. The pending reply to one sentinel must not be confused with the reply to a
// later sentinel. Therefore the next sentinel has another length, as in the alternating bit
// protocol (Bartlett, Scantlebury and Wilkinson 1969).
#pragma once

#include <algorithm>
#include <compare>
#include <vector>

#include "drivers/modbus/protocol.h"

namespace mdof::drivers::modbus {

// The properties of a read request that its RTU reply shows.
struct Shape {
  int function = 0, count = 0;
  auto operator<=>(const Shape&) const = default;
};

class Sentinels {
 public:
  // Call this before a request for values. Returns false if a reply to a sentinel of the same shape
  // is pending; the line must then first be tested with another shape.
  bool add_regular(Shape shape) {
    if (!contains(regular_, shape)) regular_.push_back(shape);
    if (shape == now_) now_ = {};
    return !contains(pending_shapes_, shape);
  }
  // Returns the shape of the sentinel; it is the same until proved() is called. `regular`: the
  // request for values. The sentinel preferably has fewer registers than this request, because
  // these registers certainly exist. A result with count 0: no length is free.
  Shape pick(Shape regular) {
    for (int i = 1; now_ == Shape{} && i < kMostRegisters; ++i) {
      const Shape shape{regular.function, i < regular.count ? regular.count - i : i + 1};
      if (!contains(regular_, shape) && !contains(pending_shapes_, shape)) now_ = shape;
    }
    return now_;
  }
  // Call this if the received data were not the reply to the sentinel.
  void failed() {
    if (!contains(pending_shapes_, now_)) pending_shapes_.push_back(now_);
  }
  // Call this after the reply to the sentinel has arrived. If an earlier sentinel had the same
  // shape, one more reply of this shape may still arrive.
  void proved() {
    const bool repeated = contains(pending_shapes_, now_);
    pending_shapes_.clear();
    if (repeated) pending_shapes_.push_back(now_);
    now_ = {};
  }

 private:
  static bool contains(const std::vector<Shape>& shapes, Shape shape) {
    return std::find(shapes.begin(), shapes.end(), shape) != shapes.end();
  }
  std::vector<Shape> regular_, pending_shapes_;
  Shape now_;  // shape of the present sentinel; {}: no sentinel
};

}  // namespace mdof::drivers::modbus
