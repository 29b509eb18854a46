#include "schema/form/map_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr std::size_t kMostPlaces = std::size_t{1} << 20;  // columns or rows
constexpr double kGridTolerance = 0.05;         // largest deviation from the grid / pixel size
constexpr std::size_t kMaxPixelsPerPoint = 64;  // largest ratio of pixels to points

// Collects distinct values in a hash table of their bits with open addressing.
class Distinct {
 public:
  Distinct() : slot_(4096, kEmpty) {}
  void add(double x) {
    x += 0.0;  // -0 is 0
    if (x == last_) return;
    last_ = x;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    std::size_t k = place(bits);
    if (slot_[k] == bits) return;
    slot_[k] = bits;
    if (++count_ * 2 > slot_.size()) grow();
  }
  std::size_t count() const { return count_; }
  std::vector<double> sorted() const {
    std::vector<double> values;
    for (const std::uint64_t bits : slot_)
      if (bits != kEmpty) values.push_back(std::bit_cast<double>(bits));
    std::sort(values.begin(), values.end());
    return values;
  }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};  // a NaN, which is not a position
  std::size_t place(std::uint64_t bits) const {
    std::size_t k = (bits * 0x9e3779b97f4a7c15u) >> 20 & (slot_.size() - 1);
    while (slot_[k] != kEmpty && slot_[k] != bits) k = (k + 1) & (slot_.size() - 1);
    return k;
  }
  void grow() {
    std::vector<std::uint64_t> old(slot_.size() * 2, kEmpty);
    old.swap(slot_);
    for (const std::uint64_t bits : old)
      if (bits != kEmpty) slot_[place(bits)] = bits;
  }
  std::vector<std::uint64_t> slot_;
  std::size_t count_ = 0;
  double last_ = std::numeric_limits<double>::quiet_NaN();
};

struct Steps {
  double first_m = 0, step_m = 0;  // step 0: only one position
  std::size_t count = 0;

  // Returns the index of the grid position at x_m; npos: x_m is at no grid position.
  static constexpr std::size_t npos = ~std::size_t{0};
  std::size_t index(double x_m) const {
    if (count == 1) return 0;
    const double steps = (x_m - first_m) / step_m, nearest = std::nearbyint(steps);
    return std::abs(steps - nearest) > kGridTolerance ? npos : static_cast<std::size_t>(nearest);
  }
};

std::string mm(double x_m) {
  return plain_number(to_mm(x_m), 9);
}

Result<Steps> steps_of(const std::vector<double>& places, char axis, const std::string& source) {
  Distinct distinct;
  for (const double x : places) {
    distinct.add(x);
    if (distinct.count() > kMostPlaces)
      return bad_input(source + ": has more than " + std::to_string(kMostPlaces) +
                       " different values of " + axis +
                       "_mm, so the points are not on a grid; "
                       "resample the points to rows and columns");
  }
  const std::vector<double> value = distinct.sorted();
  const double span = value.back() - value.front();
  if (!(span > 0)) return Steps{value.front(), 0, 1};
  // Values whose difference is only rounding count as the same value.
  double least = span;
  for (std::size_t k = 1; k < value.size(); ++k)
    if (const double gap = value[k] - value[k - 1]; gap > 1e-9 * span) least = std::min(least, gap);
  std::vector<double> single;  // distances of one step
  for (std::size_t k = 1; k < value.size(); ++k)
    if (const double gap = value[k] - value[k - 1]; gap > 1e-9 * span && gap < 1.5 * least)
      single.push_back(gap);
  std::nth_element(single.begin(), single.begin() + static_cast<std::ptrdiff_t>(single.size() / 2),
                   single.end());
  const double step = single[single.size() / 2];
  double total = 0;
  for (std::size_t k = 1; k < value.size(); ++k)
    if (const double gap = value[k] - value[k - 1]; gap > 1e-9 * span)
      total += std::max(1.0, std::nearbyint(gap / step));
  if (total >= static_cast<double>(kMostPlaces))
    return bad_input(
        source + ": the smallest distance of two values of " + axis + "_mm is " + mm(least) +
        " mm, but all values cover " + mm(span) +
        " mm, so the points are not on a regular grid; resample the points to rows and columns");
  return Steps{value.front(), span / total, static_cast<std::size_t>(total) + 1};
}

tl::unexpected<Error> off_grid(const std::string& place, char axis, double x_m,
                               const Steps& steps) {
  return bad_input(place + std::string(1, axis) + "_mm = " + mm(x_m) +
                   " is not on the grid (step " + mm(steps.step_m) + " mm, first value " +
                   mm(steps.first_m) + " mm); resample the points to rows and columns");
}

}  // namespace

Result<SurfaceMap> grid_of(const MapPoints& points, const std::string& source,
                           const std::function<std::string(std::size_t)>& place) {
  if (points.z_m.empty())
    return bad_input(source + ": has no points; write one row x, y, z for each point");
  MDOF_TRY(const Steps columns, steps_of(points.x_m, 'x', source));
  MDOF_TRY(const Steps rows, steps_of(points.y_m, 'y', source));
  if (columns.count == 1 && rows.count == 1)
    return bad_input(source +
                     ": all points have the same position; a map needs at least two pixels");
  if (columns.count > kMostPixels / rows.count ||
      columns.count * rows.count / kMaxPixelsPerPoint > points.z_m.size() + 1000)
    return bad_input(source + ": " + std::to_string(points.z_m.size()) +
                     " points are too few for a grid of " + std::to_string(columns.count) + " x " +
                     std::to_string(rows.count) +
                     " pixels; resample the points to rows and columns");
  SurfaceMap map;
  map.name = source;
  map.x0_m = columns.first_m;
  map.y0_m = rows.first_m;
  map.dx_m = columns.count > 1 ? columns.step_m : rows.step_m;
  map.dy_m = rows.count > 1 ? rows.step_m : columns.step_m;
  map.nx = columns.count;
  map.ny = rows.count;
  map.z_m.assign(map.nx * map.ny, SurfaceMap::kMissing);
  std::vector<bool> taken(map.z_m.size());
  for (std::size_t k = 0; k < points.z_m.size(); ++k) {
    const std::size_t i = columns.index(points.x_m[k]), j = rows.index(points.y_m[k]);
    if (i == Steps::npos) return off_grid(place(k), 'x', points.x_m[k], columns);
    if (j == Steps::npos) return off_grid(place(k), 'y', points.y_m[k], rows);
    if (taken[j * map.nx + i])
      return bad_input(place(k) + "the file contains a second height at x = " + mm(points.x_m[k]) +
                       " mm, y = " + mm(points.y_m[k]) + " mm; give one row for each pixel");
    taken[j * map.nx + i] = true;
    map.z_m[j * map.nx + i] = points.z_m[k];
  }
  if (map.measured() == 0)
    return bad_input(source + ": no pixel has a height (all are empty or nan)");
  return map;
}

}  // namespace mdof
