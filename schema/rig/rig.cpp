#include "schema/rig/rig.h"

#include <algorithm>
#include <cmath>

#include "schema/base/files.h"
#include "schema/base/number/number_text.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/rig/calibrated.h"
#include "schema/rig/check/rig_check.h"
#include "schema/rig/effects/physics.h"
#include "schema/rig/rig_tables.h"
#include "schema/rig/scan.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr double kLeastWave_m = 1e-4, kMostWave_m = 1;

Vec3 unit_vector(Vec3 v) {
  const double norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / norm, v[1] / norm, v[2] / norm};
}

// Reads "+Z", "-X", or a vector [x, y, z] of any length.
Vec3 read_direction(TomlTable& table, std::string_view key) {
  const std::string text = table.string(key);
  if (text.size() == 2 && (text[0] == '+' || text[0] == '-')) {
    if (const auto axis = axis_from(text.substr(1))) {
      Vec3 direction{};
      direction[static_cast<std::size_t>(*axis)] = text[0] == '-' ? -1.0 : 1.0;
      return direction;
    }
  }
  table.reject(key, "\"" + text +
                        "\" is not a direction; use \"+X\", \"-X\", \"+Y\", \"-Y\", \"+Z\", \"-Z\" "
                        "or direction = [x, y, z]");
  return {0, 0, 1};
}

Vec3 read_vector_direction(TomlTable& table, std::string_view key) {
  const Vec3 v = table.vector3(key);
  if (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] == 0.0) {
    table.reject(key, "must not be a zero vector");
    return {0, 0, 1};
  }
  return unit_vector(v);
}

std::string read_date(TomlTable& table, const char* key) {
  std::string date = table.string(key, "");
  if (!date.empty() && !is_date(date)) table.reject(key, "must be a date, YYYY-MM-DD");
  return date;
}

Calibration read_calibration(TomlTable& table) {
  Calibration c;
  const std::string reads = table.string("reads", "displacement");
  if (reads != "displacement" && reads != "gap") {
    table.reject("reads", "must be \"displacement\" or \"gap\"");
  }
  c.reads_gap = reads == "gap";
  c.reads_stated = table.has("reads");
  if (table.has("um_per_V")) c.um_per_V = table.number("um_per_V");
  if (c.um_per_V && *c.um_per_V == 0.0) table.reject("um_per_V", "must not be zero");
  c.offset_um = table.number("offset_um", 0.0);
  for (const auto& row : table.matrix("linearity")) {
    if (row.size() != 2 || (!c.linearity.empty() && row[0] <= c.linearity.back()[0])) {
      table.reject("linearity",
                   "must be pairs [reading_um, correction_um] in the order of increasing readings");
      break;
    }
    c.linearity.push_back({row[0], row[1]});
  }
  c.polynomial_um = table.numbers("polynomial_um", std::vector<double>{});
  if (!c.polynomial_um.empty() && !c.linearity.empty())
    table.reject("polynomial_um", "contradicts \"linearity\"; give only one of the two keys");
  if (table.has("valid_um")) {
    const auto valid = table.numbers("valid_um");
    if (valid.size() == 2 && valid[0] < valid[1]) {
      c.valid_um = {valid[0], valid[1]};
    } else {
      table.reject("valid_um", "must be two numbers: the lowest and the highest raw reading in µm");
    }
  }
  c.certificate = table.string("certificate", "");
  c.laboratory = table.string("laboratory", "");
  c.calibrated = read_date(table, "calibrated");
  c.due = read_date(table, "due");
  if (!c.calibrated.empty() && !c.due.empty() && c.due < c.calibrated)
    table.reject("due", "must not be before calibrated (" + c.calibrated + ")");
  return c;
}

Probe read_probe(TomlTable& table) {
  Probe probe;
  probe.id = table.string("id");
  if (probe.id.empty()) table.reject("id", "must not be empty");
  const Vec3 mm = table.vector3("position_mm");
  probe.position_m = {from_mm(mm[0]), from_mm(mm[1]), from_mm(mm[2])};
  probe.direction = table.has("direction") ? read_vector_direction(table, "direction")
                                           : read_direction(table, "measures");
  probe.plane = table.string("plane", "");
  const double range_um = table.number("range_um");
  if (range_um <= 0)
    table.reject("range_um", "must be greater than zero, not " + plain_number(range_um));
  probe.range_m = from_um(range_um);
  probe.calibration = read_calibration(table);
  probe.delay_s = read_delay_s(table,
                               "readings relative to their time stamps, for example because of a "
                               "filter");
  probe.uncertainty = {read_uncertainty(table, "u_calibration_um", from_um(1), kMostU_um),
                       read_uncertainty(table, "u_sensitivity_ppm", 1e-6, kMostU_ppm),
                       read_uncertainty3(table, "u_position_mm", from_mm(1), kMostU_mm),
                       read_uncertainty(table, "u_direction_mrad", 1e-3, kMostU_mrad)};
  return probe;
}

