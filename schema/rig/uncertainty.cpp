#include "schema/rig/uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/number/number_text.h"

namespace mdof {
namespace {

struct ShapeName {
  UncertaintyShape shape;
  const char* name;
  double half_width_by_u;  // half width / standard uncertainty; 0: the distribution has no limits
};
// JCGM 101 table 1; GUM 4.3.7, 4.3.9.
const std::array<ShapeName, 4> kShapes = {{
    {UncertaintyShape::normal, "normal", 0},
    {UncertaintyShape::rectangular, "rectangular", std::sqrt(3.0)},
    {UncertaintyShape::triangular, "triangular", std::sqrt(6.0)},
    {UncertaintyShape::u_shaped, "u-shaped", std::sqrt(2.0)},
}};

const ShapeName& shape_of(UncertaintyShape shape) {
  return kShapes[static_cast<std::size_t>(shape)];
}

struct Declared {
  std::vector<double> u;  // in the unit of the key
  UncertaintyShape shape = UncertaintyShape::normal;
  double freedom = std::numeric_limits<double>::infinity();
};

std::vector<double> numbers_of(TomlTable& table, std::string_view key) {
  if (table.is_array(key)) return table.numbers(key);
  return {table.number(key)};
}

const ShapeName& read_shape(TomlTable& table) {
  const std::string name = table.string("distribution", "normal");
  for (const ShapeName& shape : kShapes)
    if (name == shape.name) return shape;
  table.reject("distribution", "\"" + name +
                                   "\" is not one of \"normal\", \"rectangular\", \"triangular\", "
                                   "\"u-shaped\"");
  return kShapes[0];
}

Declared read_inline(TomlTable& table) {
  Declared declared;
  const ShapeName& shape = read_shape(table);
  declared.shape = shape.shape;
  if (table.has("u") == table.has("half_width"))
    table.reject(table.has("u") ? "half_width" : "u",
                 "give either \"u\" (standard uncertainty) or \"half_width\" (half of the distance "
                 "between the limits)");
  if (table.has("half_width")) {
    declared.u = numbers_of(table, "half_width");
    if (shape.half_width_by_u == 0)
      table.reject("half_width",
                   "a normal distribution has no limits, so it has no half_width; give \"u\" "
                   "instead, or another distribution");
    for (double& u : declared.u) u /= shape.half_width_by_u;
  } else {
    declared.u = numbers_of(table, "u");
  }
  if (table.has("dof")) declared.freedom = table.number("dof");
  if (!(declared.freedom >= 1))
    table.reject("dof", "must be a number of degrees of freedom, 1 or greater");
  return declared;
}

Declared read(TomlTable& table, std::string_view key, double most) {
  if (!table.has(key)) return {};
  Declared declared;
  if (table.is_table(key)) {
    auto inside = table.table(key);
    declared = read_inline(*inside);
  } else {
    declared.u = numbers_of(table, key);
  }
  if (declared.u.empty()) table.reject(key, "must not be empty; give numbers, or remove the key");
  for (const double u : declared.u) check_uncertainty(table, key, u, most);
  return declared;
}

}  // namespace

const char* to_string(UncertaintyShape shape) {
  return shape_of(shape).name;
}

void check_uncertainty(TomlTable& table, std::string_view key, double u, double most) {
  if (u >= 0 && u <= most) return;
  table.reject(key, "must be a standard uncertainty from 0 to " + plain_number(most) + ", not " +
                        plain_number(u) + "; check the unit, which the name of the key states");
}

DeclaredUncertainty read_uncertainty(TomlTable& table, std::string_view key, double to_si,
                                     double most) {
  const Declared declared = read(table, key, most);
  if (declared.u.empty()) return {};
  if (declared.u.size() != 1) table.reject(key, "must be one number");
  return {declared.u[0] * to_si, declared.shape, declared.freedom, declared.u[0] == 0};
}

DeclaredUncertainty3 read_uncertainty3(TomlTable& table, std::string_view key, double to_si,
                                       double most) {
  const Declared declared = read(table, key, most);
  if (declared.u.empty()) return {};
  DeclaredUncertainty3 three{{}, declared.shape, declared.freedom};
  if (declared.u.size() != 3 && declared.u.size() != 1)
    table.reject(key,
                 "must be three numbers (for X, Y and Z), or one number for all three directions");
  for (std::size_t k = 0; k < 3; ++k)
    three.u[k] = declared.u[std::min(k, declared.u.size() - 1)] * to_si;
  three.zero = !three.declared();
  return three;
}

}  // namespace mdof
