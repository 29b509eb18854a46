#include "algo/machine/study/grooving_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "algo/compensation/volumetric/volumetric.h"
#include "algo/iso230/line_fit.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kWidth_m = 0.4, kCentre_m = 0.2, kRadius_m = 0.15;
constexpr double kTarget_m = 0.01, kGrid_m = 0.02;
constexpr std::size_t kAngles = 72, kDiagonalSteps = 20;
constexpr int kHarmonics = 5;
constexpr MachineApproach kApproach = MachineApproach::mean;

// ---- the machine ----

struct Wave {
  double size = 0, length = 0, phase_turns = 0;  // m or rad; m or rad; turns
};

ErrorFunction error_function(double length, std::size_t steps, double slope_size,
                             const std::vector<Wave>& waves) {
  ErrorFunction f;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(steps);
    double value = slope_size * (part - 0.5);
    for (const Wave& w : waves)
      value += w.size * sine_of_turns(part * length / w.length + w.phase_turns);
    f.position.push_back(part * length);
    f.forward.push_back(value);
  }
  return f;
}

ErrorFunction along_axis(double slope_size, const std::vector<Wave>& waves) {
  return error_function(kWidth_m, 200, slope_size, waves);
}

MachineFrame linear_axis(const ChainAxis& axis, std::size_t direction) {
  MachineFrame frame;
  frame.id = std::string(1, axis.letter);
  frame.kind = FrameKind::linear;
  frame.direction = direction;
  frame.carries_work = axis.carries_work;
  frame.against_command = axis.against_command;
  frame.range = {0.0, kWidth_m};
  return frame;
}

MachineFrame axis_x(const ChainAxis& chain) {
  MachineFrame x = linear_axis(chain, 0);
  x.point_moves = true;
  x.error = {along_axis(9.7e-6, {{0.5e-6, 0.19, 0.2}}),
             along_axis(0, {{0.8e-6, 0.41, 0.1}, {0.12e-6, 0.13, 0.4}}),
             along_axis(0, {{0.3e-6, 0.3, 0.3}}),
             along_axis(0, {{1.0e-6, 0.35, 0}}),
             along_axis(0, {{1.2e-6, 0.35, 0.3}}),
             along_axis(0, {{1.5e-6, 0.35, 0.6}})};
  x.location[5].value = 22.8e-6;  // EC0X, because Eq. 1 turns the axis line of X
  return x;
}

MachineFrame axis_y(const ChainAxis& chain) {
  MachineFrame y = linear_axis(chain, 1);
  y.at_m = {kCentre_m, 0, 0};  // the laser measures in the middle of the table
  y.error = {along_axis(0, {{0.9e-6, 0.43, 0.35}, {0.1e-6, 0.12, 0.1}}),
             along_axis(-4.6e-6, {{0.45e-6, 0.17, 0.6}}),
             along_axis(0, {{0.25e-6, 0.28, 0.15}}),
             along_axis(0, {{0.9e-6, 0.37, 0.2}}),
             along_axis(0, {{0.8e-6, 0.4, 0.5}}),
             along_axis(0, {{2.6e-6, 0.4, 0.75}})};
  return y;
}

constexpr double kTurn = 2 * std::numbers::pi;

MachineFrame axis_c(const ChainAxis& chain) {
  MachineFrame c;
  c.id = "C";
  c.kind = FrameKind::rotary;
  c.direction = 2;
  c.carries_work = chain.carries_work;
  c.at_m = {kCentre_m, kCentre_m, 0};
  c.range = {0.0, kTurn};
  c.error[3] = error_function(kTurn, 360, 0, {{1.5e-6, kTurn / 2, 0.6}, {0.4e-6, kTurn / 3, 0}});
  c.error[4] = error_function(kTurn, 360, 0, {{1.2e-6, kTurn / 2, 0.35}, {0.5e-6, kTurn / 3, 0.2}});
  c.location[3].value = 12e-6;
  c.location[4].value = -8e-6;
  return c;
}

// Sets every unknown error to a known value of 0.
void set_missing_errors_to_zero(Machine& machine) {
  for (MachineFrame& frame : machine.frames)
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      if (!frame.error[k].known()) frame.error[k].forward = {0};
      if (has_location(frame, k) && !frame.location[k].value) frame.location[k].value = 0;
    }
}

// ---- the instruments ----