HeightMap read_flatness(TomlTable& table) {
  HeightMap map;
  for (const double x : table.numbers("flatness_first_mm", std::vector<double>{})) {
    map.first_m.push_back(from_mm(x));
  }
  for (const double x : table.numbers("flatness_second_mm", std::vector<double>{})) {
    map.second_m.push_back(from_mm(x));
  }
  const auto rows = table.matrix("flatness_um");
  bool regular = rows.size() == map.first_m.size() &&
                 std::is_sorted(map.first_m.begin(), map.first_m.end()) &&
                 std::is_sorted(map.second_m.begin(), map.second_m.end());
  for (const auto& row : rows) {
    regular = regular && row.size() == map.second_m.size();
    for (const double h_um : row) map.height_m.push_back(from_um(h_um));
  }
  if (!regular) {
    table.reject("flatness_um",
                 "must have one row for each value of flatness_first_mm, and one height in each "
                 "row for each value of flatness_second_mm; the values of both keys must increase");
    return {};
  }
  return map;
}

TargetPlane read_plane(TomlTable& table) {
  TargetPlane plane;
  plane.id = table.string("id", "");
  plane.normal = table.has("normal_vector") ? read_vector_direction(table, "normal_vector")
                                            : read_direction(table, "normal");
  if (table.has("offset_mm")) plane.offset_m = from_mm(table.number("offset_mm"));
  plane.flatness = read_flatness(table);
  plane.u_flatness = read_uncertainty(table, "u_flatness_um", from_um(1), kMostU_um);
  plane.flatness_length_m = from_mm(table.number("flatness_length_mm", 30));
  if (!(plane.flatness_length_m >= kLeastWave_m && plane.flatness_length_m <= kMostWave_m))
    table.reject("flatness_length_mm",
                 "must be from 0.1 to 1000, not " + plain_number(to_mm(plane.flatness_length_m)) +
                     "; the key states the longest wavelength of the flatness deviation, in mm");
  return plane;
}

// Reads one of two words. If the key is missing, the first word applies.
bool read_choice(TomlTable& table, const char* key, const char* first, const char* second) {
  const std::string word = table.string(key, first);
  if (word != first && word != second)
    table.reject(key, "\"" + word + "\" must be \"" + first + "\" or \"" + second + "\"");
  return word == second;
}

Sides read_sides(TomlTable& table) {
  return {read_choice(table, "moves", "target", "fixture"), read_choice(table, "travel", "+", "-")};
}

// The chain must contain the axis of the rig, with the same direction of travel.
void check_machine(TomlTable& table, const Rig& rig) {
  if (!rig.machine.known()) return;
  const std::string axis(1, letter(rig.axis));
  const ChainAxis* in_chain = rig.machine.find(axis[0]);
  if (!in_chain)
    return table.reject("machine", "the chain " + rig.machine.text + " has no axis " + axis);
  if (in_chain->against_command != rig.sides.against_encoder)
    table.reject("travel",
                 "is \"" + std::string(rig.sides.travel()) + "\", but travel." + axis +
                     " of [machine] has the opposite sign (\"+\" if the key is missing); correct "
                     "one of the two values. If the position of the encoder decreases when the "
                     "commanded position increases, change the sign of um_per_count");
}

constexpr std::size_t kMostProbes = 1000;  // limits the time for the comparison of all pairs

void reject_double_planes(TomlTable& table, const std::vector<TargetPlane>& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!planes[i].id.empty() && planes[i].id == planes[j].id)
        return table.reject(
            "plane", "two planes are called \"" + planes[i].id + "\"; give each plane its own id");
}

void reject_doubles(TomlTable& table, const std::vector<Probe>& probes) {
  for (std::size_t i = 0; i < probes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (probes[i].id == probes[j].id) {
        table.reject("probe",
                     "two probes are called \"" + probes[i].id + "\"; give each probe its own id");
      }
      if (probes[i].position_m == probes[j].position_m &&
          probes[i].direction == probes[j].direction) {
        table.reject("probe", "probes \"" + probes[j].id + "\" and \"" + probes[i].id +
                                  "\" have the same position and direction; correct position_mm");
      }
    }
  }
}

}  // namespace

Notices overdue_calibrations(const Rig& rig, std::string_view day) {
  Notices overdue;
  for (const Probe& probe : rig.probes) {
    const Calibration& c = probe.calibration;
    if (day.substr(0, c.calibrated.size()) < c.calibrated)
      overdue.push_back(notice(NoticeCode::calibrated_after_measurement, probe.id,
                               {{"calibrated", c.calibrated},
                                {"day", std::string(day.substr(0, c.calibrated.size()))},
                                {"certificate", c.certificate}}));
    if (c.due.empty() || day.substr(0, c.due.size()) <= c.due) continue;
    overdue.push_back(notice(NoticeCode::calibration_overdue, probe.id,
                             {{"due", c.due}, {"certificate", c.certificate}}));
  }
  for (const CalibrationRecord& record : rig.records)
    if (day.substr(0, record.valid_until.size()) > record.valid_until)
      overdue.push_back(notice(NoticeCode::record_expired, record.id,
                               {{"valid_until", record.valid_until}, {"kind", record.kind}}));
  return overdue;
}

