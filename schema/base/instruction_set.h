// Vector instructions that a calculation may use. The results have the same bits with every
// instruction set. A test or a benchmark may select a set.
#pragma once

#include <vector>

#include "schema/base/result.h"

namespace mdof {

enum class InstructionSet { baseline, avx2, avx512 };
const char* to_string(InstructionSet set);

// Returns the best set of this processor. If the environment variable MDOF_INSTRUCTION_SET contains
// a name from to_string(), returns the set with this name. The variable is read once.
InstructionSet best_instruction_set();
// Returns all sets that this processor supports, baseline first.
std::vector<InstructionSet> available_instruction_sets();

// Error: MDOF_INSTRUCTION_SET contains an unknown name or a set that this processor does not
// support; best_instruction_set() then returns the best set of the processor. Programs call this
// function when they start.
Status check_instruction_set();

}  // namespace mdof
