#include "algo/calibration/certified_probe.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number_text.h"
#include "schema/rig/effects/physics.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// Limits of the ratio of two um_per_V of the same probe.
constexpr double kLeastRatio = 0.5, kMostRatio = 2;
// Largest difference of two readings that can be due to hysteresis, relative to the length of the
// table.
constexpr double kNearRows = 0.05;
constexpr double kSameScale = 3;  // limit, times u: scales that differ by less count as equal
constexpr const char* kMeasured = "basic_measuredValue";
constexpr const char* kReference = "basic_referenceValue";
constexpr const char* kError = "basic_measurementError";

bool is_sensitivity(const DccQuantity& quantity) {
  return quantity.unit.is(-1, 1) || quantity.unit.is(1, -1);
}

bool is_reading(const DccQuantity& quantity) {
  return quantity.unit.is(1, 0) || quantity.unit.is(0, 1);
}

// The columns of a table; either `error` or `reference` may be null.
struct Table {
  const DccQuantity *measured = nullptr, *error = nullptr, *reference = nullptr;
  bool whole() const { return measured && (error || reference); }
};

Table table_of(const std::vector<DccQuantity>& list) {
  Table table;
  for (const DccQuantity& quantity : list) {
    if (!is_reading(quantity)) continue;
    if (quantity.has_type(kMeasured)) table.measured = &quantity;
    if (quantity.has_type(kError)) table.error = &quantity;
    if (quantity.has_type(kReference)) table.reference = &quantity;
  }
  return table;
}

std::string number(double x) {
  return plain_number(x, 6);
}

using Rows = std::vector<std::array<double, 2>>;  // um: reading, correction

double half_span_um(const Rows& rows) {
  const auto [least, most] = std::minmax_element(rows.begin(), rows.end());
  return ((*most)[0] - (*least)[0]) / 2;
}

// Returns whether the slope of the corrections differs from scale_1 by at most within_1. The slope
// is calculated twice: from the two end rows, and by a least-squares line. One of the two slopes
// must agree, because a laboratory may define the sensitivity by either slope.
bool contains_scale(const Rows& rows, double scale_1, double within_1) {
  const auto [least, most] = std::minmax_element(rows.begin(), rows.end());
  const double by_ends = ((*most)[1] - (*least)[1]) / ((*most)[0] - (*least)[0]);
  double r = 0, c = 0, rr = 0, rc = 0;
  for (const auto& row : rows) r += row[0], c += row[1];
  const auto n = static_cast<double>(rows.size());
  for (const auto& row : rows) {
    rr += (row[0] - r / n) * (row[0] - r / n);
    rc += (row[0] - r / n) * (row[1] - c / n);
  }
  return std::min(std::abs(by_ends - scale_1), std::abs(rc / rr - scale_1)) <= within_1;
}

class CertificateReader {
 public:
  CertificateReader(const Rig& rig, std::size_t probe, const DccCertificate& certificate)
      : rig_(rig), own_(rig.probes[probe]), from_(certificate) {
    found_.probe.id = own_.id;
    found_.facts = {from_.number,     from_.laboratory, from_.serial_number,
                    from_.calibrated, from_.due,        0};
  }

  Result<CertifiedProbe> read(const std::string& result) {
    MDOF_CHECK(choose(result));
    if (sensitivities_.empty() && tables_.empty()) return nothing();
    if (!sensitivities_.empty()) MDOF_CHECK(take_sensitivity());
    if (!tables_.empty()) MDOF_CHECK(take_table());
    if (sensitivities_.empty())
      found_.not_taken.push_back(notice(NoticeCode::sensitivity_not_certified));
    if (tables_.empty()) found_.not_taken.push_back(notice(NoticeCode::linearity_not_certified));
    return std::move(found_);
  }

 private:
  std::string at(long line) const { return from_.source + ":" + std::to_string(line) + ": "; }

  Status choose(const std::string& wanted) {
    bool any = false;
    for (const DccResult& result : from_.results) {
      names_ += (names_.empty() ? "\"" : ", \"") + result.name + "\"";
      const auto& types = result.ref_types;
      if (!wanted.empty() && result.name != wanted &&
          std::find(types.begin(), types.end(), wanted) == types.end())
        continue;
      any = true;
      for (const DccQuantity& quantity : result.quantities) look_at(quantity);
      for (const auto& list : result.lists) {
        for (const DccQuantity& quantity : list) look_at(quantity);
        if (const Table table = table_of(list); table.whole()) tables_.push_back(table);
      }
    }
    if (any || wanted.empty()) return {};
    return fail(ErrorCode::usage, from_.source + ": has no result \"" + wanted +
                                      "\"; the results of the certificate are " +
                                      (names_.empty() ? "none" : names_));
  }

