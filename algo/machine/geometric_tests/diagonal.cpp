#include "algo/machine/geometric_tests/diagonal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algo/uncertainty/coverage.h"

namespace mdof::algo {
namespace {

constexpr std::string_view kAxisNames = "XYZ";

struct Corner {
  std::size_t first, second;
  std::array<double, 2> first_range, second_range;  // commands at begin and end of the diagonal
};

Diagonal along(const Machine& machine, const Corner& c, std::size_t steps,
               MachineApproach approach) {
  Diagonal d;
  d.name = std::string(kAxisNames.substr(c.first, 1)) +
           (c.first_range[1] > c.first_range[0] ? "+" : "-") +
           std::string(kAxisNames.substr(c.second, 1)) + "+";
  const auto command = [&c](double part) {
    Command at{};
    at[c.first] = c.first_range[0] + (c.first_range[1] - c.first_range[0]) * part;
    at[c.second] = c.second_range[0] + (c.second_range[1] - c.second_range[0]) * part;
    return at;
  };
  const Eigen::Vector3d begin = nominal_tool(machine, command(0)).p;
  const Eigen::Vector3d way = nominal_tool(machine, command(1)).p - begin;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(steps);
    const ToolError e = tool_error(machine, command(part), approach);
    d.position_m.push_back(way.norm() * part);
    d.deviation_m.push_back(e.exact.head<3>().dot(way.normalized()));
    for (std::size_t k = 0; k < 3; ++k) add_new(e.not_measured[k], d.not_measured);
    add_new(e.beyond, d.beyond);
  }
  const double zero = d.deviation_m.front();
  for (double& x : d.deviation_m) x -= zero;
  const auto [low, high] = std::minmax_element(d.deviation_m.begin(), d.deviation_m.end());
  d.range_m = *high - *low;
  return d;
}

struct Length {
  double mean = 0, squares = 0, readings = 0;  // squares: sum of squares of the readings about
                                               // their mean
  double freedom() const { return std::max(0.0, readings - 1); }
};

Length length_of(const MeasuredLine& line) {
  Length l;
  if (line.length_m.empty()) return l;
  l.readings = static_cast<double>(line.length_m.size());
  for (const double x : line.length_m) l.mean += (x - line.length_m[0]) / l.readings;
  l.mean += line.length_m[0];
  for (const double x : line.length_m) l.squares += (x - l.mean) * (x - l.mean);
  return l;
}

// Uncertainty of the angle due to the repeatability of the lines, with degrees of freedom.
// slope[i]: ∂ angle / ∂ length of line i. Usually each line is one part of the uncertainty. If a
// line was measured only once, its repeatability is not known. Then one standard deviation from all
// lines is used for every line, in one common part.
std::vector<UncertaintyPart> by_repetition(const std::array<Length, 4>& lines,
                                           const std::array<double, 4>& slope) {
  double squares = 0, freedom = 0, by_variance = 0;
  bool any_once = false;
  std::vector<UncertaintyPart> parts;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].readings == 0) continue;
    squares += lines[i].squares;
    freedom += lines[i].freedom();
    by_variance += slope[i] * slope[i] / lines[i].readings;
    any_once = any_once || lines[i].readings == 1;
    if (lines[i].freedom() > 0)
      parts.push_back({std::abs(slope[i]) *
                           std::sqrt(lines[i].squares / (lines[i].freedom() * lines[i].readings)),
                       lines[i].freedom()});
  }
  if (!any_once || freedom == 0) return parts;
  return {{std::sqrt(by_variance * squares / freedom), freedom}};
}

bool usable(const MeasuredLine& line) {
  return std::all_of(line.length_m.begin(), line.length_m.end(),
                     [](double x) { return x > 0 && std::isfinite(x); });
}

}  // namespace

Result<std::vector<Diagonal>> plane_diagonals(const Machine& machine, std::size_t first,
                                              std::size_t second, std::size_t steps,
                                              MachineApproach approach) {
  Corner c{first, second, {}, {}};
  for (const std::size_t direction : {first, second}) {
    const MachineFrame* frame = machine.find(kAxisNames.substr(direction, 1));
    if (!frame)
      return bad_input("the chain " + machine.chain.text + " has no axis " +
                       std::string(kAxisNames.substr(direction, 1)) +
                       "; use only axes of this chain");
    MDOF_TRY((direction == first ? c.first_range : c.second_range), range_of(*frame));
  }
  std::vector<Diagonal> diagonals = {along(machine, c, steps, approach)};
  std::swap(c.first_range[0], c.first_range[1]);
  diagonals.push_back(along(machine, c, steps, approach));
  return diagonals;
}

Result<DiagonalSquareness> squareness_from_diagonals(const DiagonalLines& lines) {
  if (lines.first.length_m.empty() || lines.second.length_m.empty() ||
      lines.diagonal.length_m.empty())
    return bad_input(
        "give the lengths of lines 1 and 2 (along the axes) and of line 3 (the diagonal)");
  if (!usable(lines.first) || !usable(lines.second) || !usable(lines.diagonal) ||
      !usable(lines.other))
    return bad_input("every length must be a number above 0");
  DiagonalSquareness s;
  s.two_diagonals = !lines.other.length_m.empty();
  const Length x = length_of(lines.first), y = length_of(lines.second);
  const Length d = length_of(lines.diagonal), e = length_of(lines.other);
  const double product = 2 * x.mean * y.mean;
  const double cosine = s.two_diagonals
                            ? (d.mean - e.mean) * (d.mean + e.mean) / (2 * product)
                            : (d.mean * d.mean - x.mean * x.mean - y.mean * y.mean) / product;
  if (!(std::abs(cosine) < 0.1))
    return bad_input(
        "the measured lengths do not fit two axes that are nearly perpendicular to each other; "
        "check the order and the unit of the lengths");
  s.angle_error_rad = -std::asin(cosine);  // acos(c) - 90°
  const double by_sine = 1 / std::sqrt(1 - cosine * cosine);
  // ∂θ/∂length = -∂cos/∂length / sin θ.
  const double half = s.two_diagonals ? 0.5 : 1;
  std::array<double, 4> slope = {(s.two_diagonals ? 0 : 2 * x.mean / product) + cosine / x.mean,
                                 (s.two_diagonals ? 0 : 2 * y.mean / product) + cosine / y.mean,
                                 -half * 2 * d.mean / product,
                                 s.two_diagonals ? half * 2 * e.mean / product : 0};
  for (double& of_line : slope) of_line *= by_sine;
  std::vector<UncertaintyPart> parts = by_repetition({x, y, d, e}, slope);
  double squares = 0;
  for (const UncertaintyPart& part : parts) squares += part.u * part.u;
  s.u_repeat_rad = std::sqrt(squares);
  for (const double of_line : slope) {
    const double declared = std::abs(of_line) * lines.u_line_m;
    parts.push_back({declared, std::numeric_limits<double>::infinity()});
    squares += declared * declared;
  }
  if (!(squares > 0))
    return bad_input("the uncertainty of the line lengths is unknown", Remedy::give_u_of_lines);
  s.u_rad = std::sqrt(squares);
  s.freedom = effective_freedom(parts);
  s.k = coverage_factor(s.freedom);
  s.U_rad = s.k * s.u_rad;
  return s;
}

}  // namespace mdof::algo
