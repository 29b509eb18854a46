// The vector types of the kernels. Their width is that of the instruction set of the translation
// unit. All names have internal linkage, because they are different types in other translation
// units.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace mdof::algo {
namespace {

#if defined(__AVX512F__)
#define MDOF_VECTOR_BYTES 64
#elif defined(__AVX2__)
#define MDOF_VECTOR_BYTES 32
#else
#define MDOF_VECTOR_BYTES 16
#endif
typedef double Vector __attribute__((vector_size(MDOF_VECTOR_BYTES)));
typedef std::uint64_t Words __attribute__((vector_size(MDOF_VECTOR_BYTES)));
#undef MDOF_VECTOR_BYTES

inline constexpr std::size_t kPerVector = sizeof(Vector) / sizeof(double);

inline Vector as_doubles(Words w) {
  return __builtin_bit_cast(Vector, w);
}
inline Words as_words(Vector v) {
  return __builtin_bit_cast(Words, v);
}

// Product of the lower halves of each word; the upper halves are ignored.
inline Words product32(Words a, Words b) {
#if defined(__AVX512F__)
  // Uses a mask of ones, because the function without mask causes a warning of g++ 12 about its own
  // header (GCC bug 105593).
  return __builtin_bit_cast(Words, _mm512_maskz_mul_epu32(0xFF, __builtin_bit_cast(__m512i, a),
                                                          __builtin_bit_cast(__m512i, b)));
#elif defined(__AVX2__)
  return __builtin_bit_cast(
      Words, _mm256_mul_epu32(__builtin_bit_cast(__m256i, a), __builtin_bit_cast(__m256i, b)));
#elif defined(__SSE2__)
  return __builtin_bit_cast(
      Words, _mm_mul_epu32(__builtin_bit_cast(__m128i, a), __builtin_bit_cast(__m128i, b)));
#else
  return (a & 0xFFFFFFFFu) * (b & 0xFFFFFFFFu);
#endif
}

inline Words xor3(Words a, Words b, Words c) {
#if defined(__AVX512F__)
  return __builtin_bit_cast(Words, _mm512_ternarylogic_epi64(__builtin_bit_cast(__m512i, a),
                                                             __builtin_bit_cast(__m512i, b),
                                                             __builtin_bit_cast(__m512i, c), 0x96));
#else
  return a ^ b ^ c;
#endif
}

inline Vector broadcast(double x) {
  return Vector{} + x;
}
inline Words broadcast(std::uint64_t x) {
  return Words{} + x;
}
inline Vector read(const double* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
inline void write(double* to, Vector v) {
  __builtin_memcpy(to, &v, sizeof v);
}
inline void write(std::uint64_t* to, Words w) {
  __builtin_memcpy(to, &w, sizeof w);
}

// 0, 1, 2, ...
inline Words lane_numbers() {
  Words w;
  for (std::size_t i = 0; i < kPerVector; ++i) w[i] = i;
  return w;
}

// Writes the first n lanes, n <= kPerVector.
inline void write_some(double* to, Vector v, std::size_t n) {
  if (n == kPerVector) {
    write(to, v);
  } else {
    for (std::size_t i = 0; i < n; ++i) to[i] = v[i];
  }
}

}  // namespace
}  // namespace mdof::algo
