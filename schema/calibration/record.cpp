#include "schema/calibration/record.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "schema/base/json_writer.h"
#include "schema/base/sha256.h"
#include "schema/calibration/certificate_facts.h"
#include "schema/units.h"

namespace mdof {
namespace {

constexpr std::string_view kHashKey = "sha256 = \"";
constexpr std::size_t kIdDigits = 8;
constexpr double kUm2 = 1e12;  // square micrometres in a square metre

// Returns a line of TOML. Numbers, strings and lists are written as in JSON, and numbers without
// rounding.
template <class T>
std::string line(const char* key, const T& value) {
  JsonWriter json;
  json.value(value);
  return std::string(key) + " = " + json.take() + "\n";
}

std::string list(const char* key, const std::vector<double>& numbers) {
  std::string text = std::string(key) + " = [";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    JsonWriter json;
    json.value(numbers[i]);
    text += (i > 0 ? ", " : "") + json.take();
  }
  return text + "]\n";
}

std::string vector_mm(const char* key, const Vec3& v_m) {
  return list(key, {to_mm(v_m[0]), to_mm(v_m[1]), to_mm(v_m[2])});
}

std::string table_of(const std::vector<std::array<double, 2>>& linearity) {
  std::string text = "linearity = [";
  for (const auto& [reading_um, correction_um] : linearity) {
    JsonWriter json;
    json.begin_array().value(reading_um).value(correction_um).end_array();
    text += (text.back() == '[' ? "" : ", ") + json.take();
  }
  return text + "]\n";
}

// Returns pairs of a key and the text of a certificate that belongs to the key. The writer and the
// reader use these pairs.
template <class Facts>
auto certificate_keys(Facts& facts) {
  return std::array{std::pair{"certificate", &facts.certificate},
                    std::pair{"laboratory", &facts.laboratory},
                    std::pair{"serial_number", &facts.serial_number},
                    std::pair{"calibrated", &facts.calibrated}, std::pair{"due", &facts.due}};
}

std::string facts_text(const CertificateFacts& facts) {
  std::string text;
  if (facts.u_linearity_m > 0) text += line("u_linearity_um", to_um(facts.u_linearity_m));
  for (const auto& [key, value] : certificate_keys(facts))
    if (!value->empty()) text += line(key, *value);
  return text;
}

std::string probe_text(const CalibratedProbe& probe) {
  std::string text = "\n[[calibration_record.probe]]\n" + line("id", probe.id);
  if (probe.position_m)
    text += vector_mm("position_mm", *probe.position_m) +
            vector_mm("u_position_mm", probe.u_position_m);
  if (probe.direction) {
    const Vec3& d = *probe.direction;
    text += list("direction", {d[0], d[1], d[2]}) +
            line("u_direction_mrad", probe.u_direction_rad * 1e3);
  }
  if (probe.offset_um)
    text += line("offset_um", *probe.offset_um) + line("u_offset_um", to_um(probe.u_offset_m));
  if (probe.um_per_V) text += line("um_per_V", *probe.um_per_V);
  if (!probe.linearity.empty()) text += table_of(probe.linearity);
  if (const auto& stretch = probe.calibrated_um)
    text += list("calibrated_um", {(*stretch)[0], (*stretch)[1]});
  if (probe.u_sensitivity_1 > 0) text += line("u_sensitivity_ppm", probe.u_sensitivity_1 * 1e6);
  if (std::isfinite(probe.sensitivity_freedom))
    text += line("sensitivity_dof", probe.sensitivity_freedom);
  return text;
}

std::string list_of_names(const char* key, const std::vector<std::string>& names) {
  JsonWriter json;
  json.begin_array();
  for (const std::string& name : names) json.value(name);
  return std::string(key) + " = " + json.end_array().take() + "\n";
}

std::string covariance_text(const CalibrationCovariance& covariance) {
  if (covariance.of.empty()) return "";
  std::string text = list_of_names("covariance_of", covariance.of) + "covariance_um2 = [\n";
  for (const auto& row_m2 : covariance.m2) {
    JsonWriter row;
    row.begin_array();
    for (const double m2 : row_m2) row.value(m2 * kUm2);
    text += "  " + row.end_array().take() + ",\n";
  }
  return text + "]\n";
}

std::string body_text(const CalibrationRecord& record) {
  std::string text = line("kind", record.kind) + line("rig", record.rig) +
                     line("axis", std::string(1, record.axis)) + line("date", record.date) +
                     line("valid_until", record.valid_until) + line("software", record.software) +
                     line("chi_square", record.chi_square) + line("freedom", record.freedom);
  if (record.sensitivities) text += list_of_names("sensitivities", *record.sensitivities);
  if (record.u_together_m) text += vector_mm("u_together_mm", *record.u_together_m);
  if (!record.not_seen.empty()) {
    text += "not_seen = [\n";
    for (const std::string& what : record.not_seen) {
      JsonWriter json;
      json.value(what);
      text += "  " + json.take() + ",\n";
    }
    text += "]\n";
  }
  text += covariance_text(record.covariance);
  for (const auto& source : record.sources)
    text += "\n[[calibration_record.source]]\n" + line("file", source.file) +
            line("sha256", source.sha256);
  for (const auto& probe : record.probes) text += probe_text(probe);
  return text;
}

Vec3 read_mm(TomlTable& table, const char* key) {
  const Vec3 mm = table.vector3(key);
  return {from_mm(mm[0]), from_mm(mm[1]), from_mm(mm[2])};
}

double read_u(TomlTable& table, const char* key) {
  const double u = table.number(key);
  if (!(u >= 0 && std::isfinite(u)))
    table.reject(key, "must be a standard uncertainty: a number of 0 or greater");
  return u;
}

std::string read_day(TomlTable& table, const char* key) {
  std::string day = table.string(key);
  const bool digits = std::all_of(day.begin(), day.end(),
                                  [](char c) { return c == '-' || (c >= '0' && c <= '9'); });
  if (day.size() != 10 || !digits || day[4] != '-' || day[7] != '-')
    table.reject(key, "must be a date, YYYY-MM-DD");
  return day;
}

void read_stretch(TomlTable& table, CalibratedProbe& probe) {
  if (!table.has("calibrated_um")) return;
  const std::vector<double> ends = table.numbers("calibrated_um");
  if (ends.size() == 2 && ends[0] < ends[1])
    probe.calibrated_um = {ends[0], ends[1]};
  else
    table.reject("calibrated_um", "must be two readings [from, to] in increasing order");
}

CalibratedProbe read_probe(TomlTable& table) {
  CalibratedProbe probe;
  probe.id = table.string("id");
  if (table.has("position_mm")) {
    probe.position_m = read_mm(table, "position_mm");
    probe.u_position_m = read_mm(table, "u_position_mm");
    if (std::any_of(probe.u_position_m.begin(), probe.u_position_m.end(),
                    [](double u) { return u < 0; }))
      table.reject("u_position_mm", "must contain standard uncertainties of 0 or greater");
  }
  if (table.has("direction")) {
    const Vec3 d = table.vector3("direction");
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(length > 0)) table.reject("direction", "must not be a zero vector");
    probe.direction = Vec3{d[0] / length, d[1] / length, d[2] / length};
    probe.u_direction_rad = read_u(table, "u_direction_mrad") * 1e-3;
  }
  if (table.has("offset_um")) {
    probe.offset_um = table.number("offset_um");
    probe.u_offset_m = from_um(read_u(table, "u_offset_um"));
  }
  if (table.has("um_per_V")) {
    probe.um_per_V = table.number("um_per_V");
    if (*probe.um_per_V == 0.0) table.reject("um_per_V", "must not be zero");
  }
  for (const auto& row : table.matrix("linearity")) {
    if (row.size() != 2 || (!probe.linearity.empty() && row[0] <= probe.linearity.back()[0])) {
      table.reject("linearity",
                   "must be pairs [reading_um, correction_um] in the order of increasing readings");
      break;
    }
    probe.linearity.push_back({row[0], row[1]});
  }
  read_stretch(table, probe);
  if (table.has("u_sensitivity_ppm"))
    probe.u_sensitivity_1 = read_u(table, "u_sensitivity_ppm") / 1e6;
  if (table.has("sensitivity_dof")) {
    probe.sensitivity_freedom = table.number("sensitivity_dof");
    if (!(probe.sensitivity_freedom >= 1))
      table.reject("sensitivity_dof", "must be a number of degrees of freedom, 1 or greater");
  }
  read_certificate(table);  // the result is not used here; apply_records() uses it
  return probe;
}

