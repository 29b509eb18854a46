// Certificates in the SI units of read_dcc(). Expected values are calculated by hand.
#include "algo/calibration/certified_probe.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace mdof::algo::certificates {
namespace {

constexpr SiUnit kMetre{1e-6, 1, 0}, kVolt{1, 0, 1};

DccQuantity quantity(const std::vector<std::string>& types, SiUnit unit, std::vector<double> value,
                     std::vector<double> u, long line) {
  DccQuantity q;
  q.ref_types = types;
  q.unit = unit;
  q.coverage_factor.assign(u.size(), 2);
  q.value = std::move(value);
  q.u = std::move(u);
  q.line = line;
  return q;
}

DccQuantity measured(SiUnit unit, std::vector<double> value, std::vector<double> u = {}) {
  return quantity({"x_raw", "basic_measuredValue"}, unit, std::move(value), std::move(u), 31);
}

DccQuantity error(SiUnit unit, std::vector<double> value, std::vector<double> u = {}) {
  return quantity({"basic_measurementError"}, unit, std::move(value), std::move(u), 47);
}

DccQuantity reference(SiUnit unit, std::vector<double> value, std::vector<double> u = {}) {
  return quantity({"basic_referenceValue"}, unit, std::move(value), std::move(u), 53);
}

// A certificate of 21 V/mm with U = 0.168 V/mm and k = 2, which is 47.619 µm/V with u = 0.4 %.
DccQuantity sensitivity() {
  DccQuantity s = quantity({}, {1000, -1, 1}, {21000}, {84}, 17);
  s.unit_text = "\\volt\\per\\milli\\metre";
  return s;
}

DccCertificate certificate(std::vector<DccQuantity> alone,
                           std::vector<std::vector<DccQuantity>> lists = {}) {
  DccCertificate c;
  c.source = "c.xml";
  c.number = "N-17";
  c.laboratory = "Lab";
  c.calibrated = "2026-03-04";
  c.due = "2027-05-06";
  c.serial_number = "S-99";
  c.results = {{"as found", {"basic_asFound"}, std::move(lists), std::move(alone), 11}};
  return c;
}

Rig rig_of(std::optional<double> um_per_V, double offset_um) {
  Rig rig;
  rig.source = "r.toml";
  rig.probes.resize(3);
  rig.probes[0].id = "A";
  rig.probes[1].id = "B";
  rig.probes[1].calibration.um_per_V = um_per_V;
  rig.probes[1].calibration.offset_um = offset_um;
  rig.probes[1].uncertainty.calibration.u = 0.7e-6;
  rig.probes[2].id = "C";
  return rig;
}

Result<CertifiedProbe> of_b(const Rig& rig, const DccCertificate& c,
                            const std::string& which = "") {
  return certified_probe(rig, 1, c, which);
}

// Returns whether the certificate is refused with a message that contains all `parts`.
testing::AssertionResult refused(const Result<CertifiedProbe>& found,
                                 const std::vector<std::string>& parts,
                                 ErrorCode code = ErrorCode::bad_input) {
  if (found) return testing::AssertionFailure() << "taken";
  const Error& e = found.error();
  if (e.code != code) return testing::AssertionFailure() << "another code: " << e.message;
  for (const std::string& part : parts)
    if (e.message.find(part) == std::string::npos)
      return testing::AssertionFailure() << "no \"" << part << "\" in " << e.message;
  return testing::AssertionSuccess();
}

bool has(const Notices& notices, const std::vector<std::string>& parts) {
  for (const Notice& each : notices) {
    bool all = true;
    for (const std::string& part : parts)
      all = all && test::shown(each).find(part) != std::string::npos;
    if (all) return true;
  }
  return false;
}

void expect_rows(const std::vector<std::array<double, 2>>& rows,
                 const std::vector<std::array<double, 2>>& expected) {
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(rows[i][c], expected[i][c], 1e-9) << i << c;
}

TEST(CertifiedProbe, ConvertsVoltsPerLengthAndTheZeroOfTheRig) {
  const auto found = of_b(rig_of(40, 12), certificate({sensitivity()}));
  ASSERT_TRUE(found) << found.error().message;
  const CalibratedProbe& p = found->probe;
  EXPECT_EQ(p.id, "B");
  EXPECT_NEAR(p.um_per_V.value(), 1000.0 / 21, 1e-9);
  EXPECT_NEAR(p.u_sensitivity_1, 0.004, 1e-15);
  // The zero of the rig is at 0.3 V, which is 12 µm at 40 µm/V.
  EXPECT_NEAR(p.offset_um.value(), 0.3 * 1000 / 21, 1e-9);
  EXPECT_EQ(p.u_offset_m, 0.7e-6);
  EXPECT_TRUE(p.linearity.empty());
  EXPECT_EQ(found->taken.size(), 3u);
  EXPECT_TRUE(has(found->taken,
                  {"um_per_V=47.619", "sensitivity=21 ", "unit=\\volt\\per\\milli", "line=17"}));
  EXPECT_TRUE(has(found->taken, {"u_sensitivity_ppm=4000", "coverage_factor=2"}));
  EXPECT_TRUE(has(found->taken, {"offset_um=14.2857"}));
  ASSERT_EQ(found->not_taken.size(), 1u);
  EXPECT_TRUE(has(found->not_taken, {"linearity_not_certified"}));
  const CertificateFacts& f = found->facts;
  EXPECT_EQ(f.certificate, "N-17");
  EXPECT_EQ(f.laboratory, "Lab");
  EXPECT_EQ(f.serial_number, "S-99");
  EXPECT_EQ(f.calibrated, "2026-03-04");
  EXPECT_EQ(f.due, "2027-05-06");
  EXPECT_EQ(f.u_linearity_m, 0);
}

// -50 µm/V with u = 0.1 µm/V. If the rig has no scale or no zero, no zero is converted.
TEST(CertifiedProbe, ReadsLengthPerVolt) {
  const DccQuantity s = quantity({}, {1e-6, 1, -1}, {-50e-6}, {0.1e-6}, 17);
  for (const auto& [um_per_V, offset_um] :
       {std::pair<std::optional<double>, double>{-40, 12}, {-40, 0}, {std::nullopt, 12}}) {
    const auto found = of_b(rig_of(um_per_V, offset_um), certificate({s}));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->probe.um_per_V.value(), -50, 1e-9);
    EXPECT_NEAR(found->probe.u_sensitivity_1, 0.002, 1e-15);
    const bool moved = um_per_V && offset_um != 0;
    EXPECT_EQ(found->probe.offset_um.has_value(), moved);
    EXPECT_EQ(found->taken.size(), moved ? 3u : 2u);
    if (moved) {
      EXPECT_NEAR(*found->probe.offset_um, 15, 1e-9);
    }
  }
}