  void look_at(const DccQuantity& quantity) {
    if (is_sensitivity(quantity)) sensitivities_.push_back(&quantity);
  }

  tl::unexpected<Error> nothing() const {
    return bad_input(
        from_.source +
        ": the certificate contains neither a sensitivity (a quantity in volts per length) nor a "
        "table that mdof can read. Such a table consists of a list of readings (refType "
        "basic_measuredValue) and a list of errors (basic_measurementError) or of reference values "
        "(basic_referenceValue); ask the laboratory for a DCC with these refTypes, or write "
        "um_per_V and linearity into the rig by hand");
  }

  tl::unexpected<Error> several(const char* what, long line, long other) const {
    return bad_input(at(line) + "the certificate contains a second " + what +
                     " (the first is in line " + std::to_string(other) +
                     "); choose one result of the certificate: " + names_);
  }

  tl::unexpected<Error> no_uncertainty(long line, const char* what) const {
    return bad_input(at(line) + "the " + what +
                     " has no uncertainty in the certificate, so the value cannot be used; "
                     "ask the laboratory for a certificate that states the uncertainty");
  }

  tl::unexpected<Error> zero_uncertainty(long line, const char* what) const {
    return bad_input(at(line) + "the certificate states an uncertainty of 0 for the " + what +
                     ", but every calibration has an uncertainty; ask the laboratory to correct "
                     "the DCC");
  }

  Status take_sensitivity() {
    const DccQuantity& s = *sensitivities_.front();
    if (sensitivities_.size() > 1) return several("sensitivity", sensitivities_[1]->line, s.line);
    if (s.value.size() != 1)
      return bad_input(at(s.line) + "the sensitivity has " + std::to_string(s.value.size()) +
                       " values, but mdof reads only one; ask the laboratory for the mean "
                       "sensitivity and a table of errors");
    if (s.value[0] == 0)
      return bad_input(at(s.line) + "the sensitivity is 0; ask the laboratory to correct the DCC");
    if (s.u.empty()) return no_uncertainty(s.line, "sensitivity");
    if (!(s.u[0] > 0)) return zero_uncertainty(s.line, "sensitivity");
    const double m_per_V = s.unit.is(1, -1) ? s.value[0] : 1 / s.value[0];
    const double um_per_V = to_um(m_per_V);
    MDOF_CHECK(check_scale(s, um_per_V));
    CalibratedProbe& probe = found_.probe;
    probe.um_per_V = um_per_V;
    probe.u_sensitivity_1 = s.u[0] / std::abs(s.value[0]);
    found_.taken.push_back(notice(NoticeCode::certified_sensitivity, "",
                                  {{"um_per_V", um_per_V},
                                   {"sensitivity", s.value[0] / s.unit.factor},
                                   {"unit", s.unit_text},
                                   {"line", s.line}}));
    found_.taken.push_back(notice(NoticeCode::certified_u_sensitivity, "",
                                  {{"u_sensitivity_ppm", probe.u_sensitivity_1 * 1e6},
                                   {"coverage_factor", s.coverage_factor[0]}}));
    take_zero();
    return {};
  }

  Status check_scale(const DccQuantity& s, double um_per_V) const {
    const auto& of_rig = own_.calibration.um_per_V;
    if (!of_rig) return {};
    const double ratio = um_per_V / *of_rig;
    if (ratio >= kLeastRatio && ratio <= kMostRatio) return {};
    return bad_input(
        at(s.line) + "the sensitivity of the certificate gives um_per_V = " + number(um_per_V) +
        ", but probe \"" + own_.id + "\" of " + rig_.source + " has " + number(*of_rig) +
        "; give the certificate of this probe, or correct the keys \"um_per_V\" and \"reads\" of "
        "the rig");
  }

  // The zero of the probe is a voltage. offset_um is this voltage times um_per_V.
  void take_zero() {
    const Calibration& c = own_.calibration;
    if (!c.um_per_V || c.offset_um == 0) return;
    CalibratedProbe& probe = found_.probe;
    probe.offset_um = c.offset_um * (*probe.um_per_V / *c.um_per_V);
    probe.u_offset_m = own_.uncertainty.calibration.u;
    found_.taken.push_back(
        notice(NoticeCode::certified_zero, "", {{"offset_um", *probe.offset_um}}));
  }

