#include "schema/severity.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

TEST(SeverityOfASentence, IsItsFirstWordAndStaysInContext) {
  const std::string plain = "the probe A froze", known = information("the axis was parked"),
                    wrong = invalid("the encoder jumped");
  EXPECT_EQ(severity_of(plain), Severity::doubtful);
  EXPECT_EQ(severity_of(known), Severity::information);
  EXPECT_EQ(severity_of(wrong), Severity::invalid);
  EXPECT_EQ(said_of("run 3", plain), "run 3: the probe A froze");
  for (const std::string& sentence : {plain, known, wrong}) {
    const std::string in_context = said_of("run 3", said_of("of two", sentence));
    EXPECT_EQ(severity_of(in_context), severity_of(sentence)) << in_context;
    EXPECT_EQ(words_of_sentence(in_context),
              "run 3: of two: " + std::string(words_of_sentence(sentence)));
  }
}

// A database of an older version has no such word, and a note may speak of information.
TEST(SeverityOfASentence, IsDoubtfulWithoutTheWord) {
  for (const char* sentence : {"", "information", "no information: none came", "Invalid: x"})
    EXPECT_EQ(severity_of(sentence), Severity::doubtful) << sentence;
}

}  // namespace
}  // namespace mdof
