// What schema/base/number/number_columns.cpp does eight fields at a time where the processor has
// AVX-512.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/base/number/number_columns.h"

namespace mdof::avx512 {

// Only where has_avx512(). Reads fields in groups of eight; gives the number read, a multiple of
// eight: it ends before the first group with a field that is not [-]ddd.ddd of at most 31
// characters and 19 digits that matter, or whose rounding would take a closer look.
std::size_t read_plain(const ColumnText& column, std::size_t n, double* out);
std::size_t read_plain(const ColumnText& column, std::size_t n, std::int64_t* time_ns);

}  // namespace mdof::avx512
