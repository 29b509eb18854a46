#include "daemon/words/error_text.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace mdof {
namespace {

std::vector<Remedy> all_remedies() {
  return {
#define REMEDY(code) Remedy::code,
#include "schema/base/remedy/remedies.inc"
#undef REMEDY
  };
}

TEST(ErrorText, EachRemedyHasItsTextInBothLanguages) {
  std::set<std::string> english, german;
  for (const Remedy each : all_remedies()) {
    const std::string in_english = words::remedy(each, "@");
    const std::string in_german = words::remedy(each, "@", words::Language::german);
    EXPECT_TRUE(english.insert(in_english).second) << to_string(each);
    EXPECT_TRUE(german.insert(in_german).second) << to_string(each);
    EXPECT_NE(in_english, in_german);
    EXPECT_EQ(in_english.find('@') == std::string::npos, in_german.find('@') == std::string::npos)
        << to_string(each) << ": only one of them says what it is for";
    EXPECT_TRUE(!in_english.empty() && in_english.back() != '.' && in_german.back() != '.')
        << to_string(each);
  }
}

TEST(ErrorText, AnErrorEndsWithItsRemedy) {
  const auto error = bad_input("run 7 has 200000 points", Remedy::show_run, "7").value();
  EXPECT_EQ(words::text(error), "run 7 has 200000 points; to read the run, use: mdof show 7");
  EXPECT_EQ(words::text(error, words::Language::german),
            "run 7 has 200000 points; um die Messung zu lesen: mdof show 7");
  EXPECT_EQ(words::text(bad_input("a.csv: is empty").value()), "a.csv: is empty");
}

// The context is put before the message. The remedy remains at the end.
TEST(ErrorText, AnErrorInAContextKeepsItsRemedy) {
  const auto error = in_context("rig.toml", bad_input("no rig", Remedy::give_rig).value()).value();
  EXPECT_EQ(words::text(error), "rig.toml: no rig; give the rig file with --rig RIG.toml");
  EXPECT_STREQ(to_string(error.remedy), "give_rig");
}

}  // namespace
}  // namespace mdof
