// By which requests an RTU line is proved after an error. Pure.
//
// An RTU reply says neither which request nor which register it answers; only its function and its
// length show. One slave on one wire answers in order, so the reply to a sentinel, a read of a
// length that no value is asked by, shows that every earlier request has been answered or never
// will be. A sentinel whose own reply is still owed must not be taken for a later one: after the
// next error another length is used, as in the alternating bit protocol (Bartlett, Scantlebury and
// Wilkinson 1969).
#pragma once

#include <algorithm>
#include <compare>
#include <vector>

#include "drivers/modbus/protocol.h"

namespace mdof::drivers::modbus {

// As much as an RTU reply to a read states.
struct Shape {
  int function = 0, count = 0;
  auto operator<=>(const Shape&) const = default;
};

class Sentinels {
 public:
  // Values are asked by this shape. False: the reply to a sentinel of the same shape is still owed,
  // so the line has to be proved first, by another.
  bool add_regular(Shape shape) {
    if (!contains(regular_, shape)) regular_.push_back(shape);
    if (shape == now_) now_ = {};
    return !contains(owed_, shape);
  }
  // The sentinel for a read of these registers: fewer of them, which are known to be there, before
  // more. The same until proved(). Count 0: reads of all lengths are taken.
  Shape pick(Shape regular) {
    for (int i = 1; now_ == Shape{} && i < kMostRegisters; ++i) {
      const Shape shape{regular.function, i < regular.count ? regular.count - i : i + 1};
      if (!contains(regular_, shape) && !contains(owed_, shape)) now_ = shape;
    }
    return now_;
  }
  // What came was not the sentinel's reply.
  void failed() {
    if (!contains(owed_, now_)) owed_.push_back(now_);
  }
  // It was, so nothing else is owed but a reply to the same sentinel sent before.
  void proved() {
    const bool repeated = contains(owed_, now_);
    owed_.clear();
    if (repeated) owed_.push_back(now_);
    now_ = {};
  }

 private:
  static bool contains(const std::vector<Shape>& shapes, Shape shape) {
    return std::find(shapes.begin(), shapes.end(), shape) != shapes.end();
  }
  std::vector<Shape> regular_, owed_;
  Shape now_;  // {}: none
};

}  // namespace mdof::drivers::modbus
