#include "algo/form/scan_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "algo/form/map_figures.h"
#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {
namespace {

constexpr double kLeastReach = 1.5, kFarthestReach = 6, kReachStep = 1.5;  // in pixels
constexpr double kMostOneSided = 0.3;  // largest distance of the points' mean from the pixel,
                                       // relative to the radius
constexpr double kRankTolerance = 0.02;
constexpr int kParabolaTerms = 6, kLeastCells = 9;
constexpr std::size_t kCellsPerPixel = 4;

// Number, mean place and mean height of the points in a square of a quarter of a pixel side.
struct Cell {
  double n = 0, x = 0, y = 0, z = 0;
};

class Cells {
 public:
  Cells(const ScanPoints& points, const SurfaceMap& map)
      : size_m_(map.dx_m / static_cast<double>(kCellsPerPixel)),
        x0_m_(map.x0_m),
        y0_m_(map.y0_m),
        nx_(map.nx * kCellsPerPixel),
        ny_(map.ny * kCellsPerPixel),
        cells_(nx_ * ny_) {
    for (std::size_t i = 0; i < points.z_m.size(); ++i) {
      Cell& cell = cells_[row(points.y_m[i], y0_m_, ny_) * nx_ + row(points.x_m[i], x0_m_, nx_)];
      cell.n += 1;
      cell.x += points.x_m[i];
      cell.y += points.y_m[i];
      cell.z += points.z_m[i];
    }
    for (Cell& cell : cells_)
      for (double* const sum : {&cell.x, &cell.y, &cell.z})
        if (cell.n > 0) *sum /= cell.n;
  }

  // Finds the cells whose mean place is nearer to (x_m, y_m) than the radius reach_m. x and y of
  // the found cells are relative to (x_m, y_m), in units of the radius.
  void around(double x_m, double y_m, double reach_m, std::vector<Cell>& found) const {
    found.clear();
    const std::size_t left = row(x_m - reach_m, x0_m_, nx_), right = row(x_m + reach_m, x0_m_, nx_);
    const std::size_t low = row(y_m - reach_m, y0_m_, ny_), high = row(y_m + reach_m, y0_m_, ny_);
    for (std::size_t j = low; j <= high; ++j)
      for (std::size_t i = left; i <= right; ++i) {
        const Cell& cell = cells_[j * nx_ + i];
        if (cell.n == 0) continue;
        const double x = (cell.x - x_m) / reach_m, y = (cell.y - y_m) / reach_m;
        if (x * x + y * y <= 1) found.push_back({cell.n, x, y, cell.z});
      }
  }

 private:
  std::size_t row(double at_m, double from_m, std::size_t count) const {
    const double k = std::floor((at_m - from_m) / size_m_ + 0.5);
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(count - 1)));
  }

  double size_m_, x0_m_, y0_m_;
  std::size_t nx_, ny_;
  std::vector<Cell> cells_;
};

bool is_one_sided(const std::vector<Cell>& cells) {
  double x = 0, y = 0;
  for (const Cell& cell : cells) {
    x += cell.x;
    y += cell.y;
  }
  return std::hypot(x, y) > kMostOneSided * static_cast<double>(cells.size());
}

// Height of the fitted parabola at the pixel.
struct Fitted {
  double z_m = SurfaceMap::kMissing;  // missing if the points do not determine the parabola
  double variance = 0;                // variance of z_m if each point has the variance 1
  // Sum of squares of the residuals, for the variance of one point, and its degrees of freedom.
  double squares = 0, freedom = 0;
};

Fitted fitted(const std::vector<Cell>& cells) {
  Fitted found;
  if (cells.size() < kLeastCells) return found;
  Eigen::MatrixXd A(static_cast<Eigen::Index>(cells.size()), kParabolaTerms);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Cell& c = cells[static_cast<std::size_t>(i)];
    const double w = std::sqrt(c.n);
    A.row(i) << w, w * c.x, w * c.y, w * c.x * c.x, w * c.x * c.y, w * c.y * c.y;
    b[i] = w * c.z;
  }
  const LeastSquares fit(A, kRankTolerance);
  if (fit.rank() < kParabolaTerms) return found;
  const Eigen::VectorXd x = fit.solve(b);
  found.z_m = x[0];
  found.squares = (b - A * x).squaredNorm();
  found.freedom = static_cast<double>(A.rows() - kParabolaTerms);
  const Eigen::MatrixXd normal = A.transpose() * A;
  Eigen::VectorXd first = Eigen::VectorXd::Zero(kParabolaTerms);
  first[0] = 1;
  found.variance = LeastSquares(normal).solve(first)[0];
  return found;
}

