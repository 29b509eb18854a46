#include "schema/rig/calibrated.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "schema/base/files.h"
#include "schema/calibration/certificate_facts.h"
#include "schema/uncertainty/chi_square_limit.h"
#include "schema/units.h"

namespace mdof {
namespace {

// A record of five probes has about 2 kB; with 1,000 linearity pairs for each probe it has 200 kB.
constexpr std::size_t kMostRecords = 16, kMostRecordBytes = std::size_t{256} << 10;

std::string too_many(std::size_t records) {
  return std::to_string(records) + " calibration records, but a rig can have at most " +
         std::to_string(kMostRecords) +
         "; keep the newest mounting record and the newest sensitivity records";
}

std::vector<std::string> names_of(TomlTable& rig) {
  if (!rig.has("calibration")) return {};
  if (rig.is_array("calibration")) return rig.strings("calibration");
  return {rig.string("calibration")};
}

// The data of the rig with which a record must agree.
struct Fits {
  std::string source, name, axis;
  std::vector<std::string> probes;
};

std::string joined(const std::vector<std::string>& ids) {
  std::string text;
  for (const auto& id : ids) text += (text.empty() ? "" : ", ") + id;
  return text;
}

void check_fit(const CalibrationRecord& record, const Fits& rig, TomlTable& table) {
  const auto reject = [&](const char* key, const std::string& why) {
    table.reject(key, why, Remedy::calibrate_this_rig, record.kind);
  };
  if (record.rig != rig.name)
    return reject("rig", "is \"" + record.rig + "\", but the name in " + rig.source + " is \"" +
                             rig.name + "\"");
  if (std::string(1, record.axis) != rig.axis)
    return reject("axis", "is " + std::string(1, record.axis) + ", but the axis in " + rig.source +
                              " is " + rig.axis);
  std::vector<std::string> ids, more;
  for (const auto& probe : record.probes) ids.push_back(probe.id);
  for (const auto& id : ids)
    if (std::find(rig.probes.begin(), rig.probes.end(), id) == rig.probes.end()) more.push_back(id);
  if (record.kind == "mounting")
    for (const auto& id : rig.probes)
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) more.push_back(id);
  if (!more.empty())
    reject("probe", "the record contains the probes " + joined(ids) + ", but " + rig.source +
                        " has " + joined(rig.probes));
}

// The key of a value that both records contain for a probe; nullptr: there is no such value.
const char* value_in_both(const CalibratedProbe& a, const CalibratedProbe& b) {
  if (a.position_m && b.position_m) return "position_mm";
  if (a.direction && b.direction) return "direction";
  if (a.offset_um && b.offset_um) return "offset_um";
  if (a.um_per_V && b.um_per_V) return "um_per_V";
  return !a.linearity.empty() && !b.linearity.empty() ? "linearity" : nullptr;
}

// Records of one kind are applied by date. If two of them have one date, neither is the newer one.
void check_newest(const CalibrationRecord& record, const Rig& rig, TomlTable& table) {
  for (const CalibrationRecord& other : rig.records)
    for (const CalibratedProbe& a : other.probes)
      for (const CalibratedProbe& b : record.probes) {
        if (other.kind != record.kind || other.date != record.date || a.id != b.id) continue;
        const char* key = value_in_both(a, b);
        if (key)
          table.reject("date", "the records \"" + other.id + "\" and \"" + record.id +
                                   "\" have the same date, " + record.date + ", and both contain " +
                                   key + " of the probe \"" + a.id +
                                   "\"; keep only one of these records in the key \"calibration\"");
      }
}

std::string listed(const std::vector<std::string>& ids) {
  return ids.empty() ? "no sensitivity record" : "\"" + joined(ids) + "\"";
}

// The positions and zeros of a mounting are right only with the sensitivities of its calibration.
void check_sensitivities(const CalibrationRecord& mounting, const Rig& rig, TomlTable& table) {
  if (!mounting.sensitivities) return;
  std::vector<std::string> used = *mounting.sensitivities, named;
  for (const CalibrationRecord& record : rig.records)
    if (record.kind == "sensitivity") named.push_back(record.id);
  std::sort(used.begin(), used.end());
  std::sort(named.begin(), named.end());
  if (used != named)
    table.reject("sensitivities",
                 "the mounting record \"" + mounting.id + "\" was calculated with " + listed(used) +
                     ", but the key \"calibration\" of the rig names " + listed(named),
                 Remedy::calibrate_anew);
}

Fits fits_of(TomlTable& rig, const std::string& source) {
  Fits fits{source, rig.string("name", ""), rig.string("axis", ""), {}};
  for (auto& probe : rig.tables("probe")) fits.probes.push_back(probe.string("id", ""));
  return fits;
}

Result<std::string> read_one(const std::filesystem::path& file, const Fits& rig,
                             const std::string& where) {
  auto text = read_text_file(file, kMostRecordBytes);
  if (!text) return in_context(where, text.error());
  MDOF_TRY(TomlTable table, TomlTable::parse(*text, file.string()));
  const auto parts = record_parts(*text);
  if (parts.size() != 1 || !table.is_array("calibration_record"))
    return bad_input(file.string() + ": is not a calibration record", Remedy::calibrate_anew);
  auto tables = table.tables("calibration_record");
  const CalibrationRecord record = read_record(tables.front());
  if (!is_unchanged(parts.front()))
    tables.front().reject(
        "sha256", "does not match the text below it; the record was changed after the calibration",
        Remedy::calibrate_anew);
  check_fit(record, rig, tables.front());
  MDOF_CHECK(table.finish());
  return std::string(parts.front());
}

// If the offset increases, the reading t = raw - offset decreases by the same amount. Corrections
// that are functions of t must be shifted by this amount.
void move_offset(Calibration& calibration, double offset_um) {
  const double by_um = offset_um - calibration.offset_um;
  calibration.offset_um = offset_um;
  for (auto& [reading_um, correction_um] : calibration.linearity) reading_um -= by_um;
  if (auto& stretch = calibration.calibrated_um)
    *stretch = {(*stretch)[0] - by_um, (*stretch)[1] - by_um};
  auto& c = calibration.polynomial_um;  // coefficients of p(t + by), by Horner's rule
  for (std::size_t i = 0; i + 1 < c.size(); ++i)
    for (std::size_t j = c.size() - 1; j-- > i;) c[j] += by_um * c[j + 1];
}

void apply(const std::string& record, const CalibratedProbe& found, Probe& probe) {
  Calibration& calibration = probe.calibration;
  if (found.position_m) {
    probe.position_m = *found.position_m;
    probe.uncertainty.position = {found.u_position_m};
  }
  if (found.direction) {
    if (!probe.nominal_direction) probe.nominal_direction = probe.direction;
    probe.direction = *found.direction;
    probe.uncertainty.direction = {found.u_direction_rad};
  }
  if (found.um_per_V) {
    calibration.um_per_V = found.um_per_V;
    calibration.scale_record = record;
  }
  if (found.u_sensitivity_1 > 0)
    probe.uncertainty.sensitivity = {found.u_sensitivity_1, UncertaintyShape::normal,
                                     found.sensitivity_freedom};
  if (found.offset_um) {
    move_offset(calibration, *found.offset_um);
    if (!probe.uncertainty.calibration.known()) probe.uncertainty.calibration = {found.u_offset_m};
  }
  // The range is relative to the offset of the record.
  if (found.calibrated_um) calibration.calibrated_um = found.calibrated_um;
  if (found.linearity.empty()) return;
  calibration.linearity = found.linearity;
  calibration.polynomial_um.clear();
  if (!found.calibrated_um)  // the record is a certificate or is from an older version
    calibration.calibrated_um = {found.linearity.front()[0], found.linearity.back()[0]};
}

// Removes covariances that are no longer valid: the covariances of positions and directions in
// earlier records that this record replaces, and the covariances of zeros that the rig declares.
void erase_invalid_covariances(CalibrationRecord& record, Rig& rig) {
  for (const CalibratedProbe& found : record.probes)
    for (const Probe& probe : rig.probes) {
      if (probe.id != found.id) continue;
      if (probe.uncertainty.calibration.known()) record.covariance.erase(zero_name(found.id));
      for (CalibrationRecord& earlier : rig.records)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (found.position_m) earlier.covariance.erase(place_name(found.id, axis));
          if (found.direction) earlier.covariance.erase(direction_name(found.id, axis));
        }
    }
}