// Reads the covariance. Checks that it has one row and one column for each name, is symmetric, and
// has no correlation above 1.
CalibrationCovariance read_covariance(TomlTable& table) {
  CalibrationCovariance covariance{table.strings("covariance_of"), table.matrix("covariance_um2")};
  const std::size_t n = covariance.of.size();
  bool right = covariance.m2.size() == n;
  for (auto& row : covariance.m2) {
    right = right && row.size() == n;
    for (double& m2 : row) m2 /= kUm2;
  }
  for (std::size_t i = 0; right && i < n; ++i)
    for (std::size_t j = 0; right && j <= i; ++j) {
      const auto& m2 = covariance.m2;
      right = m2[i][j] == m2[j][i] && m2[i][i] >= 0 &&
              m2[i][j] * m2[i][j] <= m2[i][i] * m2[j][j] * (1 + 1e-9);
    }
  if (right) return covariance;
  table.reject("covariance_um2",
               "must be a symmetric matrix with one row and one column for each name in "
               "covariance_of, and its correlation coefficients must be from -1 to 1");
  return {};
}

}  // namespace

std::string record_text(const CalibrationRecord& record) {
  return record_text(record, {});
}

std::string record_text(const CalibrationRecord& record, const CertificateFacts& facts) {
  const std::string body = body_text(record) + facts_text(facts);
  const std::string id =
      record.kind + "-" + record.date + "-" + sha256_hex(body).substr(0, kIdDigits);
  const std::string hashed = line("id", id) + body;
  return "# Made by a calibration of " + record.kind +
         ". To use this record, give the name of this file in the key \"calibration\" of a rig.\n# "
         "Do not edit this record: sha256 is the hash of the text below the line sha256.\n" +
         std::string(kRecordHead) + "\n" + std::string(kHashKey) + sha256_hex(hashed) + "\"\n" +
         hashed;
}

