// Rigs that use calibration records.
#include "schema/rig/calibrated.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "schema/calibration/certificate_facts.h"
#include "schema/rig/effects/physics.h"
#include "tests/algo/rigs.h"
#include "tests/shown.h"

namespace mdof {
namespace {

CalibrationRecord mounting() {
  CalibrationRecord record;
  record.kind = "mounting";
  record.rig = "test";
  record.date = "2026-11-02";
  record.valid_until = "2027-11-02";
  record.not_seen = {"the direction of \"A\""};
  record.sources = {{"x.csv", "aa"}, {"y.csv", "bb"}};
  record.u_together_m = Vec3{1e-5, 2e-5, 3e-5};
  for (const char* id : {"A", "B", "C", "D", "E"}) {
    CalibratedProbe probe;
    probe.id = id;
    record.probes.push_back(probe);
  }
  record.probes[1].position_m = Vec3{1.0 / 3e4, 0.01, 0};
  record.probes[1].u_position_m = {1e-6, 2e-6, 0};
  record.probes[1].offset_um = 2.5;
  record.probes[1].u_offset_m = 1e-8;
  record.probes[1].u_sensitivity_1 = 3e-4;
  record.probes[1].sensitivity_freedom = 7;
  record.covariance = {{"B.x", "B.y", "B.zero"},
                       {{1e-12, 3e-13, -5e-15}, {3e-13, 4e-12, 0}, {-5e-15, 0, 1e-16}}};
  return record;
}

std::string rig_text(const std::string& of_B = "", const std::string& last = "") {
  std::string text = "calibration = \"m.toml\"\n" + test::rig_x_toml();
  text.insert(text.find('\n', text.find("id = \"B\"")) + 1, of_B);
  return text + last;
}

std::string record_part() {
  const std::string text = record_text(mounting());
  return text.substr(text.find(kRecordHead));
}

Rig with_record(const std::string& of_B = "", const std::string& last = "") {
  const auto rig = parse_rig(rig_text(of_B, last) + record_part(), "rig.toml");
  EXPECT_TRUE(rig) << rig.error().message;
  return rig.value_or(Rig());
}

TEST(CalibratedRig, UsesTheRecordAndKeepsAllOtherValues) {
  const Rig plain = test::rig_x(), rig = with_record();
  EXPECT_EQ(rig.probes[0].position_m, plain.probes[0].position_m);
  EXPECT_NEAR(rig.probes[1].position_m[0], 1.0 / 3e4, 1e-19) << "to the last bits";
  EXPECT_EQ(rig.probes[1].direction, plain.probes[1].direction);
  EXPECT_FALSE(rig.probes[1].nominal_direction);
  EXPECT_EQ(rig.probes[1].calibration.offset_um, 2.5);
  EXPECT_NEAR(rig.probes[1].uncertainty.calibration.u, 1e-8, 1e-20);
  EXPECT_NEAR(rig.uncertainty.installation_offset.u[1], 2e-5, 1e-18);
  ASSERT_EQ(rig.records.size(), 1U);
  EXPECT_EQ(rig.records[0].not_seen, mounting().not_seen);
  EXPECT_EQ(rig.records[0].sources[1].file, "y.csv");
  const Notices notices = calibration_notices(std::string_view(rig.text));
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(notices[0].code, NoticeCode::positions_calibrated);
  EXPECT_EQ(notices[0].severity, Severity::information);
  EXPECT_EQ(notices[0].subject, rig.records[0].id);
  EXPECT_TRUE(calibration_notices("no rig with a [[calibration_record]]").empty());
}

// A record may give another direction of a probe. The rig must keep the nominal direction, because
// the surface of the target is perpendicular to the nominal direction.
TEST(CalibratedRig, KeepsTheNominalDirection) {
  CalibrationRecord record = mounting();
  record.probes[0].direction = Vec3{2e-4, -1e-4, 1};
  const std::string text = record_text(record);
  const auto rig = parse_rig(rig_text() + text.substr(text.find(kRecordHead)), "rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_GT(rig->probes[0].direction[0], 1.9e-4);
  ASSERT_TRUE(rig->probes[0].nominal_direction);
  EXPECT_EQ(*rig->probes[0].nominal_direction, test::rig_x().probes[0].direction);
}

TEST(CalibratedRig, KeepsCovariancesOfRecordedQuantities) {
  const auto covariance = [](const Rig& rig) { return rig.records.at(0).covariance; };
  const auto all = covariance(with_record());
  EXPECT_EQ(all.of, mounting().covariance.of);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(all.m2.at(i).at(j), mounting().covariance.m2[i][j], 1e-27) << i << j;
  EXPECT_EQ(with_record().probes[1].uncertainty.sensitivity.freedom, 7);
  // If the rig declares u of the zero of a probe, this zero is independent of the record and is not
  // in the covariance of the record.
  const auto declared = covariance(with_record("u_calibration_um = 0.5\n"));
  EXPECT_EQ(declared.of, (std::vector<std::string>{"B.x", "B.y"}));
  ASSERT_EQ(declared.m2.size(), 2U);
  EXPECT_EQ(declared.m2[1].size(), 2U);
}

TEST(CalibratedRig, RejectsAnInvalidCovariance) {
  for (const auto& m2 : {std::vector<std::vector<double>>{{1e-12, 2e-12}, {2e-12, 1e-12}},
                         {{1e-12, 0}, {1e-13, 1e-12}},
                         {{1e-12}, {1e-12}}}) {
    CalibrationRecord record = mounting();
    record.covariance = {{"B.x", "B.y"}, m2};
    const std::string text = record_text(record);
    const auto rig = parse_rig(rig_text() + text.substr(text.find(kRecordHead)), "rig.toml");
    ASSERT_FALSE(rig);
    EXPECT_NE(rig.error().message.find("covariance_um2"), std::string::npos) << rig.error().message;
  }
}

TEST(CalibratedRig, RecordReplacesDeclaredUncertaintyOfPositionsOnly) {
  const Rig rig = with_record("u_position_mm = 0.05\nu_calibration_um = 0.5\n",
                              "[installation]\nu_offset_mm = 0.4\n");
  EXPECT_NEAR(rig.probes[1].uncertainty.position.u[1], 2e-6, 1e-18);
  EXPECT_NEAR(rig.probes[1].uncertainty.calibration.u, 0.5e-6, 1e-18) << "declared";
  EXPECT_NEAR(rig.uncertainty.installation_offset.u[1], 0.4e-3, 1e-18) << "declared";
}

// A declared uncertainty of 0 is a declaration and is not replaced.
TEST(CalibratedRig, KeepsADeclaredUncertaintyOfZero) {
  const Rig rig = with_record("u_calibration_um = 0\n", "[installation]\nu_offset_mm = 0\n");
  EXPECT_EQ(rig.probes[1].uncertainty.calibration.u, 0);
  EXPECT_TRUE(rig.probes[1].uncertainty.calibration.known());
  EXPECT_EQ(rig.uncertainty.installation_offset.u, Vec3{});
  EXPECT_TRUE(rig.uncertainty.installation_offset.known());
}

// The correction table states corrections at t = raw - offset, but each correction belongs to a raw
// reading. If a record changes the offset, t of each correction changes too.
TEST(CalibratedRig, LinearityTableIsShiftedWithTheOffset) {
  const Rig table = with_record("offset_um = 1\nlinearity = [[-50, 0.2], [50, -0.1]]\n");
  EXPECT_EQ(table.probes[1].calibration.linearity[0], (std::array<double, 2>{-51.5, 0.2}));
  EXPECT_EQ(table.probes[1].calibration.linearity[1], (std::array<double, 2>{48.5, -0.1}));
  const Rig power = with_record("offset_um = 1\npolynomial_um = [0.5, 0.01, 0.002, -0.0001]\n");
  const auto p = [](const std::vector<double>& c, double t) {
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  };
  for (const double raw : {-40.0, 0.0, 33.0})
    EXPECT_NEAR(p(power.probes[1].calibration.polynomial_um, raw - 2.5),
                p({0.5, 0.01, 0.002, -0.0001}, raw - 1), 1e-12);
}

TEST(CalibratedRig, HasTheCalibratedRangeOfAProbe) {
  CalibrationRecord record = mounting();
  record.probes[0].linearity = {{-50, 0.2}, {50, -0.1}};
  record.probes[0].calibrated_um = {-12.5, 1.0 / 3};
  record.probes[2].linearity = {{-50, 0.2}, {50, -0.1}};  // an older version wrote no calibrated_um
  const auto with = [](const std::string& text) {
    return parse_rig(rig_text() + text.substr(text.find(kRecordHead)), "rig.toml");
  };
  const auto rig = with(record_text(record));
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->probes[0].calibration.calibrated_um, (std::array{-12.5, 1.0 / 3}));
  EXPECT_FALSE(rig->probes[1].calibration.calibrated_um);
  EXPECT_EQ(rig->probes[2].calibration.calibrated_um, (std::array{-50.0, 50.0}));
  record.probes[0].calibrated_um = {1, 1};
  const auto refused = with(record_text(record));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("calibrated_um"), std::string::npos);
}

// The second record changes the offset from 0 to 2.5 um. The calibrated range belongs to raw
// readings, so its limits in t decrease by 2.5 um.
TEST(CalibratedRig, CalibratedRangeIsShiftedWithTheOffset) {
  CalibrationRecord sensitivity = mounting();
  sensitivity.kind = "sensitivity";
  sensitivity.probes = {CalibratedProbe{}};
  sensitivity.probes[0].id = "B";
  sensitivity.probes[0].linearity = {{-50, 0.2}, {50, -0.1}};
  sensitivity.probes[0].calibrated_um = {-20, 30};
  sensitivity.covariance = {};
  const std::string first = record_text(sensitivity), second = record_text(mounting());
  const auto rig =
      parse_rig("calibration = [\"s.toml\", \"m.toml\"]\n" + test::rig_x_toml() +
                    first.substr(first.find(kRecordHead)) + second.substr(second.find(kRecordHead)),
                "rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->probes[1].calibration.calibrated_um, (std::array{-22.5, 27.5}));
}

// A chi-square with a probability below 1e-6 is reported. The limit for 6 degrees of freedom is
// 38.26 (from tables).
TEST(CalibratedRig, ReportsAMountingThatDoesNotFitItsReadings) {
  const auto said = [](double chi_square, std::int64_t freedom) {
    CalibrationRecord record = mounting();
    record.chi_square = chi_square;
    record.freedom = freedom;
    const std::string text = record_text(record);
    const auto rig = parse_rig(rig_text() + text.substr(text.find(kRecordHead)), "rig.toml");
    return rig ? calibration_notices(*rig) : Notices();
  };
  EXPECT_EQ(said(38.2, 6).size(), 1U);
  EXPECT_EQ(said(1e9, 0).size(), 1U) << "nothing was left to test";
  const Notices notices = said(38.3, 6);
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_EQ(notices[1].code, NoticeCode::mounting_not_explained);
  EXPECT_EQ(notices[1].severity, Severity::doubtful);
  EXPECT_EQ(notices[1].subject, notices[0].subject);
  EXPECT_EQ(said(1e300, std::numeric_limits<std::int64_t>::max()).size(), 2U);
}

// A record from a laboratory's certificate. Its linearity table refers to the offset of the
// record.
TEST(CalibratedRig, UsesARecordFromACertificate) {
  CalibrationRecord record;
  record.kind = "sensitivity";
  record.rig = "test";
  record.date = "2026-10-30";
  record.valid_until = "2027-10-30";
  CalibratedProbe b;
  b.id = "B";
  b.offset_um = 2.5;
  b.linearity = {{-50, 0.2}, {50, -0.1}};
  record.probes = {b};
  CertificateFacts facts{"K-4711 \"a\"", "Labor Süd", "17", "2026-10-30", "2027-10-30", 2e-8};
  const auto with = [&](const CertificateFacts& of) {
    const std::string text = record_text(record, of);
    return parse_rig(rig_text("offset_um = 1\nu_linearity_um = 0.5\ndue = \"2020-01-01\"\n") +
                         text.substr(text.find(kRecordHead)),
                     "rig.toml");
  };
  const auto rig = with(facts);
  ASSERT_TRUE(rig) << rig.error().message;
  const Calibration& c = rig->probes[1].calibration;
  EXPECT_EQ(c.certificate, facts.certificate);
  EXPECT_EQ(c.laboratory, facts.laboratory);
  EXPECT_EQ(c.calibrated, facts.calibrated);
  EXPECT_EQ(c.due, facts.due);
  EXPECT_EQ(c.linearity, b.linearity);
  EXPECT_NE(rig->text.find("serial_number = \"17\""), std::string::npos);
  ASSERT_TRUE(rig->physics);
  EXPECT_NEAR(rig->physics->probes[1].u_linearity.u, 2e-8, 1e-20);
  EXPECT_EQ(rig->probes[0].calibration.certificate, "");
  facts.due = "2027";
  const auto refused = with(facts);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("due: must be a date"), std::string::npos)
      << refused.error().message;
  const auto reversed =
      parse_rig(rig_text("calibrated = \"2026-10-30\"\ndue = \"2026-10-29\"\n"), "rig.toml");
  ASSERT_FALSE(reversed);
  EXPECT_NE(reversed.error().message.find("must not be before calibrated"), std::string::npos)
      << reversed.error().message;
}

TEST(CalibratedRig, ReportsAnExpiredRecord) {
  const Rig rig = with_record();
  EXPECT_TRUE(overdue_calibrations(rig, "2027-11-02T23:59:59Z").empty());
  const auto overdue = overdue_calibrations(rig, "2027-11-03T00:00:00Z");
  ASSERT_EQ(overdue.size(), 1U);
  EXPECT_EQ(overdue[0].code, NoticeCode::record_expired);
  EXPECT_NE(test::shown(overdue[0]).find(" kind=mounting"), std::string::npos);
}

TEST(CalibratedRig, RejectsMissingAndChangedRecords) {
  const auto says = [](const std::string& text, const char* what) {
    const auto rig = parse_rig(text, "rig.toml");
    ASSERT_FALSE(rig) << what;
    EXPECT_NE(rig.error().message.find(what), std::string::npos) << rig.error().message;
  };
  says(rig_text(),
       "rig.toml:1: calibration: the rig lists 1 record files, but the text of the rig contains 0");
  says(test::rig_x_toml() + record_part(), "the rig lists 0 record files");
  std::string changed = record_part();
  changed.replace(changed.find("0.01"), 0, "1");
  says(rig_text() + changed.replace(changed.find("u_position_mm = ["), 0, ""), "sha256");
  CalibrationRecord other = mounting();
  other.rig = "other";
  const std::string text = record_text(other);
  says(rig_text() + text.substr(text.find(kRecordHead)), "rig: is \"other\"");
  CalibrationRecord fewer = mounting();
  fewer.probes.pop_back();
  const std::string four = record_text(fewer);
  says(rig_text() + four.substr(four.find(kRecordHead)),
       "the record contains the probes A, B, C, D");
}

TEST(CalibratedRig, LoadsTheNamedRecordFiles) {
  const auto folder = std::filesystem::temp_directory_path() / "mdof_calibrated_rig_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rig.toml") << rig_text();
  std::ofstream(folder / "m.toml") << record_text(mounting());
  const auto text = load_rig_text(folder / "rig.toml");
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_EQ(*text, rig_text() + record_part());
  // If a text already contains its records, the files of the records are not needed.
  std::ofstream(folder / "whole.toml") << *text;
  std::filesystem::remove(folder / "m.toml");
  EXPECT_EQ(load_rig_text(folder / "whole.toml").value_or(""), *text);
  const auto missing = load_rig_text(folder / "rig.toml");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("rig.toml:1: calibration"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(CalibrationRecord, TextIsDividedIntoItsRecords) {
  const std::string one = record_part();
  const std::string both = "name = \"x\"\n" + one + one;
  const auto parts = record_parts(both);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_TRUE(is_unchanged(parts[0]) && is_unchanged(parts[1]));
  EXPECT_FALSE(is_unchanged(one + "\n"));
  EXPECT_FALSE(is_unchanged(kRecordHead));
  EXPECT_TRUE(record_parts("name = 1\n").empty());
}

TEST(CalibratedRig, LimitsNumberAndSizeOfRecords) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("mdof_records_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto loaded = [&](const std::string& names) {
    std::ofstream(folder / "rig.toml") << "calibration = " << names << "\n" << test::rig_x_toml();
    const auto text = load_rig_text(folder / "rig.toml");
    return text ? std::string() : text.error().message;
  };
  std::ofstream(folder / "m.toml") << record_text(mounting());
  EXPECT_EQ(loaded("\"m.toml\""), "");
  std::string names = "[";
  for (int i = 0; i < 17; ++i) names += "\"m.toml\", ";
  EXPECT_NE(loaded(names + "]").find("names 17 calibration records, but a rig can have at most 16"),
            std::string::npos);
  std::ofstream(folder / "large.toml") << record_text(mounting()) << std::string(300'000, '\n');
  EXPECT_NE(loaded("\"large.toml\"").find("larger than 262144 bytes"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
  EXPECT_NE(loaded("\"pipe.toml\"").find("is a pipe or a device"), std::string::npos);
  std::filesystem::remove_all(folder);

  std::string behind = "calibration = [";
  for (int i = 0; i < 17; ++i) behind += "\"m.toml\", ";
  behind += "]\n" + test::rig_x_toml();
  for (int i = 0; i < 17; ++i) behind += record_part();
  const auto many = parse_rig(behind, "rig.toml");
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().message.find("17 calibration records"), std::string::npos);
  const auto large = parse_rig(rig_text() + record_part() + std::string(300'000, '\n'), "rig.toml");
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("at most 262144"), std::string::npos);
}

}  // namespace
}  // namespace mdof
