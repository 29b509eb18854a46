#include "algo/compensation/volumetric/separable.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr int kIterations = 60;

struct CommandGrid {
  std::array<std::size_t, 3> size;
  std::vector<double> value;  // the index of X changes fastest

  std::size_t index(std::size_t node, std::size_t axis) const {
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? size[0] : size[0] * size[1];
    return node / stride % size[axis];
  }
};

double largest_size(const std::vector<double>& values) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

double sum_of_products(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Returns for each node of `axis` the mean over all nodes of the other axes.
std::vector<double> mean_along(const CommandGrid& grid, std::size_t axis) {
  std::vector<double> mean(grid.size[axis], 0);
  for (std::size_t node = 0; node < grid.value.size(); ++node)
    mean[grid.index(node, axis)] += grid.value[node];
  for (double& x : mean) x *= static_cast<double>(mean.size()) / double(grid.value.size());
  return mean;
}

void subtract_axis_function(CommandGrid& grid, std::size_t axis,
                            const std::vector<double>& values) {
  for (std::size_t node = 0; node < grid.value.size(); ++node)
    grid.value[node] -= values[grid.index(node, axis)];
}

// Mean of the values over the third axis, for the axes p and q: [node of p][node of q].
using PairRows = std::vector<std::vector<double>>;
PairRows mean_of_pair(const CommandGrid& grid, std::size_t p, std::size_t q) {
  PairRows rows(grid.size[p], std::vector<double>(grid.size[q], 0));
  const double third = static_cast<double>(grid.size[3 - p - q]);
  for (std::size_t node = 0; node < grid.value.size(); ++node)
    rows[grid.index(node, p)][grid.index(node, q)] += grid.value[node] / third;
  return rows;
}

double largest_size(const PairRows& rows) {
  double most = 0;
  for (const auto& row : rows) most = std::max(most, largest_size(row));
  return most;
}

// Returns the product that is nearest to these rows by least squares. Both factors are solved
// alternately.
AxisProduct nearest_product(const PairRows& rows, std::size_t p, std::size_t q) {
  AxisProduct product{p, q, std::vector<double>(rows.size(), 0), {}};
  product.of_second = *std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return sum_of_products(a, a) < sum_of_products(b, b);
  });
  for (int i = 0; i < kIterations; ++i) {
    const double second = sum_of_products(product.of_second, product.of_second);
    for (std::size_t row = 0; row < rows.size(); ++row)
      product.of_first[row] = sum_of_products(rows[row], product.of_second) / second;
    const double first = sum_of_products(product.of_first, product.of_first);
    std::fill(product.of_second.begin(), product.of_second.end(), 0);
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t column = 0; column < rows[row].size(); ++column)
        product.of_second[column] += rows[row][column] * product.of_first[row] / first;
  }
  const double by = std::sqrt(largest_size(product.of_second) / largest_size(product.of_first));
  for (double& x : product.of_first) x *= by;
  for (double& x : product.of_second) x /= by;
  return product;
}

void subtract_products(CommandGrid& grid, std::size_t p, std::size_t q, double enough_m,
                       SeparableCorrection& sum) {
  PairRows rows = mean_of_pair(grid, p, q);
  for (int i = 0; i < kMostProducts && largest_size(rows) > enough_m; ++i) {
    const AxisProduct product = nearest_product(rows, p, q);
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t column = 0; column < rows[row].size(); ++column)
        rows[row][column] -= product.of_first[row] * product.of_second[column];
    for (std::size_t node = 0; node < grid.value.size(); ++node)
      grid.value[node] -=
          product.of_first[grid.index(node, p)] * product.of_second[grid.index(node, q)];
    sum.products.push_back(product);
  }
}

}  // namespace

SeparableCorrection separate(const VolumetricTable& table, std::size_t k, double enough_m) {
  CommandGrid grid{
      {table.command_m[0].size(), table.command_m[1].size(), table.command_m[2].size()}, {}};
  for (const Vec3& node : table.correction_m) grid.value.push_back(node[k]);
  SeparableCorrection sum;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (grid.size[axis] < 2) continue;
    sum.along[axis] = mean_along(grid, axis);
    subtract_axis_function(grid, axis, sum.along[axis]);
  }
  for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}})
    if (grid.size[p] > 1 && grid.size[q] > 1) subtract_products(grid, p, q, enough_m, sum);
  sum.left_m = largest_size(grid.value);
  return sum;
}

}  // namespace mdof::algo
