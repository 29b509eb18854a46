#include "schema/base/instruction_set.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace mdof {
namespace {

class InstructionSetAskedFor : public testing::Test {
 protected:
  void TearDown() override {
    if (had_environment_value_) {
      ::setenv("MDOF_INSTRUCTION_SET", before_.c_str(), 1);
    } else {
      ::unsetenv("MDOF_INSTRUCTION_SET");
    }
  }

 private:
  const char* const environment_value_ = std::getenv("MDOF_INSTRUCTION_SET");
  const bool had_environment_value_ = environment_value_ != nullptr;
  const std::string before_ = had_environment_value_ ? environment_value_ : "";
};

TEST_F(InstructionSetAskedFor, AcceptsEachSetOfTheProcessor) {
  ASSERT_EQ(available_instruction_sets().front(), InstructionSet::baseline);
  for (const InstructionSet set : available_instruction_sets()) {
    ::setenv("MDOF_INSTRUCTION_SET", to_string(set), 1);
    EXPECT_TRUE(check_instruction_set()) << to_string(set);
  }
  ::setenv("MDOF_INSTRUCTION_SET", "", 1);
  EXPECT_TRUE(check_instruction_set());
}

TEST_F(InstructionSetAskedFor, RejectsUnknownSetsByName) {
  ::setenv("MDOF_INSTRUCTION_SET", "avx9", 1);
  const Status checked = check_instruction_set();
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, ErrorCode::bad_input);
  EXPECT_EQ(checked.error().message.find(
                "MDOF_INSTRUCTION_SET is \"avx9\", but this processor supports only baseline"),
            0u)
      << checked.error().message;
}

}  // namespace
}  // namespace mdof
