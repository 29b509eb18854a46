// Reads height maps from CSV and from files of instruments. Texts that are not a height map are
// rejected.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "schema/form/map_text.h"
#include "schema/form/surface_files.h"

namespace mdof {
namespace {

Result<SurfaceMap> read(const std::string& text, std::optional<XyzUnits> units = {},
                        std::size_t piece = 7) {
  MapTextReader reader("map.csv", units);
  for (std::size_t at = 0; at < text.size(); at += piece)
    MDOF_CHECK(reader.feed(std::string_view(text).substr(at, piece)));
  return reader.finish();
}

std::string error_of(const std::string& text, std::optional<XyzUnits> units = {}) {
  const auto map = read(text, units);
  return map ? "" : map.error().message;
}

TEST(HeightMapCsv, AcceptsRowsInAnyOrderWithHoles) {
  const auto map = read(
      "# made by hand\n"
      "z_um,other,x_mm,y_mm\r\n"
      "4,a,2,10\n"
      "\n"
      "1,b,0,10\n"
      ",c,1,10.5\n"
      "nan,c,0,10.5\n"
      "-2.5,d,3,10.5");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->nx, 4u);
  EXPECT_EQ(map->ny, 2u);
  EXPECT_DOUBLE_EQ(map->x_m(3), 3e-3);
  EXPECT_DOUBLE_EQ(map->y_m(1), 10.5e-3);
  EXPECT_EQ(map->at(2, 0), 4e-6);
  EXPECT_EQ(map->at(0, 0), 1e-6);
  EXPECT_EQ(map->at(3, 1), -2.5e-6);
  EXPECT_EQ(map->measured(), 3u);
}

// No point may be lost if the expected size is wrong, or if later rows of the file have another
// length.
TEST(HeightMapCsv, FileSizeIsOnlyAHint) {
  std::string text = "x_mm,y_mm,z_um\n";
  for (int i = 0; i < 1000; ++i)
    text += std::to_string(i) + ",0,1\n" + std::to_string(i) + ",1,2\n";
  for (const std::size_t bytes : {std::size_t{1}, text.size(), 100 * text.size()}) {
    MapTextReader reader("map.csv", {});
    reader.expect_bytes(bytes);
    for (std::size_t at = 0; at < text.size(); at += 4096)
      ASSERT_TRUE(reader.feed(std::string_view(text).substr(at, 4096)));
    const auto map = reader.finish();
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->measured(), 2000u);
    EXPECT_EQ(map->at(999, 1), 2e-6);
  }
}

// The pitch is 2/3 mm and the positions have three decimals. 299 columns in the middle are
// missing.
TEST(HeightMapCsv, AcceptsRoundedPositions) {
  std::string text = "x_mm,y_mm,z_um\n";
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 450; ++i) {
      if (i > 50 && i < 350) continue;
      char line[64];
      std::snprintf(line, sizeof line, "%.3f,%.3f,%d\n", i * 2. / 3, j * 2. / 3, i + 1000 * j);
      text += line;
    }
  const auto map = read(text);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->nx, 450u);
  EXPECT_NEAR(map->dx_m, 2e-3 / 3, 1e-8);
  EXPECT_NEAR(map->at(449, 2), 2449e-6, 1e-12);
  EXPECT_TRUE(std::isnan(map->at(200, 1)));
}

TEST(HeightMapCsv, ErrorsNameTheLine) {
  const std::string head = "x_mm,y_mm,z_um\n";
  const std::pair<std::string, const char*> bad[] = {
      {"", "is empty"},
      {head, "has no points"},
      {"x_inch,y_inch,z_um\n0,0,1\n", "map.csv:1: column x_inch"},
      {"x_mm,y_mm,z_nm\n0,0,1\n", "map.csv:1: column z_nm"},
      {"x_mm,y_mm\n0,0\n", "no column z_um"},
      {head + "0,0,1\n1,0\n", "map.csv:3: the line has 2 columns"},
      {head + "0,0,1\n1,0,one\n", "map.csv:3: column 3 is \"one\""},
      {head + "0,0,1\n1,0,inf\n", "not a finite number"},
      {head + "0,0,1\n,0,1\n", "map.csv:3: the line has no position"},
      {head + "0,0,1\n1,0,2\n# again\n0,0,3\n", "map.csv:5: the file contains a second height"},
      {head + "0,0,1\n0,0,1\n", "same position"},
      {head + "0,0,nan\n1,0,\n", "no pixel has a height"},
      {head + "0,0,1\n1,0,1e308\n", "map.csv:3: 1e+302 m is too large"},
      {head + "0,0,1\n-2e6,0,1\n", "map.csv:3: -2000 m is too large"},
      {head + "0,0,1\n1,0,2\n2.3,0,2\n3,0,1\n4,0,1\n", "grid"}};
  for (const auto& [text, message] : bad)
    EXPECT_NE(error_of(text).find(message), std::string::npos) << text << "\n" << error_of(text);
  std::string scattered = head;
  for (int i = 0; i < 5000; ++i)
    scattered += std::to_string(std::sin(i) * 100) + "," + std::to_string(std::cos(3 * i)) + ",1\n";
  EXPECT_NE(error_of(scattered).find("grid"), std::string::npos) << error_of(scattered);
}

