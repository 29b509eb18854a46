#include "schema/machine/machine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema/units.h"

namespace mdof {
namespace {

constexpr std::string_view kDirections = "XYZABC";
constexpr double kMostTurn_rad = 0.1, kMostShift_m = 0.01;
constexpr double kDegreesByRadian = 180 / std::numbers::pi;

bool all_below(const std::vector<double>& values, double most) {
  return std::all_of(values.begin(), values.end(),
                     [most](double v) { return std::abs(v) <= most; });  // false for nan
}

bool increasing(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(),
                            [](double a, double b) { return !(a < b); }) == values.end();
}

}  // namespace

const MachineFrame* Machine::find(std::string_view id) const {
  const auto found =
      std::find_if(frames.begin(), frames.end(), [&](const MachineFrame& f) { return f.id == id; });
  return found == frames.end() ? nullptr : &*found;
}

bool Machine::names_stored_rows() const {
  return squareness.any() || std::any_of(frames.begin(), frames.end(), [](const MachineFrame& f) {
           return f.runs.any() || f.tables.any();
         });
}

void convert_positioning(MachineFrame& frame) {
  if (frame.positioning_sense == StatedSense::command && frame.against_command) {
    ErrorFunction& along = frame.error[frame.direction];
    for (auto* values : {&along.forward, &along.reverse})
      for (double& e : *values) e = -e;
  }
  frame.positioning_sense = StatedSense::none;
}

bool moves_along(const MachineFrame& frame) {
  return frame.kind == FrameKind::linear || frame.moves_with != 0;
}

std::string error_name(const MachineFrame& frame, std::size_t k) {
  const std::string direction(1, kDirections[k]);
  return "E" + direction + (frame.kind == FrameKind::fixed ? "(" + frame.id + ")" : frame.id);
}

std::string location_name(const MachineFrame& frame, std::size_t k) {
  return "E" + std::string(1, kDirections[k]) + "0" + frame.id;
}

std::string with_unit(const std::string& name, std::size_t k) {
  return name + (k < 3 ? "_um" : "_urad");
}

bool has_location(const MachineFrame& frame, std::size_t k) {
  if (frame.kind == FrameKind::fixed || k % 3 == frame.direction) return false;
  return frame.kind == FrameKind::rotary || k >= 3;
}

double position_from_written(const MachineFrame& frame, double written) {
  return frame.kind == FrameKind::rotary ? written / kDegreesByRadian : from_mm(written);
}

double written_position(const MachineFrame& frame, double position) {
  return frame.kind == FrameKind::rotary ? position * kDegreesByRadian : to_mm(position);
}

const char* position_unit(const MachineFrame& frame) {
  return frame.kind == FrameKind::rotary ? "deg" : "mm";
}

const char* to_string(SourceShape shape) {
  switch (shape) {
    case SourceShape::normal:
      break;
    case SourceShape::rectangular:
      return "rectangular";
    case SourceShape::triangular:
      return "triangular";
    case SourceShape::u_shaped:
      return "u-shaped";
  }
  return "normal";
}

Status check_function(const ErrorFunction& function, std::size_t k, const std::string& where) {
  const std::size_t rows = std::max<std::size_t>(function.position.size(), 1);
  const auto fits = [rows](const std::vector<double>& v) { return v.empty() || v.size() == rows; };
  if (function.forward.size() != rows || !fits(function.reverse) || !fits(function.u))
    return bad_input(where +
                     ": the number of values is 0, or differs from the number of positions; give "
                     "one value for each position");
  if (!all_below(function.position, 1e6))
    return bad_input(
        where +
        ": a position is not a number, or is far too large; correct or remove the position");
  if (!increasing(function.position))
    return bad_input(where +
                     ": positions must increase; sort the positions, and take the mean of readings "
                     "at the same position");
  const double most = k < 3 ? kMostShift_m : kMostTurn_rad;
  if (!all_below(function.forward, most) || !all_below(function.reverse, most))
    return bad_input(where + ": every value must be a number from " +
                     (k < 3 ? "-10,000 to 10,000 µm" : "-100,000 to 100,000 µrad") +
                     "; check the unit of the values");
  const auto negative = [](double u) { return !(u >= 0); };
  if (!all_below(function.u, most) || std::any_of(function.u.begin(), function.u.end(), negative))
    return bad_input(where + ": every standard uncertainty must be a number from 0 to " +
                     (k < 3 ? "10,000 µm" : "100,000 µrad") + "; check the unit");
  return {};
}

}  // namespace mdof
