#include "daemon/words/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

namespace mdof {
namespace {

std::set<std::string> fields_of(const std::string& pattern) {
  std::set<std::string> fields;
  for (auto open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', open + 1))
    fields.insert(pattern.substr(open + 1, pattern.find_first_of(":}", open) - open - 1));
  return fields;
}

std::set<std::string> keys_of(NoticeCode code) {
  std::istringstream words{std::string(keys(code))};
  return {std::istream_iterator<std::string>(words), {}};
}

std::vector<NoticeCode> all_codes() {
  std::vector<NoticeCode> codes;
#define NOTICE(code, severity, keys) codes.push_back(NoticeCode::code);
#include "schema/notice/notice_codes.inc"
#undef NOTICE
  return codes;
}

// A sentence shows only what its notice carries, and leaves no number of it out.
TEST(Catalogue, EachCodeHasItsWordsWithItsKeys) {
  for (const NoticeCode code : all_codes()) {
    const std::string pattern = words::pattern(code);
    std::set<std::string> fields = fields_of(pattern);
    fields.erase("subject");
    EXPECT_FALSE(pattern.empty()) << to_string(code);
    EXPECT_EQ(fields, keys_of(code)) << to_string(code);
    EXPECT_EQ(std::count(pattern.begin(), pattern.end(), '{'),
              std::count(pattern.begin(), pattern.end(), '}'))
        << to_string(code);
  }
}

TEST(Catalogue, FieldsAreFilledByTheirFormat) {
  const Notice n = notice(NoticeCode::delays_by_motion, "B",
                          {{"delays_us", ""}, {"unknown", "A, C"}, {"effect_nm", 1234567.891}});
  const auto filled = [&](const char* pattern) { return words::filled(pattern, n); };
  EXPECT_EQ(filled("probe {subject}: {effect_nm}"), "probe B: 1234568");
  EXPECT_EQ(filled("{effect_nm:9}|{effect_nm:+.1f}|{effect_nm:.3g}"),
            "1234567.89|+1234567.9|1.23e+06");
  EXPECT_EQ(filled("{unknown}{unknown:? unknown|}{delays_us:?x|y}"), "A, C unknowny");
  EXPECT_EQ(filled("{other}"), "unknown");
  const Notice one = notice(NoticeCode::points_not_stored, "", {{"points", 1}});
  EXPECT_EQ(words::filled("{points:9} {points:?point|points}", one), "1 point");
  EXPECT_EQ(words::filled("{points:?point|points}",
                          notice(NoticeCode::points_not_stored, "", {{"points", 2}})),
            "points");
}

TEST(Catalogue, ALineNamesSourceAndSeverity) {
  const Notice doubtful = notice(NoticeCode::cycle_unknown);
  const Notice known = inherited("run 3", notice(NoticeCode::run_can_go_on));
  EXPECT_EQ(words::line(doubtful), words::text(doubtful));
  EXPECT_EQ(words::line(known),
            "information: run 3: " + words::text(notice(NoticeCode::run_can_go_on)));
}

// What a number of a real run looks like in its sentence.
TEST(Catalogue, NumbersAreReadable) {
  EXPECT_EQ(
      words::text(notice(
          NoticeCode::stop_too_short, "",
          {{"length_s", 0.15}, {"position_mm", 20.00004}, {"time_s", 12.3456}, {"needed_s", 0.2}})),
      "a stop of 0.150 s at 20.0000 mm, 12.346 s after the first scan, was too short "
      "(0.200 s are needed) and was left out; stop longer, or change --settle-s or "
      "--min-length-s");
}

}  // namespace
}  // namespace mdof