CertificateFacts read_certificate(TomlTable& probe) {
  CertificateFacts facts;
  if (probe.has("u_linearity_um")) facts.u_linearity_m = from_um(read_u(probe, "u_linearity_um"));
  for (const auto& [key, value] : certificate_keys(facts)) {
    if (!probe.has(key)) continue;
    const bool is_day = value == &facts.calibrated || value == &facts.due;
    *value = is_day ? read_day(probe, key) : probe.string(key);
  }
  return facts;
}

CalibrationRecord read_record(TomlTable& table) {
  CalibrationRecord record;
  table.string("sha256");
  record.id = table.string("id");
  record.kind = table.string("kind");
  if (record.kind != "mounting" && record.kind != "sensitivity")
    table.reject("kind", "must be \"mounting\" or \"sensitivity\"");
  record.rig = table.string("rig");
  const std::string axis = table.string("axis");
  if (axis_from(axis))
    record.axis = axis[0];
  else
    table.reject("axis", "must be \"X\", \"Y\" or \"Z\"");
  record.date = read_day(table, "date");
  record.valid_until = read_day(table, "valid_until");
  record.software = table.string("software", "");
  record.chi_square = table.number("chi_square", 0.0);
  record.freedom = table.integer("freedom", 0);
  record.not_seen = table.strings("not_seen");
  if (table.has("sensitivities")) record.sensitivities = table.strings("sensitivities");
  if (table.has("u_together_mm")) record.u_together_m = read_mm(table, "u_together_mm");
  if (table.has("covariance_of") || table.has("covariance_um2"))
    record.covariance = read_covariance(table);
  for (auto& source : table.tables("source"))
    record.sources.push_back({source.string("file"), source.string("sha256")});
  for (auto& probe : table.tables("probe")) record.probes.push_back(read_probe(probe));
  return record;
}

std::vector<std::string_view> record_parts(std::string_view text) {
  std::vector<std::string_view> parts;
  std::size_t begin = std::string_view::npos;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text.substr(at, end - at) == kRecordHead) {
      if (begin != std::string_view::npos) parts.push_back(text.substr(begin, at - begin));
      begin = at;
    }
    at = end + 1;
  }
  if (begin != std::string_view::npos) parts.push_back(text.substr(begin));
  return parts;
}

bool is_unchanged(std::string_view record_part) {
  const std::size_t key = std::min(record_part.find('\n'), record_part.size() - 1) + 1;
  const std::size_t end = record_part.find('\n', key);
  if (end == std::string_view::npos) return false;
  const std::string hash = sha256_hex(record_part.substr(end + 1));
  return record_part.substr(key, end - key) == std::string(kHashKey) + hash + "\"";
}

}  // namespace mdof