TEST(CertifiedProbe, RefusesScaleThatContradictsTheRig) {
  const double um_per_V = 30e-6 * 1e6;
  const DccCertificate c = certificate({quantity({}, {1e-6, 1, -1}, {30e-6}, {1e-8}, 17)});
  for (const double factor : {0.5, 1.3, 2.0})  // scale of certificate / rig: 2, 0.77, 0.5
    EXPECT_TRUE(of_b(rig_of(um_per_V * factor, 0), c)) << factor;
  for (const double factor : {0.49, 2.05, -1.0})
    EXPECT_TRUE(refused(of_b(rig_of(um_per_V * factor, 0), c),
                        {"c.xml:17: ", "um_per_V = 30", "\"B\" of r.toml"}))
        << factor;
  EXPECT_TRUE(refused(of_b(rig_of(12.5, 0), c), {" has 12.5"}));
}

TEST(CertifiedProbe, RefusesAmbiguousOrIncompleteSensitivity) {
  const Rig rig = rig_of(40, 0);
  DccQuantity s = sensitivity();
  s.u.clear();
  EXPECT_TRUE(
      refused(of_b(rig, certificate({s})), {"c.xml:17: ", "sensitivity", "no uncertainty"}));
  s = sensitivity();
  s.value = {0};
  EXPECT_TRUE(refused(of_b(rig, certificate({s})), {"c.xml:17: ", " is 0"}));
  s.value = {21000, 22000, 23000};
  EXPECT_TRUE(refused(of_b(rig, certificate({s})), {"c.xml:17: ", " 3 values"}));
  s.value.clear();
  EXPECT_TRUE(refused(of_b(rig, certificate({s})), {"c.xml:17: ", " 0 values"}));
  s = sensitivity();
  s.line = 23;
  EXPECT_TRUE(refused(of_b(rig, certificate({sensitivity(), s})),
                      {"c.xml:23: ", "second sensitivity", "line 17", "\"as found\""}));
  EXPECT_TRUE(refused(of_b(rig, certificate({sensitivity()}, {{s}})), {"c.xml:23: ", "line 17"}));
}