std::optional<std::size_t> Rig::probe_index(std::string_view id) const {
  for (std::size_t i = 0; i < probes.size(); ++i) {
    if (probes[i].id == id) return i;
  }
  return std::nullopt;
}

namespace {

// A key of uncertainty.h: whether it is known for all parts of the rig that can have it, and
// whether it contributes to u.
struct DeclaredKey {
  const char* key;
  bool everywhere, somewhere;
};

// `of(item)`: the declared uncertainty of the item.
template <class Items, class Of>
DeclaredKey declared_state(const char* key, const Items& items, Of of) {
  return {key,
          !items.empty() && std::all_of(items.begin(), items.end(),
                                        [&](const auto& item) { return of(item).known(); }),
          std::any_of(items.begin(), items.end(),
                      [&](const auto& item) { return of(item).declared(); })};
}

template <class Declared>
DeclaredKey declared_state(const char* key, const Declared& of) {
  return {key, of.known(), of.declared()};
}

std::vector<DeclaredKey> declared_keys(const Rig& rig) {
  const auto of_probes = [&](const char* key, auto of) {
    return declared_state(key, rig.probes,
                          [of](const Probe& probe) { return probe.uncertainty.*of; });
  };
  const RigUncertainty& u = rig.uncertainty;
  return {of_probes("u_calibration_um", &ProbeUncertainty::calibration),
          of_probes("u_sensitivity_ppm", &ProbeUncertainty::sensitivity),
          of_probes("u_position_mm", &ProbeUncertainty::position),
          of_probes("u_direction_mrad", &ProbeUncertainty::direction),
          declared_state("u_flatness_um", rig.planes,
                         [](const TargetPlane& plane) { return plane.u_flatness; }),
          declared_state("[encoder] u_um", u.encoder),
          declared_state("u_angle_mrad", u.installation_angle),
          declared_state("u_offset_mm", u.installation_offset),
          declared_state("u_um_per_h", u.drift),
          {"[temperature] u_scale_K", rig.expansion.scale.u_temperature.known(),
           rig.expansion.scale.relative() > 0},
          {"[temperature] u_fixture_K", rig.expansion.fixture.u_temperature.known(),
           rig.expansion.fixture.relative() > 0},
          declared_state("[temperature] u_square_gradient_K_per_m", rig.expansion.square_gradient)};
}

}  // namespace

std::vector<std::string> Rig::undeclared_uncertainties() const {
  std::vector<std::string> keys;
  for (const DeclaredKey& of : declared_keys(*this))
    if (!of.everywhere) keys.emplace_back(of.key);
  for (std::string& key : undeclared_physics(*this)) keys.push_back(std::move(key));
  return keys;
}

bool Rig::declares_uncertainty() const {
  const auto keys = declared_keys(*this);
  return declares_physics(*this) ||
         std::any_of(keys.begin(), keys.end(), [](const auto& of) { return of.somewhere; });
}

Result<Rig> parse_rig(std::string_view toml_text, const std::string& source_name) {
  MDOF_TRY(auto table, TomlTable::parse(toml_text, source_name));
  Rig rig;
  rig.text = std::string(toml_text);
  rig.source = source_name;
  rig.name = table.string("name");
  const std::string axis_text = table.string("axis");
  if (const auto axis = axis_from(axis_text)) {
    rig.axis = *axis;
  } else {
    table.reject("axis", "\"" + axis_text + "\" is not an axis; use \"X\", \"Y\" or \"Z\"");
  }
  rig.sides = read_sides(table);
  if (table.has("tool_point_mm")) rig.tool_point_m = read_point(table, "tool_point_mm");
  read_artefact(table, rig);
  read_encoder(table, rig);
  read_installation_and_drift(table, rig);
  rig.expansion = read_expansion(table);
  rig.machine = read_machine(table);
  check_machine(table, rig);
  for (auto& probe : table.tables("probe")) rig.probes.push_back(read_probe(probe));
  for (auto& plane : table.tables("plane")) rig.planes.push_back(read_plane(plane));
  if (rig.probes.empty()) table.reject("probe", "the rig has no probes; add [[probe]] tables");
  if (rig.probes.size() > kMostProbes)
    table.reject("probe", "the rig has " + std::to_string(rig.probes.size()) +
                              " probes, but at most " + std::to_string(kMostProbes) +
                              " are possible");
  else
    reject_doubles(table, rig.probes);
  reject_double_planes(table, rig.planes);
  rig.report = read_report_facts(table);
  apply_records(table, toml_text, rig);
  read_physics(table, rig);
  if (const auto scan = read_scan(table, rig.axis); scan && rig.probe_index(scan->probe))
    table.reject("scan",
                 "the scan probe \"" + scan->probe +
                     "\" is already a [[probe]] of this rig; name another column of the log");
  MDOF_CHECK(table.finish());
  MDOF_CHECK(check_rig(rig));
  return rig;
}

Result<Rig> load_rig(const std::filesystem::path& file) {
  MDOF_TRY(const std::string text, load_rig_text(file));
  return parse_rig(text, file.string());
}

}  // namespace mdof