  // Factor from the unit of a column of readings or errors to um.
  Result<double> scale(const DccQuantity& quantity) const {
    if (quantity.unit.is(1, 0)) return to_um(1);
    const auto& um_per_V =
        found_.probe.um_per_V ? found_.probe.um_per_V : own_.calibration.um_per_V;
    if (um_per_V) return *um_per_V;
    return bad_input(at(quantity.line) +
                     "the column is in volts, but neither the certificate nor the rig states the "
                     "sensitivity; add um_per_V to probe \"" +
                     own_.id + "\" of " + rig_.source);
  }

  struct Column {
    std::vector<double> um, u_um;  // u_um is empty if the certificate states no u
  };
  Result<Column> column(const DccQuantity* quantity, std::size_t rows) const {
    Column column;
    if (!quantity) return column;
    if (quantity->value.size() != rows)
      return bad_input(at(quantity->line) + "the column has " +
                       std::to_string(quantity->value.size()) + " values, but the table has " +
                       std::to_string(rows) + " readings; ask the laboratory to correct the DCC");
    MDOF_TRY(const double um_per_unit, scale(*quantity));
    for (const double x : quantity->value) column.um.push_back(x * um_per_unit);
    for (const double u : quantity->u) column.u_um.push_back(u * std::abs(um_per_unit));
    return column;
  }

  Status take_table() {
    const Table& table = tables_.front();
    const DccQuantity& r = *table.measured;
    if (tables_.size() > 1) return several("table", tables_[1].measured->line, r.line);
    if (r.value.size() < 2)
      return bad_input(
          at(r.line) +
          "the table has only one row; ask the laboratory for a table of two rows or more");
    MDOF_TRY(const Column read, column(&r, r.value.size()));
    MDOF_TRY(const Column error, column(table.error, r.value.size()));
    MDOF_TRY(const Column reference, column(table.reference, r.value.size()));
    MDOF_CHECK(check_rows(table, read, error, reference));
    auto& rows = found_.probe.linearity;
    for (std::size_t i = 0; i < read.um.size(); ++i)
      rows.push_back({read.um[i], table.error ? -error.um[i] : reference.um[i] - read.um[i]});
    const double u_um = largest_u(table, read, error, reference);
    const bool is_stated = !error.u_um.empty() || !read.u_um.empty() || !reference.u_um.empty();
    const DccQuantity& certified = table.error ? *table.error : r;
    if (!(u_um > 0))
      return is_stated ? zero_uncertainty(certified.line, "table")
                       : no_uncertainty(certified.line, "table");
    if (found_.probe.um_per_V && half_span_um(rows) > 0) MDOF_CHECK(match_scale(r, u_um, rows));
    MDOF_CHECK(about_zero(rows, r.line));
    found_.facts.u_linearity_m = from_um(u_um);
    found_.taken.push_back(notice(NoticeCode::certified_linearity, "",
                                  {{"corrections", rows.size()},
                                   {"ref_type", table.error ? kError : kReference},
                                   {"line", r.line}}));
    found_.taken.push_back(
        notice(NoticeCode::certified_u_linearity, "", {{"u_linearity_um", u_um}}));
    return {};
  }

  // Checks that errors are reading minus reference value, and that readings increase with the
  // reference values.
  Status check_rows(const Table& table, const Column& read, const Column& error,
                    const Column& reference) const {
    if (!table.reference) return {};
    const auto [least, most] = std::minmax_element(reference.um.begin(), reference.um.end());
    const double slope =
        (read.um[most - reference.um.begin()] - read.um[least - reference.um.begin()]) /
        (*most - *least);
    if (!(slope >= kLeastRatio && slope <= kMostRatio))
      return bad_input(at(table.measured->line) + "the readings change by " + number(slope) +
                       " um when the reference values change by 1 um; check the keys \"um_per_V\" "
                       "and \"reads\" of probe \"" +
                       own_.id + "\" in " + rig_.source +
                       ", and check the units of the table in the certificate");
    for (std::size_t i = 0; table.error && i < read.um.size(); ++i) {
      // 2 u also covers the rounding of the three columns.
      const double off = std::abs(read.um[i] - reference.um[i] - error.um[i]);
      if (error.u_um.empty() || off <= 2 * error.u_um[i]) continue;
      return bad_input(at(table.error->line) + "error " + std::to_string(i + 1) + " is " +
                       number(error.um[i]) + " um, but reading minus reference is " +
                       number(read.um[i] - reference.um[i]) +
                       " um; ask the laboratory to correct the DCC");
    }
    return {};
  }