void apply(CalibrationRecord& record, Rig& rig) {
  erase_invalid_covariances(record, rig);
  for (const CalibratedProbe& found : record.probes)
    for (Probe& probe : rig.probes)
      if (probe.id == found.id) apply(record.id, found, probe);
  auto& offset = rig.uncertainty.installation_offset;
  if (record.u_together_m && !offset.known()) offset = {*record.u_together_m};
}

void apply_certificates(TomlTable& record, Rig& rig) {
  for (TomlTable& table : record.tables("probe")) {
    const CertificateFacts facts = read_certificate(table);
    const auto at = rig.probe_index(table.string("id"));
    if (!at || facts.certificate.empty()) continue;
    Calibration& calibration = rig.probes[*at].calibration;
    calibration.certificate = facts.certificate;
    calibration.laboratory = facts.laboratory;
    calibration.calibrated = facts.calibrated;
    calibration.due = facts.due;
  }
}

}  // namespace

Result<std::string> load_rig_text(const std::filesystem::path& file) {
  MDOF_TRY(std::string text, read_text_file(file));
  auto table = TomlTable::parse(text, file.string());
  if (!table || table->has("calibration_record")) return text;  // parse_rig() reports the error
  const Fits rig = fits_of(*table, file.string());
  const auto names = names_of(*table);
  if (names.size() > kMostRecords)
    return bad_input(table->where("calibration") + ": names " + too_many(names.size()));
  std::string records;
  for (const std::string& name : names) {
    MDOF_TRY(const std::string record,
             read_one(file.parent_path() / name, rig, table->where("calibration")));
    records += record;
  }
  if (records.empty()) return text;
  return text + (text.ends_with('\n') ? "" : "\n") + records;
}

