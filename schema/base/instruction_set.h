// Vector instructions of the compiled kernels. All sets give the same bits; a test or a benchmark
// may select one.
#pragma once

#include <vector>

#include "schema/base/result.h"

namespace mdof {

enum class InstructionSet { baseline, avx2, avx512 };
const char* to_string(InstructionSet set);

// The best set of this processor, or the set that the environment variable MDOF_INSTRUCTION_SET
// names as in to_string(). The variable is read once.
InstructionSet best_instruction_set();
// All sets of this processor, baseline first.
std::vector<InstructionSet> available_instruction_sets();

// Error: MDOF_INSTRUCTION_SET names an unknown set, or one that this processor does not support;
// best_instruction_set() is then the best of the processor. Programs check this when they start.
Status check_instruction_set();

}  // namespace mdof