class Noise {
 public:
  Noise(std::uint64_t seed, std::size_t repeats) : seed_(seed), repeats_(repeats) {}
  double of_one(double sd) {
    const Philox words = philox({count_++, 0, 0, 0}, seed_);
    return sd * gaussian(uniform(words[0], words[1]));
  }
  double of_mean(double sd) {
    double sum = 0;
    for (std::size_t i = 0; i < repeats_; ++i) sum += of_one(sd);
    return sum / static_cast<double>(repeats_);
  }
  double u_of_mean(double sd) const { return sd / std::sqrt(static_cast<double>(repeats_)); }
  std::size_t repeats() const { return repeats_; }

 private:
  std::uint64_t seed_;
  std::uint32_t count_ = 0;
  std::size_t repeats_;
};

// The simulated machine, with or without corrections.
struct Plant {
  const Machine& machine;
  const VolumetricTable* corrections = nullptr;

  // Error of the tool relative to the work for the wanted command (x, y), m.
  Eigen::Vector3d error_at(double x, double y) const {
    Command wanted{}, given{};
    wanted[0] = given[0] = x;
    wanted[1] = given[1] = y;
    if (corrections) {
      const VolumetricValue v = volumetric_at(*corrections, {x, y, 0});
      for (std::size_t k = 0; k < 3; ++k) given[k] += v.correction_m[k];
    }
    return actual_tool(machine, values_at(machine, given, kApproach)).p -
           nominal_tool(machine, wanted).p;
  }
  Eigen::Vector3d place_of(double x, double y) const {
    return Eigen::Vector3d(x, y, 0) + error_at(x, y);
  }
};

// Errors of the tool along X, Y and Z, m, at positions of one axis; the other axis is in the middle
// of its travel.
struct AxisReading {
  std::vector<double> at;
  std::array<std::vector<double>, 3> error;
  double slope = 0;  // of the line that is subtracted from the straightness
};

AxisReading read_axis(const Plant& plant, std::size_t axis, Noise& noise, double sd) {
  AxisReading reading;
  reading.at = steps_over({0, kWidth_m}, kTarget_m);
  for (const double at : reading.at) {
    const Eigen::Vector3d e =
        axis == 0 ? plant.error_at(at, kCentre_m) : plant.error_at(kCentre_m, at);
    for (std::size_t k = 0; k < 3; ++k)
      reading.error[k].push_back(e[static_cast<Eigen::Index>(k)] + noise.of_mean(sd));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double>& e = reading.error[k];
    const Line line = end_point_line(reading.at, e);
    const bool straightness = k < 2 && k != axis;
    const double zero = e.front();  // the first reading of a laser or an indicator is 0
    for (std::size_t i = 0; i < e.size(); ++i) e[i] -= straightness ? line.at(reading.at[i]) : zero;
    if (straightness) reading.slope = line.slope;
  }
  return reading;
}

DiagonalLines read_lines(const Plant& plant, Noise& noise, double sd) {
  const double w = kWidth_m, c = kCentre_m;
  const double ends[4][4] = {{0, c, w, c}, {c, 0, c, w}, {0, 0, w, w}, {w, 0, 0, w}};
  DiagonalLines lines;
  MeasuredLine* const of[] = {&lines.first, &lines.second, &lines.diagonal, &lines.other};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& e = ends[i];
    const double length = (plant.place_of(e[2], e[3]) - plant.place_of(e[0], e[1])).norm();
    for (std::size_t n = 0; n < noise.repeats(); ++n)
      of[i]->length_m.push_back(length + noise.of_one(sd));
  }
  return lines;
}

// ---- evaluation of the readings ----

void set(MachineFrame& frame, std::size_t k, const AxisReading& reading, double sign, double u) {
  ErrorFunction& f = frame.error[k];
  f = {};
  f.position = reading.at;
  for (const double e : reading.error[k]) f.forward.push_back(sign * e);
  f.u.assign(reading.at.size(), u);
}

// The machine that the readings describe. It has no angle errors, as in Eq. 1.
Machine found_machine(const Machine& machine, const AxisReading& x, const AxisReading& y,
                      const GroovingState& state, double u) {
  Machine found = machine;
  found.name = "grooving machine of Hwang, Song and Park, as measured";
  for (MachineFrame& frame : found.frames) {
    for (ErrorFunction& f : frame.error) f = {};
    frame.location = {};
    const bool is_x = frame.id == "X";
    // An error of a body that moves the work has the opposite effect on the tool.
    for (std::size_t k = 0; k < 2; ++k) set(frame, k, is_x ? x : y, frame.carries_work ? -1 : 1, u);
    if (is_x) frame.location[5] = {-state.angle_error_rad, state.u_angle_rad};
  }
  return found;
}