// Errors in µm; the readings are not in ascending order. Relative to the zero at 5 µm, the readings
// are -25, 5 and 25 µm and the corrections are 0.4, -0.11 and -0.3 µm. The correction at the
// reading 0 is interpolated at 25/30 of the interval from the first to the second: -0.025 µm.
TEST(CertifiedProbe, ReadsTableOfErrors) {
  const auto found =
      of_b(rig_of(std::nullopt, 5),
           certificate({}, {{error(kMetre, {0.3e-6, -0.4e-6, 0.11e-6}, {0.05e-6, 0.08e-6, 0.06e-6}),
                             measured(kMetre, {30e-6, -20e-6, 10e-6}, {1e-6, 2e-6, 3e-6})}}));
  ASSERT_TRUE(found) << found.error().message;
  expect_rows(found->probe.linearity, {{-25, 0.425}, {5, -0.085}, {25, -0.275}});
  EXPECT_NEAR(found->facts.u_linearity_m, 0.08e-6, 1e-18);
  EXPECT_FALSE(found->probe.um_per_V);
  EXPECT_FALSE(found->probe.offset_um);
  EXPECT_EQ(found->taken.size(), 2u);
  EXPECT_TRUE(has(found->taken, {"corrections=3", "ref_type=basic_measurementError", "line=31"}));
  EXPECT_TRUE(has(found->taken, {"u_linearity_um=0.08"}));
  ASSERT_EQ(found->not_taken.size(), 1u);
  EXPECT_TRUE(has(found->not_taken, {"sensitivity_not_certified"}));
}

// Volts at -40 µm/V. The readings are -10 and 30 µm, the errors -2 and 1.2 µm; u is positive.
TEST(CertifiedProbe, ConvertsTableInVoltsByTheRigScale) {
  const std::vector<DccQuantity> table = {measured(kVolt, {0.25, -0.75}),
                                          error(kVolt, {0.05, -0.03}, {0.002, 0.003})};
  const auto found = of_b(rig_of(-40, 0), certificate({}, {table}));
  ASSERT_TRUE(found) << found.error().message;
  // The corrections are 2 and -1.2 µm, and 1.2 µm at the reading 0, a quarter of the interval.
  expect_rows(found->probe.linearity, {{-10, 0.8}, {30, -2.4}});
  EXPECT_NEAR(found->facts.u_linearity_m, 0.12e-6, 1e-18);
  EXPECT_TRUE(refused(of_b(rig_of(std::nullopt, 0), certificate({}, {table})),
                      {"c.xml:31: ", "\"B\" of r.toml"}));
}

// The certificate's scale, 50 µm/V, and zero, 0.2 V, have priority over those of the rig.
TEST(CertifiedProbe, ConvertsTableInVoltsByTheCertificateScale) {
  const DccQuantity s = quantity({}, {1, 1, -1}, {50e-6}, {1e-6}, 17);
  const auto found =
      of_b(rig_of(40, 8), certificate({s}, {{measured(kVolt, {0.6, -0.6}),
                                             error(kMetre, {1.5e-6, -0.3e-6}, {3e-8, 2e-8})}}));
  ASSERT_TRUE(found) << found.error().message;
  // The readings are 30 - 10 and -30 - 10 µm. The correction at the reading 0, at two thirds of the
  // interval from 0.3 to -1.5 µm, is -0.9 µm.
  expect_rows(found->probe.linearity, {{-40, 1.2}, {20, -0.6}});
  EXPECT_NEAR(found->facts.u_linearity_m, 0.03e-6, 1e-18);
  EXPECT_EQ(found->taken.size(), 5u);
  EXPECT_TRUE(found->not_taken.empty());
}