TEST(HeightMapCsv, AcceptsDecimalCommas) {
  for (const std::string text :
       {"x_mm;y_mm;z_um\n0,5;0;1,25\n1,5;0;\n0,5;2;-3\n",
        "x_mm\ty_mm\tz_um\r\n0,5\t0\t1,25\r\n1,5\t0\t\r\n0,5\t2\t-3\r\n",
        "0,5;0;1,25\n1,5;0;nan\n0,5;2;-3\n", "0,5 0 1,25\n1,5 0 nan\n0,5 2 -3\n",
        "0.5, 0, 1.25\n1.5, 0, nan\n0.5 ,2 ,-3\n"}) {
    const auto map = read(text);
    ASSERT_TRUE(map) << text << map.error().message;
    EXPECT_EQ(map->x_m(1), 1.5e-3) << text;
    EXPECT_EQ(map->at(0, 0), 1.25e-6) << text;
    EXPECT_TRUE(std::isnan(map->at(1, 0))) << text;
    EXPECT_EQ(map->at(0, 1), -3e-6) << text;
  }
  for (const char* text : {"x_mm;y_mm;z_um\n0,5;0;1.25\n1,5;0;2\n", "0 0 1.5\n1 0 1,5\n"})
    EXPECT_NE(error_of(text).find("decimal commas and numbers with decimal points"),
              std::string::npos)
        << error_of(text);
  EXPECT_NE(error_of("x_mm;y_mm;z_um\n0;0;1.250,5\n").find("column 3"), std::string::npos);
  EXPECT_NE(error_of("0,5,0,1,25\n").find("the line has 5 numbers"), std::string::npos);
}

TEST(HeightMapXyz, AcceptsUnitsAndBlanks) {
  const std::string text = " 0 0 1\n\t1  0 2\n+1.0e0 1 nan\n";
  const auto as_csv = read(text);
  ASSERT_TRUE(as_csv) << as_csv.error().message;
  EXPECT_EQ(as_csv->at(1, 0), 2e-6);
  EXPECT_EQ(as_csv->x_m(1), 1e-3);
  ASSERT_EQ(as_csv->notices.size(), 1u);
  const auto in_m = read(text, *xyz_units("m"));
  EXPECT_EQ(in_m->at(1, 0), 2);
  EXPECT_EQ(in_m->x_m(1), 1);
  EXPECT_TRUE(in_m->notices.empty());
  const auto both = read(text, *xyz_units("um,nm"));
  EXPECT_EQ(both->x_m(1), 1e-6);
  EXPECT_EQ(both->at(1, 0), 2e-9);
  EXPECT_FALSE(xyz_units("inch"));
  EXPECT_FALSE(xyz_units("mm,"));
  EXPECT_NE(error_of("0 0 1\n1 0 2 3\n").find("map.csv:2: the line has 4 numbers"),
            std::string::npos);
}

TEST(HeightMapCsv, IsReadAsItWasWritten) {
  SurfaceMap map{"m", -0.1475, 0.01, 0.66e-3, 0.5e-3, 3, 2, {}, {}};
  map.z_m = {1e-6, SurfaceMap::kMissing, 0.123456789e-6, -3e-9, 0, 2e-3};
  std::string text;
  ASSERT_TRUE(write_map_csv(map, [&](std::string_view piece) {
    text += piece;
    return Status();
  }));
  const auto again = read(text);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->nx, 3u);
  EXPECT_NEAR(again->x0_m, map.x0_m, 1e-15);
  EXPECT_NEAR(again->dx_m, map.dx_m, 1e-15);
  for (std::size_t k = 0; k < 6; ++k)
    if (std::isnan(map.z_m[k]))
      EXPECT_TRUE(std::isnan(again->z_m[k]));
    else
      EXPECT_NEAR(again->z_m[k], map.z_m[k], 1e-17);
}

