// The map of a scan is compared with a simple version of the same fit. The simple version checks
// every cell for every pixel and orthogonalises the columns by the Gram-Schmidt method with
// pivoting.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "algo/form/scan_map.h"
#include "tests/algo/no_pattern.h"

namespace mdof::algo {
namespace {

struct MeanOfCell {
  double n = 0, x = 0, y = 0, z = 0;
};

// Means of the points in each cell. The width of a cell is a quarter of a pixel.
std::vector<MeanOfCell> expected_cell_means(const ScanPoints& points, double pixel_m) {
  std::map<std::pair<long, long>, MeanOfCell> cells;
  for (std::size_t i = 0; i < points.z_m.size(); ++i) {
    MeanOfCell& cell = cells[{std::lround(points.x_m[i] / (pixel_m / 4)),
                              std::lround(points.y_m[i] / (pixel_m / 4))}];
    cell.n += 1;
    cell.x += points.x_m[i];
    cell.y += points.y_m[i];
    cell.z += points.z_m[i];
  }
  std::vector<MeanOfCell> means;
  for (const auto& [where, sum] : cells)
    means.push_back({sum.n, sum.x / sum.n, sum.y / sum.n, sum.z / sum.n});
  return means;
}

using ColumnOfFit = std::vector<double>;

double column_product(const ColumnOfFit& a, const ColumnOfFit& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Columns in descending order of the parts that are independent of the columns before. `pivot`: the
// lengths of these parts. `first`: the coefficient of given[0] in the least-squares fit of b.
struct Orthogonal {
  std::vector<double> pivot;
  double first = 0;
};

Orthogonal orthogonalised(std::vector<ColumnOfFit> columns, ColumnOfFit b) {
  Orthogonal out;
  const std::vector<ColumnOfFit> given = columns;
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < columns.size(); ++k) left.push_back(k);
  while (!left.empty()) {
    std::size_t best = 0;
    for (std::size_t k = 0; k < left.size(); ++k)
      if (column_product(columns[left[k]], columns[left[k]]) >
          column_product(columns[left[best]], columns[left[best]]))
        best = k;
    const ColumnOfFit q = columns[left[best]];
    const double square = column_product(q, q);
    out.pivot.push_back(std::sqrt(square));
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    for (const std::size_t k : left) {
      const double part = column_product(q, columns[k]) / square;
      for (std::size_t i = 0; i < q.size(); ++i) columns[k][i] -= part * q[i];
    }
  }
  // The coefficient follows from the part of given[0] that is orthogonal to all other columns
  // (Frisch, Waugh).
  ColumnOfFit across = given[0];
  std::vector<ColumnOfFit> others(given.begin() + 1, given.end());
  for (std::size_t k = 0; k < others.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const double part =
          column_product(others[j], others[k]) / column_product(others[j], others[j]);
      for (std::size_t i = 0; i < b.size(); ++i) others[k][i] -= part * others[j][i];
    }
    const double part = column_product(others[k], across) / column_product(others[k], others[k]);
    for (std::size_t i = 0; i < b.size(); ++i) across[i] -= part * others[k][i];
  }
  out.first = column_product(across, b) / column_product(across, given[0]);
  return out;
}

struct Expected {
  double z_m = SurfaceMap::kMissing;
  bool is_close = false;  // a decision is so close that rounding may change it
};

Expected expected_at(const std::vector<MeanOfCell>& cells, double x_m, double y_m, double pixel_m) {
  Expected expected;
  for (const double reach : {1.5, 2.25, 3.375, 5.0625}) {
    std::vector<ColumnOfFit> columns(6);
    ColumnOfFit b;
    double off_x = 0, off_y = 0;
    for (const MeanOfCell& cell : cells) {
      const double x = (cell.x - x_m) / (reach * pixel_m), y = (cell.y - y_m) / (reach * pixel_m);
      expected.is_close = expected.is_close || std::abs(x * x + y * y - 1) < 1e-9;
      if (x * x + y * y > 1) continue;
      const double w = std::sqrt(cell.n);
      const std::array<double, 6> row = {1, x, y, x * x, x * y, y * y};
      for (std::size_t k = 0; k < 6; ++k) columns[k].push_back(w * row[k]);
      b.push_back(w * cell.z);
      off_x += x;
      off_y += y;
    }
    const double off = std::hypot(off_x, off_y), most = 0.3 * static_cast<double>(b.size());
    expected.is_close = expected.is_close || (!b.empty() && std::abs(off - most) < 1e-9);
    if (off > most || b.size() < 9) continue;
    const Orthogonal fit = orthogonalised(columns, b);
    const double share = fit.pivot.back() / fit.pivot.front();
    expected.is_close = expected.is_close || std::abs(share - 0.02) < 1e-9;
    if (share <= 0.02) continue;
    expected.z_m = fit.first;
    break;
  }
  return expected;
}

// The points are dense on one side and sparse on the other. Some points are almost at the same
// place.
ScanPoints scattered(unsigned seed, std::size_t n) {
  test::NoPattern random(seed);
  ScanPoints points;
  for (std::size_t i = 0; i < n; ++i) {
    const double u = random.between(0, 1);
    points.x_m.push_back(-3.3e-3 + 16e-3 * u * u);
    points.y_m.push_back(random.between(2.2e-3, 13.7e-3));
    points.z_m.push_back(random.between(-1e-6, 1e-6));
    if (i % 5 != 0) continue;
    points.x_m.push_back(points.x_m.back() + 0.01e-3);
    points.y_m.push_back(points.y_m.back() - 0.01e-3);
    points.z_m.push_back(random.between(-1e-6, 1e-6));
  }
  return points;
}

TEST(ScanMapByHand, MatchesTheSimpleFit) {
  constexpr double kPixel_m = 1e-3;
  std::size_t heights = 0, missing = 0;
  for (const auto& [seed, n] : {std::pair(1u, 60u), std::pair(2u, 140u), std::pair(3u, 500u)}) {
    const ScanPoints points = scattered(seed, n);
    const auto found = scan_map(points, kPixel_m);
    ASSERT_TRUE(found) << found.error().message;
    const SurfaceMap* const map = &found->map;
    const auto cells = expected_cell_means(points, kPixel_m);
    for (std::size_t j = 0; j < map->ny; ++j)
      for (std::size_t i = 0; i < map->nx; ++i) {
        const Expected expected = expected_at(cells, map->x_m(i), map->y_m(j), kPixel_m);
        if (expected.is_close) continue;
        const double z = map->at(i, j);
        ASSERT_EQ(std::isnan(z), std::isnan(expected.z_m)) << seed << ' ' << i << ' ' << j;
        (std::isnan(z) ? missing : heights) += 1;
        if (!std::isnan(z)) {
          ASSERT_NEAR(z, expected.z_m, 1e-15) << seed << ' ' << i << ' ' << j;
        }
      }
  }
  EXPECT_GT(heights, 200u);
  EXPECT_GT(missing, 50u);
}

// The positions of pixels are whole multiples of their size. A pixel with points on one side only
// has no height. Rows without heights are omitted.
TEST(ScanMapByHand, MapEndsWhereItsHeightsEnd) {
  ScanPoints points;
  for (int j = 0; j <= 24; ++j)
    for (int i = 0; i <= 30; ++i) {
      points.x_m.push_back(-2.6e-3 + 0.25e-3 * i);
      points.y_m.push_back(1.1e-3 + 0.25e-3 * j);
      points.z_m.push_back(3e-6);
    }
  const auto found = scan_map(points, 1e-3);
  ASSERT_TRUE(found) << found.error().message;
  const SurfaceMap* const map = &found->map;
  EXPECT_NEAR(map->x0_m, -2e-3, 1e-15);
  EXPECT_NEAR(map->y0_m, 2e-3, 1e-15);
  EXPECT_EQ(map->nx, 7u);  // -2 ... 4 mm; the points are at -2.6 to 4.9 mm
  EXPECT_EQ(map->ny, 5u);  // 2 ... 6 mm; the points are at 1.1 to 7.1 mm
  EXPECT_EQ(map->dx_m, 1e-3);
  EXPECT_EQ(map->dy_m, 1e-3);
  for (const double z : map->z_m) EXPECT_NEAR(z, 3e-6, 1e-15);
}

// One point every quarter of a pixel from (0, 0) on. The heights of a paraboloid must be exact.
TEST(ScanMapByHand, ParaboloidIsExact) {
  constexpr double kPixel_m = 1e-3;
  ScanPoints points;
  const auto height = [](double x, double y) { return 2e-6 + 0.5 * x * x - 0.3 * y * y + x * y; };
  for (int j = 0; j <= 40; ++j)
    for (int i = 0; i <= 40; ++i) {
      points.x_m.push_back(kPixel_m / 4 * i);
      points.y_m.push_back(kPixel_m / 4 * j);
      points.z_m.push_back(height(points.x_m.back(), points.y_m.back()));
    }
  const auto scan = scan_map(points, kPixel_m);
  ASSERT_TRUE(scan) << scan.error().message;
  EXPECT_GE(scan->map.measured(), 49U);
  for (std::size_t j = 0; j < scan->map.ny; ++j)
    for (std::size_t i = 0; i < scan->map.nx; ++i)
      if (const double z = scan->map.at(i, j); !std::isnan(z)) {
        EXPECT_NEAR(z, height(scan->map.x_m(i), scan->map.y_m(j)), 1e-14) << i << " " << j;
      }
}

}  // namespace
}  // namespace mdof::algo
