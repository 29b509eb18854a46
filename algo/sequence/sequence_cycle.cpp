#include "algo/sequence/sequence_cycle.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace mdof::algo {
namespace {

// Largest share of visits that are not in the order of the cycle.
constexpr double kMostOutOfOrder = 0.15;
// Number of such visits that are always allowed: one repeated target.
constexpr double kMostUnorderedVisits = 3;
// Smallest mean number of consecutive visits at a target in a pilgrim cycle.
constexpr double kLeastAtOnce = 1.5;

using RunNumbers = std::vector<int>;

RunNumbers runs_by_passes(const std::vector<Visit>& visits, int targets) {
  Passes passes(targets);
  RunNumbers runs;
  for (const Visit& v : visits) runs.push_back(passes.next(v));
  return runs;
}

RunNumbers runs_by_visits(const std::vector<Visit>& visits) {
  std::map<std::pair<int, int>, int> count;
  RunNumbers runs;
  for (const Visit& v : visits) runs.push_back(++count[{v.target, v.direction}]);
  return runs;
}

// Returns the number of visits that are not in the direction of their pass, or that do not follow
// the visit before in the same pass.
int out_of_order(const std::vector<Visit>& visits, const RunNumbers& runs) {
  // Key: direction and run of a pass; value: its last target.
  std::map<std::pair<int, int>, int> last;
  int count = 0;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const Visit& v = visits[i];
    const auto [pass, first] = last.try_emplace({v.direction, runs[i]}, v.target);
    const bool onward = (v.target - pass->second) * v.direction > 0;
    // The visit before with the same direction is in the same pass, because passes of one direction
    // have ascending numbers.
    count += !first && !(onward && visits[i - 1].direction == v.direction);
    pass->second = v.target;
  }
  return count;
}

// Returns whether the passes have on average at least half of the targets.
bool cover_targets(const std::vector<Visit>& visits, const RunNumbers& runs, int targets) {
  std::set<std::pair<int, int>> passes;
  for (std::size_t i = 0; i < visits.size(); ++i) passes.insert({visits[i].direction, runs[i]});
  return 2 * visits.size() >= passes.size() * static_cast<std::size_t>(targets);
}

// Returns the number of groups of consecutive visits of one target.
int blocks(const std::vector<Visit>& visits) {
  int n = 0;
  for (std::size_t i = 0; i < visits.size(); ++i)
    n += i == 0 || visits[i].target != visits[i - 1].target;
  return n;
}

bool few(int n, std::size_t of) {
  return n <= kMostOutOfOrder * static_cast<double>(of);
}

// Returns whether the axis moves in one direction only from target to target.
bool moves_in_one_direction(const std::vector<Visit>& visits) {
  int up = 0, down = 0;
  for (std::size_t i = 1; i < visits.size(); ++i) {
    up += visits[i].target > visits[i - 1].target;
    down += visits[i].target < visits[i - 1].target;
  }
  return few(std::min(up, down), static_cast<std::size_t>(up) + static_cast<std::size_t>(down));
}

bool is_pilgrim(const std::vector<Visit>& visits, int targets) {
  const int n = blocks(visits);
  return n <= targets + std::max(1, targets / 4) && moves_in_one_direction(visits) &&
         static_cast<double>(visits.size()) >= kLeastAtOnce * n;
}

// Returns whether the axis reverses outside the end targets (standard) or at the end targets
// (pendulum). With reversals outside, an end target has two consecutive visits.
Cycle by_turns(const std::vector<Visit>& visits, int targets) {
  int beyond = 0, at_target = 0;
  for (std::size_t i = 1; i < visits.size(); ++i) {
    const Visit &in = visits[i - 1], &out = visits[i];
    const int end = in.direction > 0 ? targets : 1;
    if (in.direction == out.direction || (in.target != end && out.target != end)) continue;
    ++((out.target - in.target) * out.direction > 0 ? at_target : beyond);
  }
  return at_target > beyond ? Cycle::pendulum : Cycle::standard;
}

// Returns whether all targets have about the same number of visits from both sides.
bool is_balanced(const std::vector<Visit>& visits, const RunNumbers& runs, int targets) {
  if (visits.empty()) return false;
  const int most = *std::max_element(runs.begin(), runs.end());
  return few(2 * targets * most - static_cast<int>(visits.size()), visits.size());
}

// Returns whether the axis reverses at targets, or after a few targets, along the whole travel.
bool turns_often(const std::vector<Visit>& visits, int targets) {
  std::map<int, std::pair<std::size_t, std::size_t>> seen;  // first and last visit of each target
  for (std::size_t i = 0; i < visits.size(); ++i) {
    seen.try_emplace(visits[i].target, i, i).first->second.second = i;
  }
  std::vector<int> spans;
  for (const auto& [target, span] : seen) {
    const auto [low, high] =
        std::minmax_element(visits.begin() + static_cast<std::ptrdiff_t>(span.first),
                            visits.begin() + static_cast<std::ptrdiff_t>(span.second) + 1,
                            [](const Visit& a, const Visit& b) { return a.target < b.target; });
    spans.push_back(high->target - low->target + 1);
  }
  std::sort(spans.begin(), spans.end());
  const bool local = 2 * spans[spans.size() / 2] <= targets;
  const bool at_targets = 3 * blocks(visits) <= 2 * static_cast<int>(visits.size());
  return local || at_targets;
}

}  // namespace

const char* to_string(Cycle cycle) {
  switch (cycle) {
    case Cycle::standard:
      return "standard";
    case Cycle::pendulum:
      return "pendulum";
    case Cycle::pilgrim:
      return "pilgrim";
    case Cycle::quasi_pilgrim:
      return "quasi-pilgrim";
    case Cycle::none:
      break;
  }
  return "none";
}

int Passes::next(const Visit& visit) {
  follow(visit.target);
  if (heading_ == 0) ++(visit.direction > 0 ? forward_before_ : reverse_before_);
  const bool continues = heading_ == visit.direction;
  return (visit.direction > 0 ? forward_ : reverse_) + (continues ? 0 : 1);
}

void Passes::follow(int target) {
  if (low_ == 0) low_ = high_ = target;
  low_ = std::min(low_, target);
  high_ = std::max(high_, target);
  if (heading_ <= 0 && target - low_ >= turn_) turn(1, target);
  if (heading_ >= 0 && high_ - target >= turn_) turn(-1, target);
}

void Passes::turn(int heading, int target) {
  // A short first pass counts as a pass, but a single stop before the first reversal does not.
  if (heading_ == 0 && heading < 0 && forward_before_ > 1) forward_ = 1;
  if (heading_ == 0 && heading > 0 && reverse_before_ > 1) reverse_ = 1;
  heading_ = heading;
  low_ = high_ = target;
  ++(heading > 0 ? forward_ : reverse_);
}

CycleFound recognise_cycle(const std::vector<Visit>& visits, int targets) {
  RunNumbers by_visits = runs_by_visits(visits);
  if (is_pilgrim(visits, targets)) return {Cycle::pilgrim, false, std::move(by_visits)};
  RunNumbers passes = runs_by_passes(visits, targets);
  const int wrong = out_of_order(visits, passes);
  const bool ordered = wrong <= kMostUnorderedVisits || few(wrong, visits.size());
  if (ordered && cover_targets(visits, passes, targets))
    return {by_turns(visits, targets), true, std::move(passes)};
  const bool regular = is_balanced(visits, by_visits, targets) && turns_often(visits, targets);
  return {regular ? Cycle::quasi_pilgrim : Cycle::none, false, std::move(by_visits)};
}

}  // namespace mdof::algo
