// Reads MACHINE.toml: the chain, the errors of each axis, and the reference points of the errors.
#include <algorithm>
#include <cmath>

#include "schema/base/toml/toml_reader.h"
#include "schema/machine/machine.h"
#include "schema/machine/machine_sources.h"
#include "schema/rig/uncertainty.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr std::string_view kLetters = "XYZABC";
constexpr double kLargestRatio = 1000;
constexpr double kMostU_urad = 1e5;

double value_from_written(std::size_t k, double written) {
  return k < 3 ? from_um(written) : from_urad(written);
}

Vec3 read_point(TomlTable& table, std::string_view key) {
  Vec3 point = table.vector3(key);
  for (double& x : point) x = from_mm(x);
  if (!std::all_of(point.begin(), point.end(), [](double x) { return std::abs(x) < 1e3; }))
    table.reject(key, "must be three numbers in mm, each between -1000000 and 1000000");
  return point;
}

void read_rows(TomlTable& table, const std::string& key, const MachineFrame& frame, std::size_t k,
               ErrorFunction& function) {
  const auto rows = table.matrix(key);
  for (const auto& row : rows) {
    if (row.size() < 2 || row.size() > 3 || row.size() != rows.front().size()) {
      table.reject(
          key,
          "all rows must be [position, error], or all rows must be [position, forward, reverse]");
      return;
    }
    function.position.push_back(position_from_written(frame, row[0]));
    function.forward.push_back(value_from_written(k, row[1]));
    if (row.size() == 3) function.reverse.push_back(value_from_written(k, row[2]));
  }
}

// Reads the standard uncertainty of an error. If the error itself is missing, the uncertainty is
// not read and is reported as an unknown key.
std::optional<double> read_u(TomlTable& table, const std::string& key, std::size_t k) {
  const std::string of = "u_" + key;
  if (!table.has(of)) return std::nullopt;
  const double u = table.number(of);
  check_uncertainty(table, of, u, k < 3 ? kMostU_um : kMostU_urad);
  return value_from_written(k, u);
}

// Reads u of an error that is not a value in MACHINE.toml. It may complete a file without u; runs
// and tables have their own u.
void read_u_of_stored(TomlTable& table, const std::string& key, const MachineFrame& frame,
                      std::size_t k, ErrorFunction& function) {
  const auto u = frame.file.empty() && !frame.runs.any() && !frame.tables.any()
                     ? std::nullopt
                     : read_u(table, key, k);
  if (!u) return;
  if (frame.file.empty())
    return table.reject("u_" + key,
                        "is not possible for errors from runs and tables, because these errors "
                        "already have an uncertainty; remove this key");
  function.u = {*u};
}

// Reads an error as a number, as rows, or as the name of a file in EXX_file.
void read_function(TomlTable& table, const std::string& name, const MachineFrame& frame,
                   std::size_t k, ErrorFunction& function) {
  const std::string key = with_unit(name, k), file_key = name + "_file";
  if (frame.kind != FrameKind::fixed && table.has(file_key)) {
    function.file = table.string(file_key);
    if (const auto u = read_u(table, key, k)) function.u = {*u};
    return;
  }
  if (!table.has(key)) return read_u_of_stored(table, key, frame, k, function);
  if (table.is_array(key)) {
    if (frame.kind == FrameKind::fixed)
      table.reject(key,
                   "must be one number: this frame is not an axis, so its errors do not depend on "
                   "a position");
    read_rows(table, key, frame, k, function);
  } else {
    function.forward = {value_from_written(k, table.number(key))};
  }
  if (const auto u = read_u(table, key, k))
    function.u.assign(std::max<std::size_t>(function.position.size(), 1), *u);
  if (auto fit = check_function(function, k, name); !fit) table.reject(key, fit.error().message);
}

// Returns the name of an error as a key. A fixed frame has its own table with its name, so the keys
// of its errors are for example "EX".
std::string name_in_table(const MachineFrame& frame, std::size_t k) {
  const std::string id = frame.kind == FrameKind::fixed ? "" : frame.id;
  return "E" + std::string(1, kLetters[k]) + id;
}

void read_errors(TomlTable& table, MachineFrame& frame) {
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    read_function(table, name_in_table(frame, k), frame, k, frame.error[k]);
    if (!has_location(frame, k)) continue;
    const std::string key = with_unit(location_name(frame, k), k);
    if (!table.has(key)) continue;
    const double value = value_from_written(k, table.number(key));
    ErrorFunction constant;
    constant.forward = {value};
    if (auto fit = check_function(constant, k, key); !fit) table.reject(key, fit.error().message);
    frame.location[k] = {value, read_u(table, key, k)};
  }
}

