// Functions compiled for more than the baseline in files that are compiled for every x86-64: they
// carry the instruction set themselves and are called only where the processor has it. (A file
// compiled for it as a whole must not use inline functions of other headers: the linker may keep
// that copy for everybody.)
#pragma once

#include "schema/base/instruction_set.h"

#if defined(__x86_64__)
#if defined(__GNUC__) && !defined(__clang__)  // GCC 12 warns of its own intrinsics (PR 105593)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#else
#include <immintrin.h>
#endif

#define MDOF_AVX2 [[gnu::target("avx2,bmi,bmi2,fma,popcnt")]]
#define MDOF_AVX512 \
  [[gnu::target("avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx512vbmi2,bmi,bmi2,fma,popcnt")]]
#else
#define MDOF_AVX2
#define MDOF_AVX512
#endif

namespace mdof {

// Whether `most` allows what MDOF_AVX2 (MDOF_AVX512) names, and the processor has it.
inline bool has_avx2([[maybe_unused]] InstructionSet most = best_instruction_set()) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  return most >= InstructionSet::avx2 && __builtin_cpu_supports("avx2") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
         __builtin_cpu_supports("fma") && __builtin_cpu_supports("popcnt");
#else
  return false;
#endif
}
inline bool has_avx512([[maybe_unused]] InstructionSet most = best_instruction_set()) {
#if defined(__x86_64__)
  return most >= InstructionSet::avx512 && has_avx2(most) && __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512vbmi2");
#else
  return false;
#endif
}

}  // namespace mdof