PlaneRange range_of_map(const PlaneMap& map) {
  return {map.extremes[0].range, map.extremes[1].range};
}

PlaneRange actual_range(const Plant& plant) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (const double x : steps_over({0, kWidth_m}, kTarget_m))
    for (const double y : steps_over({0, kWidth_m}, kTarget_m)) {
      const Eigen::Vector3d e = plant.error_at(x, y);
      for (Eigen::Index k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], e[k]);
        high[k] = std::max(high[k], e[k]);
      }
    }
  return {high[0] - low[0], high[1] - low[1]};
}

double range_of_values(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

DiagonalRange read_diagonal(const Plant& plant, const Diagonal& predicted, Noise& noise,
                            double sd) {
  const bool falls = predicted.name.starts_with("X-");
  const double w = kWidth_m;
  const Eigen::Vector3d way = Eigen::Vector3d(falls ? -1 : 1, 1, 0).normalized();
  std::vector<double> read;
  for (std::size_t i = 0; i <= kDiagonalSteps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kDiagonalSteps);
    read.push_back(plant.error_at(falls ? w * (1 - part) : w * part, w * part).dot(way) +
                   noise.of_mean(sd));
  }
  const double zero = read.front();
  DiagonalRange range{predicted.name, predicted.range_m, 0, 0};
  for (std::size_t i = 0; i < read.size(); ++i) {
    read[i] -= zero;
    range.difference_m = std::max(range.difference_m, std::abs(read[i] - predicted.deviation_m[i]));
  }
  range.measured_m = range_of_values(read);
  return range;
}

Result<GroovingState> read_state(const Plant& plant, const GroovingInstruments& by, Noise& noise) {
  GroovingState state;
  const AxisReading x = read_axis(plant, 0, noise, by.position_m);
  const AxisReading y = read_axis(plant, 1, noise, by.position_m);
  // A rotation of the whole work changes both slopes with opposite signs, but not their sum.
  state.angle_error_rad = -(x.slope + y.slope) + noise.of_one(by.square_rad);
  state.u_angle_rad = std::hypot(
      by.square_rad, 2 * noise.u_of_mean(by.position_m) / kWidth_m);  // two end points per line
  const DiagonalLines lines = read_lines(plant, noise, by.line_m);
  MDOF_TRY(state.square, squareness_from_diagonals(lines));
  DiagonalLines one = lines;
  one.other = {};
  MDOF_TRY(const DiagonalSquareness by_one, squareness_from_diagonals(one));
  state.one_diagonal_angle_rad = by_one.angle_error_rad;
  state.found = found_machine(plant.machine, x, y, state, noise.u_of_mean(by.position_m));
  PlaneMapRequest request;
  request.step_m = kTarget_m;
  request.without_angles = true;
  MDOF_TRY(const PlaneMap map, plane_map(state.found, request));
  state.estimated = range_of_map(map);
  state.actual = actual_range(plant);
  MDOF_TRY(const auto predicted,
           plane_diagonals(without_angles(state.found), 0, 1, kDiagonalSteps, kApproach));
  for (const Diagonal& d : predicted)
    state.diagonals.push_back(read_diagonal(plant, d, noise, by.position_m));
  return state;
}

// ---- the rotary table ----

double value_at(const AxisReading& reading, std::size_t k, double at) {
  const auto& x = reading.at;
  const auto upper = std::upper_bound(x.begin(), x.end() - 1, at);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(upper - x.begin() - 1, 0));
  const double part = (at - x[i]) / (x[i + 1] - x[i]);
  return reading.error[k][i] + part * (reading.error[k][i + 1] - reading.error[k][i]);
}

