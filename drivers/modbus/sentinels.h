// Requests that test an RTU line after an error. Pure.
//
// An RTU reply does not state to which request or register it belongs; only its function and length
// are known. A slave on one wire answers in order. Therefore the reply to a sentinel, a read of a
// length that no value uses, shows that no reply to an earlier request can follow. A sentinel whose
// reply is still pending must not be confused with a later one: after the next error another length
// is used, as in the alternating bit protocol (Bartlett, Scantlebury and Wilkinson 1969).
#pragma once

#include <algorithm>
#include <compare>
#include <vector>

#include "drivers/modbus/protocol.h"

namespace mdof::drivers::modbus {

// The properties of a read that an RTU reply shows.
struct Shape {
  int function = 0, count = 0;
  auto operator<=>(const Shape&) const = default;
};

class Sentinels {
 public:
  // Adds the shape of a request for values. False: a reply to a sentinel of this shape is pending,
  // so the line must first be tested with another shape.
  bool add_regular(Shape shape) {
    if (!contains(regular_, shape)) regular_.push_back(shape);
    if (shape == now_) now_ = {};
    return !contains(pending_shapes_, shape);
  }
  // The sentinel for a read of these registers, the same until proved(). Prefers fewer registers,
  // which are known to exist, to more. Count 0: requests for values use all lengths.
  Shape pick(Shape regular) {
    for (int i = 1; now_ == Shape{} && i < kMostRegisters; ++i) {
      const Shape shape{regular.function, i < regular.count ? regular.count - i : i + 1};
      if (!contains(regular_, shape) && !contains(pending_shapes_, shape)) now_ = shape;
    }
    return now_;
  }
  // The received data were not the reply to the sentinel.
  void failed() {
    if (!contains(pending_shapes_, now_)) pending_shapes_.push_back(now_);
  }
  // The sentinel's reply has arrived. Only a reply to an earlier sentinel of the same shape may be
  // pending.
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
  Shape now_;  // {}: no sentinel
};

}  // namespace mdof::drivers::modbus
