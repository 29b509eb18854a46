// Functions that use a larger instruction set, in files that are compiled for the x86-64 baseline.
// Each such function has a target attribute and is called only if the processor supports the set.
// Do not compile a whole file for a larger set: the inline functions of its headers would be
// compiled for that set too, and the linker may use these copies in the whole program.
#pragma once

#include "schema/base/instruction_set.h"

#if defined(__x86_64__)
#if defined(__GNUC__) && !defined(__clang__)  // GCC 12 warns about its own intrinsics (PR 105593)
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

// True if a function with MDOF_AVX2 may be called: the processor has its instructions, and the
// largest permitted set `most` includes them. has_avx512(): the same for MDOF_AVX512.
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