// Simulates the readings over one turn. X, Y and C move so that the indicator stays over one spot
// of the table. The indicator measures the height of this spot relative to the tool.
CircleReadings read_circle(const Machine& machine, const Plant& plane, Noise& noise,
                           const GroovingInstruments& by) {
  const AxisReading along_x = read_axis(plane, 0, noise, by.height_m);
  const AxisReading along_y = read_axis(plane, 1, noise, by.height_m);
  CircleReadings r;
  r.radius_m = kRadius_m;
  for (std::size_t i = 0; i < kAngles; ++i) {
    const double turns = static_cast<double>(i) / static_cast<double>(kAngles);
    Command command{};
    command[0] = kCentre_m + kRadius_m * sine_of_turns(turns + 0.25);
    command[1] = kCentre_m + kRadius_m * sine_of_turns(turns);
    command[5] = turns * kTurn;
    const auto values = values_at(machine, command, kApproach);
    const double height = -(actual_tool(machine, values).p - nominal_tool(machine, command).p).z();
    r.angle_rad.push_back(turns * kTurn);
    r.height_m.push_back(height + noise.of_one(by.height_m));
    const auto c = std::find_if(machine.frames.begin(), machine.frames.end(),
                                [](const MachineFrame& f) { return f.id == "C"; });
    const auto& of_c = values[static_cast<std::size_t>(c - machine.frames.begin())].error;
    r.tilt_a_rad.push_back(of_c[3] + noise.of_one(by.tilt_rad));
    r.tilt_b_rad.push_back(of_c[4] + noise.of_one(by.tilt_rad));
    r.axes_m.push_back(-value_at(along_x, 2, command[0]) - value_at(along_y, 2, command[1]));
  }
  return r;
}

Result<GroovingTable> read_table(const Machine& machine, const Plant& plane, Noise& noise,
                                 const GroovingInstruments& by) {
  const CircleReadings all = read_circle(machine, plane, noise, by);
  const MachineFrame* c = machine.find("C");
  GroovingTable table;
  table.EA0C_rad = c->location[3].value.value_or(0);
  table.EB0C_rad = c->location[4].value.value_or(0);
  table.radius_m = all.radius_m;
  CircleReadings some = all;
  some.axes_m = {};
  MDOF_TRY(table.without_tilt, perpendicularity(some, kHarmonics));
  some.tilt_a_rad = some.tilt_b_rad = {};
  MDOF_TRY(table.raw, perpendicularity(some, kHarmonics));
  MDOF_TRY(table.without_both, perpendicularity(all, kHarmonics));
  std::vector<double> without_tilt, left;
  for (std::size_t i = 0; i < all.angle_rad.size(); ++i) {
    const double turns = all.angle_rad[i] / kTurn;
    const double s = all.radius_m * sine_of_turns(turns);
    const double c_arm = all.radius_m * sine_of_turns(turns + 0.25);
    without_tilt.push_back(all.height_m[i] - all.tilt_a_rad[i] * s + all.tilt_b_rad[i] * c_arm);
    left.push_back(without_tilt.back() - table.without_both.EA0C_rad * s +
                   table.without_both.EB0C_rad * c_arm);
  }
  table.range_m = range_of_values(all.height_m);
  table.range_without_tilt_m = range_of_values(without_tilt);
  table.range_left_m = range_of_values(left);
  return table;
}

Machine without_table(Machine machine) {
  std::erase_if(machine.frames, [](const MachineFrame& f) { return f.id == "C"; });
  machine.chain = parse_chain("w-Y-b-X-t").value();
  machine.chain.axes.front().against_command = true;
  return machine;
}

}  // namespace

Machine grooving_machine() {
  Machine machine;
  machine.name = "grooving machine of Hwang, Song and Park, simulated";
  machine.simulated = true;
  machine.chain = parse_chain("w-C-Y-b-X-t").value();
  machine.chain.axes[1].against_command = true;  // Y moves against its command
  machine.tool_m = {0, 0, 0.12};                 // as high above the guides as the laser beam
  machine.frames = {axis_c(machine.chain.axes[0]), axis_y(machine.chain.axes[1]),
                    axis_x(machine.chain.axes[2])};
  set_missing_errors_to_zero(machine);
  return machine;
}

Result<GroovingStudy> grooving_study(std::uint64_t seed, const GroovingInstruments& instruments) {
  const Machine machine = grooving_machine(), plane = without_table(machine);
  Noise noise(seed, instruments.repeats);
  GroovingStudy study;
  study.seed = seed;
  study.instruments = instruments;
  const Plant before{plane};
  MDOF_TRY(study.before, read_state(before, instruments, noise));
  VolumetricRequest request;
  request.along = {true, true, false};
  request.step_m = kGrid_m;
  request.incomplete = true;  // Eq. 1 has no angles
  MDOF_TRY(study.corrections, build_volumetric(study.before.found, request));
  const Plant after{plane, &study.corrections};
  MDOF_TRY(study.after, read_state(after, instruments, noise));
  MDOF_TRY(study.table, read_table(machine, before, noise, instruments));
  return study;
}

}  // namespace mdof::algo