void read_range(TomlTable& table, MachineFrame& frame) {
  const std::string key = std::string("range_") + position_unit(frame);
  if (!table.has(key)) return;
  const auto ends = table.numbers(key);
  if (ends.size() != 2 || !(ends[0] < ends[1])) {
    table.reject(key, "must be two numbers, [from, to]; the second must be greater than the first");
    return;
  }
  frame.range = {position_from_written(frame, ends[0]), position_from_written(frame, ends[1])};
}

// Reads the number of a row, a list of numbers, or "latest".
StoredRows read_stored_rows(TomlTable& table, const std::string& key) {
  StoredRows rows;
  if (!table.has(key)) return rows;
  if (table.is_string(key)) {
    rows.latest = table.string(key) == "latest";
    if (!rows.latest) table.reject(key, "must be a number, a list of numbers or \"latest\"");
    return rows;
  }
  for (const double x : table.is_array(key) ? table.numbers(key) : std::vector{table.number(key)}) {
    if (!(x >= 1 && x <= 1e15 && x == std::floor(x))) {
      table.reject(key, "must contain numbers of stored results, 1 or greater");
      return rows;
    }
    rows.ids.push_back(static_cast<std::int64_t>(x));
  }
  if (rows.ids.empty())
    table.reject(key, "must not be empty; remove the key, or give the number of a stored result");
  return rows;
}

void read_axis(TomlTable& table, MachineFrame& frame) {
  if (frame.kind == FrameKind::rotary) {
    if (!table.has("centre_mm"))
      table.reject("id",
                   "a rotary axis needs centre_mm = [x, y, z], a point on the axis of rotation");
    else
      frame.at_m = read_point(table, "centre_mm");
  } else {
    frame.at_m = read_point(table, "holds_at_mm");
    const std::string point = table.string("point", "");
    frame.point_moves = point == "moving";
    if (point != "moving" && point != "standing")
      table.reject("point",
                   "must be \"standing\" (errors at a point that does not move, such as a fixed "
                   "indicator) or \"moving\" (errors at a point that moves with the axis)");
    const std::string sense = table.string("positioning_sense", "body");
    if (table.has("positioning_sense"))
      frame.positioning_sense = sense == "command" ? StatedSense::command : StatedSense::body;
    if (sense != "command" && sense != "body")
      table.reject("positioning_sense",
                   "must be \"body\" (an error is positive if it points in the + direction of the "
                   "machine axis) or \"command\" (an error is the actual minus the commanded "
                   "position, in the coordinates of the controller)");
    if (table.has("angles_zero_at_mm"))
      frame.angles_zero_m = position_from_written(frame, table.number("angles_zero_at_mm"));
    frame.runs = read_stored_rows(table, "runs");
    frame.tables = read_stored_rows(table, "tables");
    if (frame.angles_zero_m && !frame.runs.any() && !frame.tables.any())
      table.reject("angles_zero_at_mm",
                   "applies only to errors from runs or tables. For errors in a file or in this "
                   "TOML table, subtract the angles at this position from the values, and remove "
                   "the key");
    if (frame.tables.latest)
      table.reject("tables",
                   "must contain numbers of tables; only the keys \"runs\" and \"squareness\" "
                   "accept \"latest\"");
  }
  frame.file = table.string("file", "");
  read_range(table, frame);
  read_errors(table, frame);
  // Values in files are converted when the files are read.
  if (frame.file.empty() && frame.error[frame.direction].file.empty()) convert_positioning(frame);
}

MachineFrame frame_of(const ChainAxis& axis) {
  MachineFrame frame;
  const std::size_t letter = kLetters.find(axis.letter);
  frame.id = std::string(1, axis.letter);
  frame.kind = letter < 3 ? FrameKind::linear : FrameKind::rotary;
  frame.direction = letter % 3;
  frame.carries_work = axis.carries_work;
  frame.against_command = axis.against_command;
  return frame;
}

// Error: the axis and an axis above it in the file state the same angle. Both values would count.
void check_squareness(TomlTable& table, const Machine& machine, const MachineFrame& frame) {
  for (const MachineFrame& other : machine.frames)
    for (std::size_t k = 3; k < kBodyErrors; ++k)
      if (&other != &frame && other.kind == FrameKind::linear && frame.kind == FrameKind::linear &&
          other.location[k].value && frame.location[k].value)
        table.reject(with_unit(location_name(frame, k), k),
                     "the angle between the axes " + other.id + " and " + frame.id +
                         " is given twice: " + location_name(frame, k) + " is the same angle as " +
                         location_name(other, k) + " of axis " + other.id +
                         ", with the opposite sign; give only one of the two");
}