  // Prevents that both the new um_per_V and the table correct the same scale error. If the slope of
  // the corrections is the change of um_per_V, the readings were calculated with um_per_V of the
  // rig. They are then converted to the new um_per_V.
  Status match_scale(const DccQuantity& read, double u_um, Rows& rows) {
    const CalibratedProbe& probe = found_.probe;
    const double within_1 =
        kSameScale * std::hypot(probe.u_sensitivity_1, u_um / half_span_um(rows));
    if (contains_scale(rows, 0, within_1)) return {};
    const auto& of_rig = own_.calibration.um_per_V;
    const double ratio = of_rig ? *probe.um_per_V / *of_rig : 1;
    if (!read.unit.is(1, 0) || !of_rig || !contains_scale(rows, ratio - 1, within_1))
      return bad_input(
          at(read.line) + "the sensitivity (" + number(*probe.um_per_V) +
          " um/V) and the table of the certificate both correct the scale of the probe, so mdof "
          "would correct the scale twice. Set um_per_V of probe \"" +
          own_.id + "\" in " + rig_.source + (of_rig ? " (" + number(*of_rig) + ")" : "") +
          " to the value that the laboratory used for the readings of the table, or choose one "
          "result of the certificate: " +
          names_);
    for (auto& [reading, correction] : rows) {
      correction += reading * (1 - ratio);
      reading *= ratio;
    }
    found_.taken.push_back(notice(NoticeCode::certified_readings_converted, "",
                                  {{"from_um_per_V", *of_rig}, {"um_per_V", *probe.um_per_V}}));
    return {};
  }

  // Subtracts the offset from the readings, sorts the rows, and shifts the corrections so that the
  // correction is 0 at reading - offset = 0. Rows of both directions of motion would be a
  // saw-tooth.
  Status about_zero(Rows& rows, long line) const {
    const double offset_um = found_.probe.offset_um.value_or(own_.calibration.offset_um);
    for (auto& row : rows) row[0] -= offset_um;
    std::sort(rows.begin(), rows.end());
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double step_um = rows[i][0] - rows[i - 1][0];
      const double moved_um = step_um + rows[i][1] - rows[i - 1][1];
      if (step_um > kNearRows * (rows.back()[0] - rows.front()[0])) continue;
      if (step_um > 0 && moved_um >= kLeastRatio * step_um) continue;
      return bad_input(
          at(line) + "two rows of the table have " +
          (step_um > 0 ? "readings that differ by " + number(step_um) +
                             " um, but almost the same displacement"
                       : "the same reading") +
          "; ask the laboratory for a table that was measured in one direction of motion, or for "
          "the means of both directions");
    }
    Calibration own;
    own.linearity = rows;
    const double at_zero_um = linearity_um(own, 0);
    for (auto& row : rows) row[1] -= at_zero_um;
    return {};
  }

  // Largest u of the errors if the certificate states u of the errors. Otherwise the largest
  // combined u of reading and reference value.
  double largest_u(const Table& table, const Column& read, const Column& error,
                   const Column& reference) {
    if (table.error && !error.u_um.empty())
      return *std::max_element(error.u_um.begin(), error.u_um.end());
    if (read.u_um.empty() != (reference.u_um.empty() || !table.reference))
      found_.not_taken.push_back(
          notice(NoticeCode::u_not_certified, "",
                 {{"ref_type", read.u_um.empty() ? kMeasured : kReference}}));
    double largest = 0;
    for (std::size_t i = 0; i < read.um.size(); ++i)
      largest = std::max(largest, std::hypot(read.u_um.empty() ? 0 : read.u_um[i],
                                             reference.u_um.empty() ? 0 : reference.u_um[i]));
    return largest;
  }

  const Rig& rig_;
  const Probe& own_;
  const DccCertificate& from_;
  CertifiedProbe found_;
  std::string names_;  // names of all results
  std::vector<const DccQuantity*> sensitivities_;
  std::vector<Table> tables_;
};

}  // namespace

Result<CertifiedProbe> certified_probe(const Rig& rig, std::size_t probe,
                                       const DccCertificate& certificate,
                                       const std::string& result) {
  return CertificateReader(rig, probe, certificate).read(result);
}

}  // namespace mdof::algo
