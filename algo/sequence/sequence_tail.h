// Adds the next stop to a recognised sequence. The calculation time does not depend on the length
// of the sequence.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

#include "algo/sequence/sequence.h"
#include "algo/sequence/sequence_cycle.h"
#include "schema/point.h"

namespace mdof::algo {

// Assigns each stop as recognise_sequence() does, with the targets and the cycle that are already
// recognised. Some changes are only found when the whole sequence is recognised again: another
// cycle, stops at no target, a new target between known targets.
class SequenceTail {
 public:
  // Continues `sequence`, which was recognised with `options`.
  SequenceTail(const Sequence& sequence, SequenceOptions options);
  // Returns the index of the first new or changed point. The errors of the points from this index
  // on must be solved.
  std::size_t append(Point stop, Sequence& sequence);

 private:
  using Visited = std::pair<double, int>;  // target, direction
  bool place(MeasuredPoint& p, Sequence& sequence) const;
  int number(const MeasuredPoint& p);
  void set_last_direction(const MeasuredPoint& next, Sequence& sequence);

  SequenceOptions options_;
  bool by_passes_ = false;
  // True: the approach of the last point will be the direction of the next motion.
  bool awaits_direction_ = false;
  Passes passes_, passes_before_;  // passes_before_: state before the last visit
  std::map<Visited, int> visits_;
};

}  // namespace mdof::algo
