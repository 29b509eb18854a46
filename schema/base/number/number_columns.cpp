#include "schema/base/number/number_columns.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number.h"
#include "schema/base/number/number_columns_vector.h"
#include "schema/base/number/number_scan.h"
#include "schema/base/number/seconds.h"

namespace mdof {
namespace {

static_assert(kColumnMargin >= kScanMargin);

// Reads a field of another form, for example with an exponent.
[[gnu::noinline, gnu::cold]] bool read_any_number(const char* p, const char* end, double& x) {
  return p != end && parse_double(p, end, x) == end && std::isfinite(x);
}

inline bool read_field(const char* p, const char* end, double& x) {
  ScannedNumber number;
  if (!scan_number(p, end, number)) return read_any_number(p, end, x);
  x = to_double(number);
  return true;
}

inline bool read_field(const char* p, const char* end, std::int64_t& time_ns) {
  ScannedNumber number;
  if (!scan_number(p, end, number) || number.fraction_digits > 9 ||
      number.mantissa >= kPowersOfTen[9 + number.fraction_digits])
    return parse_seconds({p, static_cast<std::size_t>(end - p)}, time_ns);
  const std::uint64_t ns = number.mantissa * kPowersOfTen[9 - number.fraction_digits];
  time_ns = static_cast<std::int64_t>(number.negative ? -ns : ns);
  return true;
}

template <class T>
std::size_t read_one_by_one(const ColumnText& column, std::size_t n, T* out) {
  const std::uint32_t* stop = column.stop;
  for (std::size_t j = 0; j < n; ++j, stop += column.stride)
    if (!read_field(column.text + (stop[0] + 1u), column.text + stop[1], out[j])) return j;
  return n;
}

ColumnText after(const ColumnText& column, std::size_t rows) {
  return {column.text, column.stop + rows * column.stride, column.stride};
}

// Reads several fields at a time as long as all of them are plain. If a field is not plain, the
// next eight fields are read one after the other. The last fields are also read one after the
// other.
template <class T, class ReadPlain>
std::size_t read_groups(ReadPlain* read_plain, const ColumnText& column, std::size_t n, T* out) {
  std::size_t j = 0;
  while (j < n) {
    j += read_plain(after(column, j), n - j, out + j);
    const std::size_t few = std::min<std::size_t>(n - j, 8);
    const std::size_t read = read_one_by_one(after(column, j), few, out + j);
    j += read;
    if (read < few) break;
  }
  return j;
}

}  // namespace

std::size_t read_doubles(const ColumnText& column, std::size_t n, double* out, InstructionSet set) {
  if (set == InstructionSet::baseline) return read_one_by_one(column, n, out);
  return read_groups(plain_readers(set).doubles, column, n, out);
}
std::size_t read_times_ns(const ColumnText& column, std::size_t n, std::int64_t* out,
                          InstructionSet set) {
  if (set == InstructionSet::baseline) return read_one_by_one(column, n, out);
  return read_groups(plain_readers(set).times_ns, column, n, out);
}

}  // namespace mdof
