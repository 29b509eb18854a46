// Which vector instructions the compiled kernels use. All give the same bits; a test or a benchmark
// may ask for one.
#pragma once

#include <vector>

#include "schema/base/result.h"

namespace mdof {

enum class InstructionSet { baseline, avx2, avx512 };
const char* to_string(InstructionSet set);

// The best this processor has, or the one that the environment variable MDOF_INSTRUCTION_SET names
// as to_string() does; it is read once.
InstructionSet best_instruction_set();
// All this processor has, baseline first.
std::vector<InstructionSet> available_instruction_sets();

// Error: MDOF_INSTRUCTION_SET names none, or one that this processor does not have; then
// best_instruction_set() is the processor's. Programs say so when they start.
Status check_instruction_set();

}  // namespace mdof