std::string data(const std::string& name) {
  std::ifstream file(std::string(MDOF_TEST_DATA) + "/form/" + name, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The example of the standard has 7 x 4 points with a pitch of 1 um.
TEST(Sdf, ReadsTheExampleOfTheStandard) {
  const std::string text = data("sdf-1.sdf");
  ASSERT_TRUE(is_sdf(text));
  const auto map = parse_sdf(text, "sdf-1.sdf");
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->nx, 7u);
  EXPECT_EQ(map->ny, 4u);
  EXPECT_DOUBLE_EQ(map->dx_m * 7, 7e-6);
  EXPECT_DOUBLE_EQ(map->dy_m * 4, 4e-6);
  EXPECT_EQ(map->x0_m, 0);
  EXPECT_NEAR(map->at(0, 0), 1e-6, 1e-18);
  EXPECT_NEAR(map->at(5, 0), 0.96858e-6, 1e-18);
  EXPECT_NEAR(map->at(0, 3), 0.97986e-6, 1e-18);
}

TEST(Sdf, ReadsBadPointsAndOtherDialects) {
  const std::string header =
      "NumPoints = 3\r\nNumProfiles = 2 ; rows\r\nXscale = 2e-6\r\nYscale=4e-6\r\n"
      "Zscale = 1.0E-9\r\nZresolution = -1\r\nCompression = 0\r\nDataType = 3\r\nCheckType = 0\r\n";
  for (const char* magic : {"aISO-1.0", "aISO-2.0", "aBCR-1.0"}) {
    const auto map = parse_sdf(
        std::string(magic) + "\r\n" + header + "*\r\n1 BAD 3\r\n4 5\r\n -6e0\r\n*\r\n", "s");
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_TRUE(std::isnan(map->at(1, 0)));
    EXPECT_NEAR(map->at(2, 1), -6e-9, 1e-20);
    EXPECT_DOUBLE_EQ(map->y_m(1), 4e-6);  // y increases with the number of the profile
    EXPECT_DOUBLE_EQ(map->x_m(2), 4e-6);
  }
  const auto error = [&](const std::string& text) {
    const auto map = parse_sdf(text, "s.sdf");
    return map ? std::string() : map.error().message;
  };
  EXPECT_NE(error("bISO-1.0 ...").find("export the map as text"), std::string::npos);
  EXPECT_NE(error("aISO-1.0\n" + header).find("within the header"), std::string::npos);
  EXPECT_NE(error("aISO-1.0\n" + header + "*\n1 2 3 4 5\n").find("has 5 heights"),
            std::string::npos);
  EXPECT_NE(error("aISO-1.0\n" + header + "*\n1 2 3 4 5 6 7\n").find("more heights"),
            std::string::npos);
  EXPECT_NE(error("aISO-1.0\n" + header + "*\n1 2 x 4 5 6\n").find("s.sdf:12: \"x\""),
            std::string::npos);
  EXPECT_NE(
      error("aISO-1.0\n" + header + "*\n1 2 3 4 5 1e12\n").find("s.sdf:12: 1e12 times Zscale"),
      std::string::npos);
  EXPECT_NE(error("aISO-1.0\nNumPoints = 1\nNumProfiles = 1\nXscale = 0.66\n*\n1\n")
                .find("s.sdf:4: Xscale = 0.66 m is too large"),
            std::string::npos);
  EXPECT_NE(error("aISO-1.0\nNumPoints = 0\n*\n1\n").find("s.sdf:2: NumPoints"), std::string::npos);
  EXPECT_NE(error("aISO-1.0\nNumPoints = 9\n*\n1\n").find("no NumProfiles"), std::string::npos);
}

// A MetroPro file with 2 x 2 pixels.
std::string zygo(int phase_res, int sign, const std::vector<std::int32_t>& phase) {
  std::string bytes(834 + 6, '\0');
  const auto put = [&](std::size_t at, std::uint32_t value, int size) {
    for (int k = 0; k < size; ++k)
      bytes[at + static_cast<std::size_t>(k)] = static_cast<char>(value >> 8 * (size - 1 - k));
  };
  const auto real = [&](std::size_t at, float x) { put(at, std::bit_cast<std::uint32_t>(x), 4); };
  put(0, 0x881b036f, 4);
  put(4, 1, 2);
  put(6, 834, 4);
  put(60, 6, 4);  // size of the intensities in bytes
  put(64, 10, 2);
  put(66, 20, 2);
  put(68, 2, 2);
  put(70, static_cast<std::uint32_t>(phase.size() / 2), 2);
  real(164, 0.5f);
  real(168, 512e-9f);
  real(176, 1);
  real(184, 1e-3f);
  put(218, static_cast<std::uint32_t>(phase_res), 2);
  put(232, static_cast<std::uint32_t>(sign), 2);
  for (const std::int32_t p : phase) {
    bytes.append(4, '\0');
    put(bytes.size() - 4, static_cast<std::uint32_t>(p), 4);
  }
  return bytes;
}

TEST(ZygoDat, ConvertsPhaseToHeights) {
  const double counts[] = {4096, 32768, 131072};
  for (int res = 0; res < 3; ++res) {
    const std::string bytes = zygo(res, 0, {1000, -2000, 2147483640, 0});
    ASSERT_TRUE(is_zygo_dat(bytes));
    const auto map = parse_zygo_dat(bytes, "z");
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_NEAR(map->at(0, 1), 1000 * 0.5 * 512e-9 / counts[res], 1e-14);
    EXPECT_NEAR(map->at(1, 1), -2000 * 0.5 * 512e-9 / counts[res], 1e-14);
    EXPECT_TRUE(std::isnan(map->at(0, 0)));
    EXPECT_NEAR(map->x0_m, 10e-3, 1e-9);
    EXPECT_NEAR(map->y_m(1), -20e-3, 1e-9);
    EXPECT_NEAR(map->y_m(0), -21e-3, 1e-9);
  }
  EXPECT_NEAR(parse_zygo_dat(zygo(1, 1, {1000, 0}), "z")->at(0, 0), -1000 * 256e-9 / 32768, 1e-15);
  std::string in_um = zygo(1, 0, {1, 2});  // 1.0f as the lateral resolution
  in_um[184] = 0x3f;
  in_um[185] = static_cast<char>(0x80);
  in_um[186] = in_um[187] = 0;
  EXPECT_NE(parse_zygo_dat(in_um, "z").error().message.find("lateral resolution is 1 m"),
            std::string::npos);
  EXPECT_FALSE(parse_zygo_dat(zygo(3, 0, {1, 2}), "z"));
  EXPECT_FALSE(parse_zygo_dat(zygo(1, 0, {}), "z"));
  const std::string whole = zygo(1, 0, {1, 2, 3, 4});
  for (std::size_t size = 4; size < whole.size(); ++size)
    EXPECT_FALSE(parse_zygo_dat(std::string_view(whole).substr(0, size), "z")) << size;
}

// The rows of the file begin at the top left of the image (MetroPro Reference Guide, "Data Format
// and Conversion"; LoadMetroProData.m of LIGO reverses them for an axis y that points up). The
// image has the pixels
//   1 2
//   3 4
//   5 6
TEST(ZygoDat, TheFirstRowIsTheTopOfTheImage) {
  const auto map = parse_zygo_dat(zygo(0, 0, {1, 2, 3, 4, 5, 6}), "z");
  ASSERT_TRUE(map) << map.error().message;
  const double expected[3][2] = {{5, 6}, {3, 4}, {1, 2}};  // y increases with the row
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(map->at(i, j), expected[j][i] * 256e-9 / 4096, 1e-16) << i << " " << j;
  EXPECT_GT(map->dy_m, 0);
}

// The rows 20 to 22 of the camera, counted from the top.
TEST(ZygoDat, TheLowestRowOfTheCameraIsAtZero) {
  std::string bytes = zygo(0, 0, {1, 2, 3, 4, 5, 6});
  EXPECT_NEAR(parse_zygo_dat(bytes, "z")->y0_m, -22e-3, 1e-8);  // the height is not stated
  bytes[237] = 100;
  EXPECT_NEAR(parse_zygo_dat(bytes, "z")->y0_m, (99 - 22) * 1e-3, 1e-8);
  bytes[237] = 0;
  bytes[67] = 0;  // the file begins with the top row of the camera
  EXPECT_EQ(parse_zygo_dat(bytes, "z")->y0_m, 0);
}

}  // namespace
}  // namespace mdof
