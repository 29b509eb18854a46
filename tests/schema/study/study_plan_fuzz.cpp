// Plans of studies as TOML. For any input, the plan is read or rejected with a reason. The rig of
// a plan is in another file and is not read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "schema/study/plan.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto plan = mdof::parse_study_plan(text, MDOF_TEST_DATA "/sensitivity/fuzz.toml");
  if (!plan && plan.error().message.empty()) std::abort();
  return 0;
}
