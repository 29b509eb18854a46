// Rigs with several calibration records.
#include <gtest/gtest.h>

#include <algorithm>

#include "schema/calibration/certificate_facts.h"
#include "schema/rig/calibrated.h"
#include "schema/rig/effects/physics.h"
#include "tests/algo/rigs.h"

namespace mdof {
namespace {

CalibrationRecord mounting(const std::string& date, double offset_um) {
  CalibrationRecord record;
  record.kind = "mounting";
  record.rig = "test";
  record.date = date;
  record.valid_until = "2027-11-02";
  for (const char* id : {"A", "B", "C", "D", "E"}) {
    record.probes.emplace_back();
    record.probes.back().id = id;
  }
  record.probes[1].offset_um = offset_um;
  record.probes[1].u_offset_m = 1e-8;
  return record;
}

std::string part_of(const CalibrationRecord& record, const CertificateFacts& facts = {}) {
  const std::string text = record_text(record, facts);
  return text.substr(text.find(kRecordHead));
}

CalibrationRecord sensitivity_of_B(const std::string& date, double correction_um) {
  CalibrationRecord record;
  record.kind = "sensitivity";
  record.rig = "test";
  record.date = date;
  record.valid_until = "2027-10-30";
  record.probes = {CalibratedProbe{}};
  record.probes[0].id = "B";
  record.probes[0].linearity = {{-50, correction_um}, {50, -correction_um}};
  return record;
}

Result<Rig> with_parts(const std::vector<std::string>& parts) {
  std::string names, text;
  for (const std::string& part : parts) {
    names += "\"r.toml\", ";
    text += part;
  }
  return parse_rig("calibration = [" + names + "]\n" + test::rig_x_toml() + text, "rig.toml");
}

// The mounting moves the zero of B from 0 to 2.5 um; an older mounting moves it to 9 um.
// The correction at the raw reading -50 um stays 0.2 um: its reading t is then -52.5 um.
TEST(CalibratedRig, OrderOfTheRecordsHasNoEffect) {
  std::vector<std::string> parts = {
      part_of(sensitivity_of_B("2026-10-01", 0.7)),
      part_of(sensitivity_of_B("2026-10-30", 0.2), {"K", "L", "", "", "", 2e-8}),
      part_of(mounting("2026-11-01", 9)), part_of(mounting("2026-11-02", 2.5))};
  std::sort(parts.begin(), parts.end());
  int orders = 0;
  do {
    const auto rig = with_parts(parts);
    ASSERT_TRUE(rig) << rig.error().message;
    const Calibration& b = rig->probes[1].calibration;
    EXPECT_EQ(b.offset_um, 2.5);
    EXPECT_EQ(b.linearity[0], (std::array<double, 2>{-52.5, 0.2}));
    ++orders;
  } while (std::next_permutation(parts.begin(), parts.end()));
  EXPECT_EQ(orders, 24);
}

TEST(CalibratedRig, NewestCertificateGivesTheUncertaintyOfTheLinearity) {
  const std::string january =
                        part_of(sensitivity_of_B("2026-01-01", 0.2), {"K-1", "", "", "", "", 9e-8}),
                    may =
                        part_of(sensitivity_of_B("2026-05-01", 0.2), {"K-2", "", "", "", "", 2e-8});
  for (const auto& parts : {std::vector{january, may}, {may, january}}) {
    const auto rig = with_parts(parts);
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_EQ(rig->probes[1].calibration.certificate, "K-2");
    EXPECT_NEAR(rig->physics->probes[1].u_linearity.u, 2e-8, 1e-20);
  }
}

void expect_refused(const Result<Rig>& rig, const std::vector<std::string>& says) {
  ASSERT_FALSE(rig);
  for (const std::string& what : says)
    EXPECT_NE(rig.error().message.find(what), std::string::npos) << rig.error().message;
}

TEST(CalibratedRig, RejectsTwoRecordsOfOneDateWithTheSameValue) {
  const std::string one = part_of(mounting("2026-11-02", 2.5)),
                    other = part_of(mounting("2026-11-02", 9));
  const auto id = [](const std::string& part) { return part.substr(part.find("mounting-"), 28); };
  expect_refused(with_parts({one, other}),
                 {id(one), id(other),
                  "have the same date, 2026-11-02, and both contain offset_um of the probe \"B\"",
                  "keep only one"});
  // Two results of one certificate: the scale and the linearity.
  CalibrationRecord scale = sensitivity_of_B("2026-10-30", 0);
  scale.probes[0].linearity.clear();
  scale.probes[0].um_per_V = 10.1;
  EXPECT_TRUE(with_parts({part_of(scale), part_of(sensitivity_of_B("2026-10-30", 0.2))}));
}

TEST(CalibratedRig, RejectsAMountingThatWasCalibratedWithOtherSensitivities) {
  const std::string used = part_of(sensitivity_of_B("2026-10-01", 0.7)),
                    other = part_of(sensitivity_of_B("2026-10-30", 0.2));
  const auto id = [](const std::string& part) {
    return part.substr(part.find("sensitivity-"), 31);
  };
  CalibrationRecord record = mounting("2026-11-02", 2.5);
  record.sensitivities = {id(used)};
  EXPECT_TRUE(with_parts({part_of(record), used}));
  expect_refused(with_parts({part_of(record), other}),
                 {"calculated with \"" + id(used) +
                  "\", but the key \"calibration\" of the rig names \"" + id(other) + "\""});
  expect_refused(with_parts({part_of(record)}), {"of the rig names no sensitivity record"});
  record.sensitivities = std::vector<std::string>{};
  EXPECT_TRUE(with_parts({part_of(record)}));
  expect_refused(with_parts({used, part_of(record)}), {"calculated with no sensitivity record"});
}

}  // namespace
}  // namespace mdof
