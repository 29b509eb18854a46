// Which vector instructions the compiled kernels use. All give the same bits; a test or a benchmark
// may ask for one.
#pragma once

#include <vector>

namespace mdof::algo {

enum class InstructionSet { baseline, avx2, avx512 };
const char* to_string(InstructionSet set);

// The best this processor has.
InstructionSet best_instruction_set();
// All this processor has, baseline first.
std::vector<InstructionSet> available_instruction_sets();

}  // namespace mdof::algo