// 0.0499 V/um with u = 0.02 %; reference values of -80, 0 and 80 um with u = 6 nm. 3.992 V is
// 79.84 um with the rig's 20 um/V, and 80 um with the certificate: no correction remains.
TEST(CertifiedProbe, CorrectsTheScaleOnlyOnce) {
  const DccQuantity s = quantity({}, {1e6, -1, 1}, {0.0499e6}, {10}, 17);
  const auto found = [&](std::optional<double> um_per_V, double read_um) {
    return of_b(rig_of(um_per_V, 0),
                certificate({s}, {{measured(kMetre, {-read_um * 1e-6, 0, read_um * 1e-6}),
                                   reference(kMetre, {-80e-6, 0, 80e-6}, {6e-9, 5e-9, 6e-9})}}));
  };
  const auto with_rig_scale = found(20, 79.84);
  ASSERT_TRUE(with_rig_scale) << with_rig_scale.error().message;
  EXPECT_NEAR(with_rig_scale->probe.um_per_V.value(), 1 / 0.0499, 1e-9);
  expect_rows(with_rig_scale->probe.linearity, {{-80, 0}, {0, 0}, {80, 0}});
  EXPECT_TRUE(has(with_rig_scale->taken, {"certified_readings_converted from_um_per_V=20 "}));
  // Readings that agree with the scale of the certificate within 3 u (48 nm at 80 um) are kept.
  const auto found_with_scale = found(20, 79.97);
  ASSERT_TRUE(found_with_scale) << found_with_scale.error().message;
  expect_rows(found_with_scale->probe.linearity, {{-79.97, -0.03}, {0, 0}, {79.97, 0.03}});
  EXPECT_FALSE(has(found_with_scale->taken, {"certified_readings_converted"}));
  // Readings that agree with neither scale are refused.
  for (const std::optional<double> um_per_V : {std::optional<double>(), {20.04}, {20.1}})
    EXPECT_TRUE(refused(found(um_per_V, 79.84), {"c.xml:31: ", "scale twice", "\"B\" in r.toml"}));
  EXPECT_TRUE(refused(found(20, 79.7), {"c.xml:31: ", "20.0401 um/V", "\"as found\""}));
}

// Reference values instead of errors. Corrections: 2, -3, 1 µm at the readings -19, 0.5, 41 µm.
TEST(CertifiedProbe, ReadsTableOfReferenceValues) {
  const std::vector<double> read = {41e-6, -19e-6, 0.5e-6}, x = {42e-6, -17e-6, -2.5e-6};
  const std::vector<double> u_read = {3e-8, 5e-8, 4e-8}, u_x = {4e-8, 1e-8, 5e-8};
  const auto found = [&](const std::vector<double>& ur, const std::vector<double>& ux) {
    return of_b(rig_of(std::nullopt, 0.5),
                certificate({}, {{measured(kMetre, read, ur), reference(kMetre, x, ux)}}));
  };
  const auto both = found(u_read, u_x);
  ASSERT_TRUE(both) << both.error().message;
  expect_rows(both->probe.linearity, {{-19.5, 5}, {0, 0}, {40.5, 4}});
  // The combined u of the three rows is 5, √26 and √41 times 10 nm.
  EXPECT_NEAR(both->facts.u_linearity_m, std::sqrt(41.0) * 1e-8, 1e-18);
  EXPECT_TRUE(has(both->taken, {"corrections=3", "ref_type=basic_referenceValue"}));
  EXPECT_EQ(both->not_taken.size(), 1u);
  const auto from_readings = found(u_read, {});
  ASSERT_TRUE(from_readings) << from_readings.error().message;
  EXPECT_NEAR(from_readings->facts.u_linearity_m, 5e-8, 1e-18);
  EXPECT_TRUE(has(from_readings->not_taken, {"u_not_certified", "ref_type=basic_referenceValue"}));
  const auto of_x = found({}, u_x);
  ASSERT_TRUE(of_x) << of_x.error().message;
  EXPECT_NEAR(of_x->facts.u_linearity_m, 5e-8, 1e-18);
  EXPECT_TRUE(has(of_x->not_taken, {"u_not_certified", "ref_type=basic_measuredValue"}));
  EXPECT_TRUE(refused(found({}, {}), {"c.xml:31: ", "table", "no uncertainty"}));
}