void read_axes(TomlTable& root, Machine& machine) {
  machine.frames = nominal_machine(machine.chain).frames;
  std::string read;
  for (TomlTable& table : root.tables("axis")) {
    const std::string id = table.string("id");
    const auto frame = std::find_if(machine.frames.begin(), machine.frames.end(),
                                    [&](const MachineFrame& f) { return f.id == id; });
    if (frame == machine.frames.end()) {
      table.reject("id", "the chain " + machine.chain.text + " has no axis \"" + id + "\"");
    } else if (read.find(id) != std::string::npos) {
      table.reject("id", "axis " + id + " is given twice; remove one of the two [[axis]] tables");
    } else {
      read_axis(table, *frame);
      check_squareness(table, machine, *frame);
      read += id;
    }
  }
  for (const ChainAxis& axis : machine.chain.axes)
    if (read.find(axis.letter) == std::string::npos)
      root.reject("axis", "axis " + std::string(1, axis.letter) +
                              " of the chain has no [[axis]] table; add a table with id and " +
                              (kLetters.find(axis.letter) < 3 ? "holds_at_mm" : "centre_mm"));
}

// Returns the index at which a frame is inserted after `link` of the chain, in the direction from
// the workpiece to the tool.
std::optional<std::size_t> place_after(const Machine& machine, const std::string& link) {
  if (link == "w") return 0;
  const auto& frames = machine.frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].id == link) return i + 1;
    if (link == "b" && !frames[i].carries_work) return i;
  }
  return link == "b" ? std::optional(frames.size()) : std::nullopt;
}

// Reads the keys `with`, `along` and `ratio`: the body moves with the command of a linear axis, but
// in another direction.
void read_motion_with(TomlTable& table, const Machine& machine, MachineFrame& frame) {
  const std::string with = table.string("with"), along = table.string("along");
  const MachineFrame* axis = machine.find(with);
  if (!axis || axis->kind != FrameKind::linear)
    table.reject("with",
                 "\"" + with + "\" is not a linear axis of the chain " + machine.chain.text);
  else
    frame.moves_with = with[0];
  if (along != "X" && along != "Y" && along != "Z")
    table.reject("along", "\"" + along + "\" must be \"X\", \"Y\" or \"Z\"");
  else
    frame.direction = kLetters.find(along);
  frame.ratio = table.number("ratio");
  if (!(std::abs(frame.ratio) <= kLargestRatio) || frame.ratio == 0)
    table.reject("ratio",
                 "must be from -1000 to 1000, but not 0. The key states the motion of the frame in "
                 "mm, positive in the + direction of the axis \"along\", for each mm by which the "
                 "command of the axis \"with\" increases");
  const std::string point = table.string("point", "moving");
  frame.point_moves = point == "moving";
  if (point != "moving" && point != "standing")
    table.reject("point",
                 "must be \"standing\" (errors at a point that does not move) or \"moving\" "
                 "(errors at a point that moves with the body)");
}

// Reads the bodies that are not axes. Their errors are errors of their assembly on the previous
// body of the chain.
void read_fixed_frames(TomlTable& root, Machine& machine) {
  for (TomlTable& table : root.tables("frame")) {
    MachineFrame frame;
    frame.id = table.string("id");
    const std::string after = table.string("after");
    const auto place = place_after(machine, after);
    if (frame.id.size() < 2 || machine.find(frame.id))
      table.reject("id", "must be a name of two letters or more; give each frame a different name");
    if (!place) {
      table.reject(
          "after",
          "\"" + after +
              "\" is not a link of the chain; give \"w\" (work), \"b\" (bed), an axis, or the " +
              "id of a [[frame]] above this one in the file");
      continue;
    }
    frame.carries_work = after == "w" || (after != "b" && machine.frames[*place - 1].carries_work);
    frame.at_m = read_point(table, "holds_at_mm");
    if (table.has("with")) read_motion_with(table, machine, frame);
    read_errors(table, frame);
    machine.frames.insert(machine.frames.begin() + static_cast<std::ptrdiff_t>(*place),
                          std::move(frame));
  }
}

}  // namespace

Machine nominal_machine(const Chain& chain) {
  Machine machine;
  machine.chain = chain;
  for (const ChainAxis& axis : chain.axes) machine.frames.push_back(frame_of(axis));
  return machine;
}

Result<Machine> parse_machine(std::string_view text, const std::string& source_name) {
  MDOF_TRY(TomlTable root, TomlTable::parse(text, source_name));
  Machine machine;
  machine.name = root.string("name");
  machine.simulated = root.boolean("simulated", false);
  machine.chain = read_machine(root);
  if (!machine.chain.known()) {
    root.reject("machine",
                "[machine] chain is missing; add a chain such as chain = \"w-Y-X-b-Z-t\"");
    return tl::unexpected(root.finish().error());  // all other tables name axes of the chain
  }
  read_axes(root, machine);
  read_fixed_frames(root, machine);
  read_sources(root, machine);
  machine.squareness = read_stored_rows(root, "squareness");
  if (machine.squareness.ids.size() > 3)
    root.reject("squareness",
                "must be at most three numbers (one each for XY, XZ and YZ) or \"latest\"");
  if (auto tool = root.table("tool")) machine.tool_m = read_point(*tool, "point_mm");
  MDOF_CHECK(root.finish());
  return machine;
}

}  // namespace mdof