std::vector<std::size_t> order_of_records(std::vector<TomlTable>& tables) {
  std::vector<std::tuple<bool, std::string, std::size_t>> keys;  // is a mounting, date, index
  for (TomlTable& table : tables)
    keys.emplace_back(table.string("kind") == "mounting", table.string("date"), keys.size());
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& [mounting, date, i] : keys) order.push_back(i);
  return order;
}

void apply_records(TomlTable& table, std::string_view text, Rig& rig) {
  const auto names = names_of(table);
  auto tables = table.tables("calibration_record");
  const auto parts = record_parts(text);
  if (names.size() != tables.size() || parts.size() != tables.size())
    return table.reject("calibration", "the rig lists " + std::to_string(names.size()) +
                                           " record files, but the text of the rig contains " +
                                           std::to_string(parts.size()) +
                                           " calibration records; give the path of the rig file, "
                                           "so that mdof reads the records from their files");
  if (parts.size() > kMostRecords)
    return table.reject("calibration", "names " + too_many(parts.size()));
  for (const std::string_view part : parts)
    if (part.size() > kMostRecordBytes)
      return table.reject("calibration",
                          "a record has " + std::to_string(part.size()) + " bytes, but at most " +
                              std::to_string(kMostRecordBytes) + " are possible",
                          Remedy::calibrate_anew);
  Fits fits{rig.source, rig.name, std::string(1, letter(rig.axis)), {}};
  for (const Probe& probe : rig.probes) fits.probes.push_back(probe.id);
  for (const std::size_t i : order_of_records(tables)) {
    CalibrationRecord record = read_record(tables[i]);
    if (!is_unchanged(parts[i]))
      tables[i].reject("sha256", "does not match the text below it", Remedy::calibrate_anew);
    check_fit(record, fits, tables[i]);
    check_newest(record, rig, tables[i]);
    check_sensitivities(record, rig, tables[i]);
    apply(record, rig);
    apply_certificates(tables[i], rig);
    rig.records.push_back(std::move(record));
  }
}

namespace {

// The file may contain any number, so the number is limited.
int freedom_of(const CalibrationRecord& record) {
  return static_cast<int>(std::clamp<std::int64_t>(record.freedom, 0, 1'000'000));
}

}  // namespace

Notices calibration_notices(const Rig& rig) {
  Notices notices;
  for (const CalibrationRecord& record : rig.records) {
    notices.push_back(notice(record.kind == "mounting" ? NoticeCode::positions_calibrated
                                                       : NoticeCode::sensitivity_calibrated,
                             record.id,
                             {{"date", record.date}, {"valid_until", record.valid_until}}));
    const double limit = chi_square_limit(freedom_of(record));
    if (record.freedom <= 0 || record.chi_square <= limit) continue;
    notices.push_back(
        notice(NoticeCode::mounting_not_explained, record.id,
               {{"chi_square", record.chi_square}, {"freedom", record.freedom}, {"limit", limit}}));
  }
  return notices;
}

// The rig is parsed only if its text can contain a record, because lists may contain thousands of
// runs.
Notices calibration_notices(std::string_view rig_text) {
  if (rig_text.find("calibration_record") == rig_text.npos) return {};
  const auto rig = parse_rig(rig_text, "rig");
  return rig ? calibration_notices(*rig) : Notices();
}

}  // namespace mdof
