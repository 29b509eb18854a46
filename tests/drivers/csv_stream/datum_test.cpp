// A position that a user has set must become invalid when the script starts again.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "drivers/csv_stream/csv_stream.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/csv_stream/csv_stream_options.h"

namespace mdof::drivers {
namespace {

CsvStream counting(const std::string& then, bool absolute = false) {
  CsvStreamOptions options = options_for_test();
  options.command = {"sh", "-c", "printf 'encoder_mm,A_um\\n0,1\\n'; " + then};
  options.absolute = absolute;
  return {"script", options};
}

// Returns the quality of the encoder in the next scan. The quality of the probe must be good.
Quality encoder_of_next(CsvStream& stream) {
  const Collected one = collect(stream, 1);
  EXPECT_EQ(one.quality.at(0).at(1), Quality::good) << one.error;
  return one.first_quality(0);
}

TEST(CsvStreamDatum, SetPositionIsLostAtANewStart) {
  CsvStream stream = counting("sleep 60");
  // No user has set a position, so the positions of the script are valid.
  for (int start = 0; start < 2; ++start) {
    ASSERT_TRUE(stream.open());
    EXPECT_EQ(encoder_of_next(stream), Quality::good);
    EXPECT_EQ(stream.info().datum_lost, "");
  }
  stream.trust_count();
  EXPECT_EQ(stream.info().datum_lost, "");
  for (int start = 0; start < 2; ++start) {
    ASSERT_TRUE(stream.open());
    EXPECT_EQ(encoder_of_next(stream), Quality::suspect);
    EXPECT_NE(stream.info().datum_lost.find("absolute = true"), std::string::npos);
  }
  stream.trust_count();
  EXPECT_EQ(stream.info().datum_lost, "");
}

TEST(CsvStreamDatum, AbsolutePositionIsKept) {
  CsvStream stream = counting("sleep 60", true);
  ASSERT_TRUE(stream.open());
  stream.trust_count();
  ASSERT_TRUE(stream.open());
  EXPECT_EQ(encoder_of_next(stream), Quality::good);
  EXPECT_EQ(stream.info().datum_lost, "");
}

// A board may be reset without closing the line. It then sends its header again.
TEST(CsvStreamDatum, RepeatedHeaderIsANewStart) {
  const auto go = std::filesystem::temp_directory_path() /
                  ("mdof_csv_stream_datum_test." + std::to_string(::getpid()));
  CsvStream stream =
      counting("until [ -e " + go.string() +
               " ]; do sleep 0.01; done; printf 'encoder_mm,A_um\\n0,1\\n'; sleep 60");
  ASSERT_TRUE(stream.open());
  EXPECT_EQ(encoder_of_next(stream), Quality::good);
  stream.trust_count();
  std::ofstream(go) << "go";
  EXPECT_EQ(encoder_of_next(stream), Quality::suspect);
  EXPECT_NE(stream.info().datum_lost, "");
  stream.trust_count();
  EXPECT_EQ(stream.info().datum_lost, "");
  std::filesystem::remove(go);
}

}  // namespace
}  // namespace mdof::drivers