// Errors without u have the u of the readings. A table without any u is refused.
TEST(CertifiedProbe, ErrorsWithoutUTakeUOfTheReadings) {
  const auto found = [](const std::vector<double>& u_read) {
    return of_b(rig_of(std::nullopt, 0), certificate({}, {{measured(kMetre, {4e-6, 9e-6}, u_read),
                                                           error(kMetre, {0.2e-6, 0.5e-6})}}));
  };
  const auto from_readings = found({6e-8, 2e-8});
  ASSERT_TRUE(from_readings) << from_readings.error().message;
  EXPECT_NEAR(from_readings->facts.u_linearity_m, 6e-8, 1e-18);
  EXPECT_TRUE(has(from_readings->not_taken, {"u_not_certified", "ref_type=basic_referenceValue"}));
  EXPECT_TRUE(refused(found({}), {"c.xml:47: ", "table", "no uncertainty"}));
}

// At 32 µm/V all numbers are exact binary fractions, so both sides of a limit can be tested.
TEST(CertifiedProbe, RefusesErrorsThatContradictTheReference) {
  const auto found = [](double error_V, const std::vector<double>& u_V, double read_V = 0.5) {
    return of_b(rig_of(32, 0),
                certificate({}, {{measured(kVolt, {-0.25, read_V, 1.0}, {0.001, 0.001, 0.001}),
                                  reference(kVolt, {-0.375, 0.25, 0.9375}),
                                  error(kVolt, {0.125, error_V, 0.0625}, u_V)}}));
  };
  const std::vector<double> u = {0.03125, 0.0625, 0.125};
  ASSERT_TRUE(found(0.25, u)) << found(0.25, u).error().message;
  EXPECT_NEAR(found(0.25, u)->facts.u_linearity_m, 4e-6, 1e-18);
  for (const double off : {-0.125, 0.125}) {  // twice the u of this error
    EXPECT_TRUE(found(0.25 + off, u)) << off;
    const double error_V = 0.25 + 1.05 * off, expected_error_um = 32 * error_V;
    EXPECT_TRUE(refused(found(error_V, u), {"c.xml:47: ", "error 2 is ", off < 0 ? "3.8" : "12.2",
                                            "reference is 8 um"}))
        << expected_error_um;
  }
  EXPECT_TRUE(found(3, {}));
  // Each row is checked separately. Here only the reading of the second row is wrong.
  EXPECT_TRUE(refused(found(0.25, u, 0.75), {"error 2 is 8 um", "reference is 16 um"}));
}

// The slope of the readings from the lowest to the highest reference value must be 0.5 to 2.
TEST(CertifiedProbe, RefusesReadingsWithImplausibleSlope) {
  const auto found = [](double slope) {
    // Row 2 has the lowest reference value, row 3 the highest. Row 1 does not fit the slope.
    return of_b(rig_of(32, 0),
                certificate({}, {{measured(kVolt, {0.9, -0.5, -0.5 + slope}),
                                  reference(kVolt, {0.5, -0.25, 0.75}, {1, 1, 1})}}));
  };
  for (const double slope : {0.5, 2.0}) EXPECT_TRUE(found(slope)) << slope;
  for (const double slope : {0.4375, 2.125, -1.0})
    EXPECT_TRUE(refused(found(slope), {"c.xml:31: ", "\"B\"", "r.toml"})) << slope;
  EXPECT_TRUE(refused(found(2.125), {"by 2.125 um when the reference values change by 1 um"}));
}

