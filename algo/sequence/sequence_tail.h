// The next stop of a sequence that is already recognised, at a cost that does not grow with it.
#pragma once

#include <cstddef>
#include <map>
#include <utility>

#include "algo/sequence/sequence.h"
#include "algo/sequence/sequence_cycle.h"
#include "schema/point.h"

namespace mdof::algo {

// Puts stop after stop in its place as recognise_sequence() would, with the targets and the cycle
// that were recognised. What only the whole shows (another cycle, odd stops, a target between those
// that are known) waits until the whole is recognised again.
class SequenceTail {
 public:
  // Goes on from `sequence`, recognised with `options`.
  SequenceTail(const Sequence& sequence, SequenceOptions options);
  // Gives the first point that is new or changed: its errors are to be solved.
  std::size_t append(Point stop, Sequence& sequence);

 private:
  using Visited = std::pair<double, int>;  // target, direction
  bool place(MeasuredPoint& p, Sequence& sequence) const;
  int number(const MeasuredPoint& p);
  void settle_last(const MeasuredPoint& next, Sequence& sequence);

  SequenceOptions options_;
  bool by_passes_ = false;
  bool awaits_ = false;            // the last point's approach is that of the motion that follows
  Passes passes_, passes_before_;  // before the last visit
  std::map<Visited, int> visits_;
};

}  // namespace mdof::algo