Fitted pixel_height(const Cells& cells, double x_m, double y_m, double pixel_m,
                    std::vector<Cell>& scratch) {
  for (double reach = kLeastReach; reach <= kFarthestReach; reach *= kReachStep) {
    cells.around(x_m, y_m, reach * pixel_m, scratch);
    if (is_one_sided(scratch)) continue;
    const Fitted found = fitted(scratch);
    if (!std::isnan(found.z_m)) return found;
  }
  return {};
}

// Range of the pixels in one direction. Pixels are at integer multiples of pixel_m, up to the first
// multiple beyond the points.
void set_range(const std::vector<double>& at_m, double pixel_m, double& from_m, double& count) {
  const auto [least, most] = std::minmax_element(at_m.begin(), at_m.end());
  const double first = std::floor(*least / pixel_m), last = std::ceil(*most / pixel_m);
  from_m = first * pixel_m;
  count = last - first + 1;
}

// Removes the outer rows and columns that have no height.
ScanMap without_empty_edges(ScanMap scan) {
  const SurfaceMap map = scan.map, u = scan.u;
  const auto [left, right, low, high] = measured_extent(map);
  for (SurfaceMap* const part : {&scan.map, &scan.u}) {
    part->x0_m = map.x_m(left);
    part->y0_m = map.y_m(low);
    part->nx = right - left + 1;
    part->ny = high - low + 1;
    part->z_m.clear();
    for (std::size_t j = low; j <= high; ++j)
      for (std::size_t i = left; i <= right; ++i)
        part->z_m.push_back((part == &scan.map ? map : u).at(i, j));
  }
  return scan;
}

}  // namespace

Result<ScanMap> scan_map(const ScanPoints& points, double pixel_m) {
  if (points.z_m.empty()) return bad_input("the scan contains no heights");
  ScanMap scan;
  SurfaceMap& map = scan.map;
  map.dx_m = map.dy_m = pixel_m;
  double nx = 0, ny = 0;
  set_range(points.x_m, pixel_m, map.x0_m, nx);
  set_range(points.y_m, pixel_m, map.y0_m, ny);
  constexpr std::size_t kMostScanPixels = kMostPixels / (kCellsPerPixel * kCellsPerPixel);
  if (!(nx * ny <= static_cast<double>(kMostScanPixels)))
    return bad_input("pixels of " + std::to_string(pixel_m * 1e3) +
                     " mm divide this scan into more than " + std::to_string(kMostScanPixels) +
                     " pixels; use larger pixels");
  map.nx = static_cast<std::size_t>(nx);
  map.ny = static_cast<std::size_t>(ny);
  map.z_m.assign(map.nx * map.ny, SurfaceMap::kMissing);
  scan.u = map;
  const Cells cells(points, map);
  std::vector<Cell> scratch;
  double squares = 0, freedom = 0;
  for (std::size_t j = 0; j < map.ny; ++j)
    for (std::size_t i = 0; i < map.nx; ++i) {
      const Fitted found = pixel_height(cells, map.x_m(i), map.y_m(j), pixel_m, scratch);
      map.z_m[j * map.nx + i] = found.z_m;
      if (std::isnan(found.z_m)) continue;
      squares += found.squares;
      freedom += found.freedom;
      scan.u.z_m[j * map.nx + i] = std::sqrt(found.variance);
    }
  scan.noise_m = std::sqrt(squares / std::max(1.0, freedom));
  for (double& u : scan.u.z_m) u *= scan.noise_m;
  if (map.measured() > 0) return without_empty_edges(std::move(scan));
  return bad_input("no pixel of " + std::to_string(pixel_m * 1e3) +
                   " mm has enough heights around it; use larger pixels, or scan more densely");
}

}  // namespace mdof::algo
