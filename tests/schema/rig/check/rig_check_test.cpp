// Rigs with a wrong unit in one key. The error must contain the line of this key. Correct rigs,
// also small ones, must be accepted.
#include "schema/rig/check/rig_check.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

#include <string>

namespace mdof {
namespace {

const std::string kRig = R"(name = "r"
axis = "X"

[[probe]]
id = "A"
position_mm = [10, 0, 0]
measures = "+Z"
range_um = 200

[[probe]]
id = "B"
position_mm = [0, 10, 0]
measures = "+Z"
range_um = 200
)";

std::string with(const std::string& from, const std::string& to, std::string text = kRig) {
  const std::size_t at = text.rfind(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_refused(const std::string& text, const std::vector<std::string>& words) {
  const Result<Rig> rig = parse_rig(text, "r.toml");
  ASSERT_FALSE(rig) << words[0];
  EXPECT_EQ(rig.error().code, ErrorCode::bad_input);
  for (const std::string& word : words)
    EXPECT_NE(rig.error().message.find(word), std::string::npos)
        << rig.error().message << "\nlacks: " << word;
}

void expect_warned(const std::string& text, const std::vector<std::string>& words) {
  const Result<Rig> rig = parse_rig(text, "r.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  const Notices found = unusual_values(*rig);
  ASSERT_EQ(found.size(), 1u) << words[0];
  const std::string finding = test::shown(found);
  for (const std::string& word : words)
    EXPECT_NE(finding.find(word), std::string::npos) << finding << "\nlacks: " << word;
}

void expect_right(const std::string& text) {
  const Result<Rig> rig = parse_rig(text, "r.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(test::shown(unusual_values(*rig)), "");
}

// The rig has too many probes, and two of them are equal. The number of probes must be checked
// first.
TEST(RigCheck, RejectsMoreThanAThousandProbes) {
  std::string text = kRig;
  for (int i = 0; i < 999; ++i)
    text +=
        "\n[[probe]]\nid = \"A\"\nposition_mm = [10, 0, 0]\nmeasures = \"+Z\"\nrange_um = 200\n";
  expect_refused(text, {"the rig has 1001 probes, but at most 1000"});
}

TEST(RigCheck, AcceptsCorrectRigs) {
  expect_right(kRig);
  expect_right(
      with("[10, 0, 0]", "[1.5, 0, 0]", with("[0, 10, 0]", "[0, 1.5, 0]")));  // this rig is small
  expect_right(with("[10, 0, 0]", "[200, 0, 0]", with("[0, 10, 0]", "[0, 200, 100]")));
  for (const char* range : {"range_um = 10", "range_um = 50", "range_um = 12700"})
    expect_right(with("range_um = 200", range));
  expect_right(kRig + "um_per_V = 10\n");
  expect_right(kRig + "um_per_V = -20\n");
  expect_right(kRig + "reads = \"gap\"\noffset_um = 150\n");
  expect_right(kRig + "linearity = [[-100, 0.2], [100, -3]]\n");
  expect_right("artefact_angle_error_urad = -24.5\n" + kRig);
  expect_right(kRig +
               "[[plane]]\nnormal = \"+Z\"\noffset_mm = -15\nflatness_first_mm = [0, 9]\n"
               "flatness_second_mm = [0, 9]\nflatness_um = [[0, 1], [2, 0.5]]\n");
}

TEST(RigCheck, ReportsPositionsInOtherUnits) {
  // 12000 mm, if 12 mm was written in um; 10 mm, if it was written in m
  expect_refused(with("[10, 0, 0]", "[12000, 0, 0]"),
                 {"r.toml:6: ", "position_mm", "\"A\"", "1.2e+04 mm", "mm, not um"});
  expect_refused(with("[0, 10, 0]", "[0, -501, 0]"), {"r.toml:12: ", "position_mm", "\"B\""});
  expect_refused(with("[10, 0, 0]", "[-300, 0, 0]", with("[0, 10, 0]", "[300, 10, 0]")),
                 {"r.toml:12: ", "position_mm", "600", "\"A\" and \"B\"", "mm, not um"});
  expect_refused(with("[10, 0, 0]", "[0.01, 0, 0]", with("[0, 10, 0]", "[0, 0.01, 0]")),
                 {"position_mm", "mm, not m"});
  expect_warned(with("[10, 0, 0]", "[0.5, 0, 0]", with("[0, 10, 0]", "[0, 0.5, 0]")),
                {"position_mm", "0.7071"});
}

TEST(RigCheck, ReportsRangesInOtherUnits) {
  for (const char* range : {"0.2", "2e5", "2e6", "200e3", "2e-4"})
    expect_refused(with("range_um = 200", "range_um = " + std::string(range)),
                   {"r.toml:14: ", "range_um", "\"B\"", "um, not mm or nm"});
  expect_warned(with("range_um = 200", "range_um = 2"), {"r.toml:14: ", "range_um"});
  expect_warned(with("range_um = 200", "range_um = 50e3"), {"r.toml:14: ", "range_um"});
}

TEST(RigCheck, AmplifierDelayIsInMicroseconds) {
  const Result<Rig> rig = parse_rig(kRig + "delay_us = 8000\n", "r.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->probes[0].delay_s, 0);
  EXPECT_EQ(rig->probes[1].delay_s, 0.008);
  for (const char* wrong : {"-1", "10_000_001", "nan"})
    expect_refused(kRig + "delay_us = " + wrong + "\n", {"r.toml:15: ", "delay_us"});
}

TEST(RigCheck, ReportsCalibrationsInOtherUnits) {
  expect_refused(kRig + "um_per_V = 0.01\n", {"r.toml:15: ", "um_per_V", "2e+04 V"});
  expect_refused(kRig + "um_per_V = 1e6\n", {"r.toml:15: ", "um_per_V"});
  expect_warned(kRig + "um_per_V = 0.5\n", {"r.toml:15: ", "um_per_V", "400 V"});
  expect_refused(kRig + "offset_um = 5e5\n", {"r.toml:15: ", "offset_um"});
  expect_warned(kRig + "offset_um = 150\n", {"r.toml:15: ", "offset_um", "-100 to 100"});
  expect_warned(kRig + "reads = \"gap\"\noffset_um = -10\n", {"r.toml:16: ", "0 to 200"});
  expect_refused(kRig + "linearity = [[-100, 300], [100, -10]]\n", {"r.toml:15: ", "linearity"});
  expect_warned(kRig + "linearity = [[-100, 30], [100, -10]]\n", {"r.toml:15: ", "linearity"});
}

TEST(RigCheck, ReportsAPolynomialOfTheWholeDisplacement) {
  expect_right(kRig + "polynomial_um = [0.1, 0.0002]\n");
  for (const char* text : {"[0, 1.0002]", "[0, -2]", "[0, 0, 0.1]"})
    expect_warned(kRig + "polynomial_um = " + text + "\n", {"r.toml:15: ", "polynomial_um"});
}

// A gap probe reads 0 when the gap is closed. At the nominal surface it reads offset_um, so the gap
// there is offset_um. Only a reading that can be negative is a gap minus a constant.
TEST(RigCheck, ReportsAStandoffThatIsNotTheGapReading) {
  const std::string gap = kRig + "reads = \"gap\"\n";
  expect_right(gap + "offset_um = 100\n");
  expect_right(gap + "offset_um = 100\nstandoff_um = 100\n");
  expect_right(gap + "offset_um = 103\nstandoff_um = 100\n");  // a calibration has moved the zero
  expect_warned(gap + "offset_um = 100\nstandoff_um = 250\n",
                {"r.toml:17: ", "standoff_um", "250 um", "offset_um = 100",
                 "touch the target at the reading -150"});
  expect_refused(gap + "offset_um = 100\nstandoff_um = 5\n",
                 {"r.toml:17: ", "standoff_um", "touch the target at the reading 95"});
  expect_right(gap + "valid_um = [-100, 100]\nstandoff_um = 250\n");
  expect_refused(gap + "valid_um = [-100, 100]\nstandoff_um = 80\n",
                 {"touch the target at the reading -80"});
}

TEST(RigCheck, LimitsPointsAndValidReadings) {
  expect_right("tool_point_mm = [0, 0, -2000]\n" + kRig);
  for (const char* point : {"[0, 2001, 0]", "[0, 0, -1e300]"})
    expect_refused("tool_point_mm = " + std::string(point) + "\n" + kRig,
                   {"r.toml:1: tool_point_mm", "from -2000 to 2000"});
  const auto scan = [](const std::string& position, const std::string& centre) {
    return kRig + "[scan]\nprobe = \"F\"\nmeasures = \"+Z\"\nposition_mm = " + position +
           "\ncentre_mm = " + centre + "\n";
  };
  expect_right(scan("[4, 30, 5]", "12.5"));
  expect_refused(scan("[4e4, 30, 5]", "12.5"), {"scan.position_mm", "not 40000"});
  expect_refused(scan("[4, 30, 5]", "1e300"), {"scan.centre_mm", "from -10000 to 10000"});
  expect_refused(kRig + "valid_um = [-95, 1e300]\n", {"r.toml:15: ", "valid_um", "1e+05 um"});
  expect_refused(kRig + "[encoder]\num_per_V = 1e300\n", {"um_per_V", "from 0.001 to 10000000"});
  expect_refused(kRig + "[encoder]\num_per_V = -1e-9\n", {"um_per_V", "not -1e-09"});
}

TEST(RigCheck, RejectsTwoPlanesOfOneName) {
  const std::string plane = "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n";
  expect_right(kRig + plane);
  expect_refused(kRig + plane + plane, {"two planes are called \"top\""});
  expect_right(kRig + "[[plane]]\nnormal = \"+Z\"\n[[plane]]\nnormal = \"+Y\"\n");  // without names
}

TEST(RigCheck, ReportsTargetsInOtherUnits) {
  expect_refused("artefact_angle_error_urad = 1.5708e6\n" + kRig,
                 {"r.toml:1: ", "artefact_angle_error_urad", "90 degrees"});
  expect_warned("artefact_angle_error_urad = 2e4\n" + kRig, {"artefact_angle_error_urad"});
  expect_refused(kRig + "[[plane]]\nnormal = \"+Z\"\noffset_mm = 15000\n",
                 {"r.toml:17: ", "offset_mm"});
  const std::string map = kRig +
                          "[[plane]]\nnormal = \"+Z\"\nflatness_first_mm = [0, 9]\n"
                          "flatness_second_mm = [0, 9]\nflatness_um = [[0, 1], [2, HEIGHT]]\n";
  expect_refused(with("HEIGHT", "5e4", map), {"r.toml:19: ", "flatness_um"});
  expect_warned(with("HEIGHT", "500", map), {"r.toml:19: ", "flatness_um", "not nm"});
}

TEST(RigEncoder, HasAScaleInVoltsOrNone) {
  EXPECT_EQ(parse_rig(kRig, "r.toml")->encoder_um_per_V, std::nullopt);
  EXPECT_EQ(parse_rig(kRig + "[encoder]\num_per_V = -12.5\n", "r.toml")->encoder_um_per_V, -12.5);
  for (const char* value : {"0", "nan", "inf", "-inf", "\"1\""})
    expect_refused(kRig + "[encoder]\num_per_V = " + value + "\n", {"r.toml:16: ", "um_per_V"});
  expect_refused(kRig + "[encoder]\n", {"um_per_V"});
  expect_refused(kRig + "[encoder]\num_per_V = 1\num_per_v = 1\n", {"r.toml:17: ", "um_per_v"});
}

}  // namespace
}  // namespace mdof
