// tests/mutate adds this file to its copy of the sources. One build contains all changes, and the
// environment variable MDOF_CHANGE selects the active change. If MDOF_REACHED is set, the program
// records at its end which changes it has reached. tests/mutate then tries each change only with
// the tests that reach it.
#pragma once

// A changed line may have unused or unusual code. This must not cause a warning.
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-value"
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wbool-compare"
#pragma GCC diagnostic ignored "-Wtype-limits"
#pragma GCC diagnostic ignored "-Wnarrowing"
#pragma GCC diagnostic ignored "-Wempty-body"
#pragma GCC diagnostic ignored "-Wshadow"

#include <array>
#include <cstdlib>
#include <fstream>
#include <type_traits>

namespace mutate {

constinit inline std::array<bool, 8192> reached{};

// This variable is read millions of times. Reading it must be only a load and a comparison.
inline const std::size_t in_force = [] {
  const char* const text = std::getenv("MDOF_CHANGE");
  return text ? std::strtoul(text, nullptr, 10) : 0;
}();

inline const struct AtEnd {
  const char* file = std::getenv("MDOF_REACHED");
  ~AtEnd() {
    if (!file) return;
    std::ofstream out(file);
    for (std::size_t n = 0; n < reached.size(); ++n)
      if (reached[n]) out << n << '\n';
  }
} at_end;

inline bool on(std::size_t n) {
  reached[n] = true;
  return n == in_force;
}

// tests/mutate replaces a OP b by: a OP mutate::..(n) OP b. Both have the same precedence.
template <class T, class Kind>
struct Held {
  const T& a;
  std::size_t n;
};

#define MUTATE_OPERATOR(NAME, OP, OTHER)                                                  \
  struct NAME {                                                                           \
    std::size_t n;                                                                        \
  };                                                                                      \
  template <class T>                                                                      \
  Held<T, NAME> operator OP(const T& a, NAME kind) {                                      \
    return {a, kind.n};                                                                   \
  }                                                                                       \
  template <class T, class U>                                                             \
  auto operator OP(Held<T, NAME> held, const U& b)->std::decay_t<decltype(held.a OP b)> { \
    using Value = std::decay_t<decltype(held.a OP b)>;                                    \
    if (on(held.n)) return static_cast<Value>(held.a OTHER b);                            \
    return held.a OP b;                                                                   \
  }

MUTATE_OPERATOR(plus_minus, +, -)
MUTATE_OPERATOR(minus_plus, -, +)
MUTATE_OPERATOR(times_over, *, /)
MUTATE_OPERATOR(over_times, /, *)
MUTATE_OPERATOR(modulo_over, %, /)
MUTATE_OPERATOR(less_upto, <, <=)
MUTATE_OPERATOR(less_not, <, >=)
MUTATE_OPERATOR(more_from, >, >=)
MUTATE_OPERATOR(more_not, >, <=)
MUTATE_OPERATOR(upto_less, <=, <)
MUTATE_OPERATOR(upto_not, <=, >)
MUTATE_OPERATOR(from_more, >=, >)
MUTATE_OPERATOR(from_not, >=, <)
MUTATE_OPERATOR(same_other, ==, !=)
MUTATE_OPERATOR(other_same, !=, ==)
#undef MUTATE_OPERATOR

inline int sign(std::size_t n) {
  return on(n) ? 1 : -1;
}
inline int flip(std::size_t n) {
  return on(n) ? -1 : 1;
}

template <class T>
T inverse(std::size_t n, T b) {
  static_assert(std::is_floating_point_v<T>);
  return on(n) ? 1 / b : b;
}

template <class T>
T shift(std::size_t n, T index, int by) {
  static_assert(std::is_arithmetic_v<T>);
  return on(n) ? static_cast<T>(index + static_cast<T>(by)) : index;
}

template <class T>
std::decay_t<T> pick(std::size_t n, T then, T now) {
  return on(n) ? then : now;
}

template <class T>
T larger(std::size_t n, T a, T b) {
  return on(n) == (b < a) ? b : a;
}

template <class T>
T smaller(std::size_t n, T a, T b) {
  return on(n) == (b < a) ? a : b;
}

}  // namespace mutate