TEST(CertifiedProbe, RefusesTablesWithInconsistentRows) {
  const Rig rig = rig_of(40, 0);
  const DccQuantity r = measured(kMetre, {4e-6, 9e-6, 7e-6}),
                    e = error(kMetre, {1e-7, 2e-7}, {1e-8});
  EXPECT_TRUE(
      refused(of_b(rig, certificate({}, {{r, e}})), {"c.xml:47: ", " 2 values", "has 3 readings"}));
  EXPECT_TRUE(refused(of_b(rig, certificate({}, {{r, reference(kMetre, {1e-6})}})),
                      {"c.xml:53: ", " 1 values", "has 3 readings"}));
  EXPECT_TRUE(refused(
      of_b(rig, certificate({}, {{measured(kMetre, {4e-6}), error(kMetre, {1e-7}, {1e-8})}})),
      {"c.xml:31: ", "one row"}));
  EXPECT_TRUE(
      refused(of_b(rig, certificate({}, {{measured(kMetre, {4e-6, 9e-6, 4e-6}),
                                          error(kMetre, {1e-7, 2e-7, 3e-7}, {1e-8, 1e-8, 1e-8})}})),
              {"c.xml:31: ", "same reading"}));
}

// A second table is refused unless the name or the type selects one of the results.
TEST(CertifiedProbe, SelectsAResultByNameOrType) {
  DccCertificate c = certificate(
      {}, {{measured(kMetre, {4e-6, 9e-6}), error(kMetre, {0.2e-6, 0.5e-6}, {1e-8, 2e-8})}});
  c.results.push_back(c.results[0]);
  c.results[1].name = "as left";
  c.results[1].ref_types = {"x_more", "basic_asLeft"};
  c.results[1].lists[0][0].line = 131;
  c.results[1].lists[0][1].value = {0.3e-6, 0.35e-6};
  c.results[1].quantities = {sensitivity()};
  const Rig rig = rig_of(40, 4);
  EXPECT_TRUE(refused(of_b(rig, c),
                      {"c.xml:131: ", "second table", "line 31", "\"as found\", \"as left\""}));
  for (const char* which : {"as left", "basic_asLeft", "x_more"}) {
    const auto found = of_b(rig, c, which);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->probe.um_per_V) << which;
    EXPECT_TRUE(has(found->taken, {"line=131"})) << which;
  }
  const auto before = of_b(rig, c, "as found");
  ASSERT_TRUE(before) << before.error().message;
  EXPECT_FALSE(before->probe.um_per_V);
  EXPECT_TRUE(has(before->taken, {"line=31"}));
  EXPECT_TRUE(refused(of_b(rig, c, "left"), {"c.xml: ", "\"left\"", "\"as found\", \"as left\""},
                      ErrorCode::usage));
  c.results.clear();
  EXPECT_TRUE(refused(of_b(rig, c, "left"), {"c.xml: ", "none"}, ErrorCode::usage));
  EXPECT_TRUE(refused(of_b(rig, c), {"c.xml: ", "neither a sensitivity"}));
}

// Quantities with another unit, without a second column, or without a list are ignored.
TEST(CertifiedProbe, IgnoresUnrelatedQuantities) {
  std::vector<DccQuantity> others;
  for (const SiUnit unit :
       {SiUnit{1, 0, 0}, {1, 1, 1}, {1, -1, -1}, {1, -1, 0}, {1, 0, -1}, {1, -1, 2}, {1, 2, -1}})
    others.push_back(
        quantity({"basic_measuredValue", "basic_measurementError"}, unit, {3, 4}, {}, 9));
  const DccQuantity r = measured(kMetre, {4e-6, 9e-6}),
                    e = error(kMetre, {1e-7, 3e-7}, {1e-8, 2e-8});
  const Rig rig = rig_of(40, 0);
  others.push_back(e);
  EXPECT_TRUE(
      refused(of_b(rig, certificate({r, e}, {{r}, others})), {"c.xml: ", "neither a sensitivity"}));
  others.push_back(r);
  EXPECT_TRUE(of_b(rig, certificate({}, {others})));
}

}  // namespace
}  // namespace mdof::algo::certificates
