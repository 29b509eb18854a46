// Adds the next stop to a recognised sequence, at a cost that does not grow with the sequence.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

#include "algo/sequence/sequence.h"
#include "algo/sequence/sequence_cycle.h"
#include "schema/point.h"

namespace mdof::algo {

// Assigns stop after stop as recognise_sequence() does, with the recognised targets and cycle.
// Facts that only the whole sequence shows (another cycle, odd stops, a target between known ones)
// wait until the whole is recognised again.
class SequenceTail {
 public:
  // Continues `sequence`, which was recognised with `options`.
  SequenceTail(const Sequence& sequence, SequenceOptions options);
  // Returns the index of the first new or changed point, whose errors must be solved.
  std::size_t append(Point stop, Sequence& sequence);

 private:
  using Visited = std::pair<double, int>;  // target, direction
  bool place(MeasuredPoint& p, Sequence& sequence) const;
  int number(const MeasuredPoint& p);
  void set_last_direction(const MeasuredPoint& next, Sequence& sequence);

  SequenceOptions options_;
  bool by_passes_ = false;
  bool awaits_direction_ = false;  // the last point has the approach of the next motion
  Passes passes_, passes_before_;  // passes_before_: before the last visit
  std::map<Visited, int> visits_;
};

}  // namespace mdof::algo
