#include "algo/separation/shared_readings.h"

#include <algorithm>
#include <string>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kLeastPositions = 3;
constexpr std::size_t kMostNamed = 10;

template <class Value>
void keep(std::vector<Value>& values, const std::vector<bool>& kept) {
  if (values.size() != kept.size()) return;  // for example no u
  std::size_t to = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) values[to++] = values[i];
  values.resize(to);
}

// Removes the points to which no reading refers.
void keep_used(std::vector<double>& points, std::vector<std::size_t>& at) {
  std::vector<std::size_t> used = at;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::size_t i = 0; i < used.size(); ++i) points[i] = points[used[i]];
  points.resize(used.size());
  for (std::size_t& i : at)
    i = static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), i) - used.begin());
}

Notice left_out(const SetUp& set_up, std::size_t number, const std::vector<bool>& kept) {
  std::string positions_mm;
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (!kept[i] && count++ < kMostNamed)
      positions_mm +=
          (positions_mm.empty() ? "" : ", ") + plain_number(to_mm(set_up.position_m[i]), 7);
  if (count > kMostNamed) positions_mm += ", ...";
  return notice(NoticeCode::readings_of_one_set_up, "",
                {{"left_out", count},
                 {"of", kept.size()},
                 {"set_up", number},
                 {"positions_mm", positions_mm}});
}

}  // namespace

std::vector<bool> are_shared(const std::vector<std::size_t>& at,
                             const std::vector<SetUp>& set_ups) {
  std::vector<std::size_t> first_set_up(at.size(), set_ups.size());
  std::vector<bool> shared(at.size());
  std::size_t row = 0;
  for (std::size_t k = 0; k < set_ups.size(); ++k)
    for (std::size_t i = 0; i < set_ups[k].position_m.size(); ++i) {
      const std::size_t point = at[row++];
      if (first_set_up[point] == set_ups.size()) first_set_up[point] = k;
      if (first_set_up[point] != k) shared[point] = true;
    }
  return shared;
}

Result<SharedReadings> shared_readings(std::vector<SetUp> set_ups, Grid grid) {
  const std::vector<bool> position = are_shared(grid.at_position, set_ups);
  const std::vector<bool> place = are_shared(grid.at_place, set_ups);
  SharedReadings found;
  std::vector<bool> all_kept;
  for (std::size_t k = 0; k < set_ups.size(); ++k) {
    SetUp& set_up = set_ups[k];
    std::vector<bool> kept;
    for (std::size_t i = 0; i < set_up.position_m.size(); ++i) {
      const std::size_t row = all_kept.size();
      kept.push_back(position[grid.at_position[row]] || place[grid.at_place[row]]);
      all_kept.push_back(kept.back());
    }
    const auto left = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
    if (left == 0)
      return bad_input("set-up " + std::to_string(k + 1) +
                       " has no position of the axis and no place on the target in common with "
                       "another set-up; measure it at the same positions as another set-up, or "
                       "leave this set-up out");
    if (left < kept.size()) found.notices.push_back(left_out(set_up, k + 1, kept));
    keep(set_up.position_m, kept);
    keep(set_up.error_m, kept);
    keep(set_up.u_m, kept);
    for (DeclaredShift& declared : set_up.declared) keep(declared.shift_m, kept);
  }
  keep(grid.at_position, all_kept);
  keep(grid.at_place, all_kept);
  keep_used(grid.position_m, grid.at_position);
  keep_used(grid.place_m, grid.at_place);
  if (grid.position_m.size() < kLeastPositions)
    return bad_input("the set-ups have " + std::to_string(grid.position_m.size()) +
                     " positions in common, but at least 3 are needed; measure at the same "
                     "positions in all set-ups");
  found.set_ups = std::move(set_ups);
  found.grid = std::move(grid);
  return found;
}

}  // namespace mdof::algo
