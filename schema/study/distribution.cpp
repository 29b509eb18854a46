#include "schema/study/distribution.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "schema/base/files.h"
#include "schema/base/number/number.h"
#include "schema/base/number/number_text.h"
#include "schema/base/trimmed.h"

namespace mdof {
namespace {

using Kind = Distribution::Kind;

constexpr std::size_t kSampleLimit_bytes = std::size_t{16} << 20;
// With more degrees of freedom, the tails of t equal those of the normal distribution to six
// digits.
constexpr double kMostDof = 10'000;

struct KindName {
  const char* name;
  Kind kind;
};
constexpr KindName kKinds[] = {
    {"constant", Kind::constant},
    {"rectangular", Kind::rectangular},
    {"uniform", Kind::rectangular},
    {"triangular", Kind::triangular},
    {"trapezoidal", Kind::trapezoidal},
    {"u-shaped", Kind::u_shaped},
    {"arcsine", Kind::u_shaped},
    {"normal", Kind::normal},
    {"t", Kind::t},
    {"empirical", Kind::empirical},
};

Kind read_kind(TomlTable& table) {
  const std::string name = table.string("distribution");
  std::vector<std::string> known;
  std::string list;
  for (const KindName& k : kKinds) {
    if (name == k.name) return k.kind;
    known.emplace_back(k.name);
    list += std::string(list.empty() ? "" : ", ") + k.name;
  }
  const std::string near = nearest_candidate(name, known);
  table.reject("distribution",
               "\"" + name + "\" is not a distribution; " +
                   (near.empty() ? "possible: " + list : "did you mean \"" + near + "\"?"));
  return Kind::constant;
}

// Reads low and high, or half_width on both sides of the mean.
void read_limits(TomlTable& table, Distribution& d) {
  if (table.has("half_width")) {
    for (const char* key : {"low", "high"})
      if (table.has(key))
        table.reject(key, "contradicts half_width; give half_width, or low and high");
    const double half = table.number("half_width");
    if (!(half > 0))
      table.reject("half_width", "must be greater than zero, not " + plain_number(half));
    const double mean = table.number("mean", 0.0);
    d.low = mean - half;
    d.high = mean + half;
    return;
  }
  d.low = table.number("low");
  d.high = table.number("high");
  if (!(d.low < d.high)) table.reject("high", "must be greater than low");
}

double read_positive(TomlTable& table, const char* key) {
  const double x = table.number(key);
  if (!(x > 0))
    table.reject(key, "must be greater than zero, not " + plain_number(x) +
                          "; for a fixed value use distribution = "
                          "\"constant\"");
  return x;
}

void read_shape(TomlTable& table, Distribution& d) {
  switch (d.kind) {
    case Kind::constant:
      d.centre = table.number("value");
      break;
    case Kind::triangular:
      read_limits(table, d);
      d.mode = table.number("mode", (d.low + d.high) / 2);
      if (!(d.mode >= d.low && d.mode <= d.high))
        table.reject("mode", "must be between low and high");
      break;
    case Kind::trapezoidal:
      read_limits(table, d);
      d.beta = table.number("beta");
      if (!(d.beta >= 0 && d.beta <= 1))
        table.reject("beta", "must be from 0 (triangle) to 1 (rectangle)");
      break;
    case Kind::rectangular:
    case Kind::u_shaped:
      read_limits(table, d);
      break;
    case Kind::normal:
      d.centre = table.number("mean", 0.0);
      d.spread = read_positive(table, "sd");
      break;
    case Kind::t:
      d.centre = table.number("mean", 0.0);
      d.spread = read_positive(table, "scale");
      d.dof = table.number("dof");
      if (!(d.dof >= 1 && d.dof <= kMostDof))
        table.reject("dof",
                     "must be from 1 to 10000; for a larger value use distribution = \"normal\"");
      break;
    case Kind::empirical:
      break;
  }
}

bool read_number(std::string_view text, double& x) {
  const char* end = text.data() + text.size();
  return parse_double(text.data(), end, x) == end && std::isfinite(x);
}

}  // namespace

const char* to_string(Distribution::Kind kind) {
  const auto* found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const KindName& k) { return k.kind == kind; });
  return found->name;
}

Result<std::vector<double>> load_sample(const std::filesystem::path& file) {
  MDOF_TRY(const std::string text, read_text_file(file, kSampleLimit_bytes));
  std::vector<double> sample;
  bool first = true;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto line = trimmed(std::string_view(text).substr(at, end - at));
    at = end + 1;
    ++number;
    if (line.empty() || line[0] == '#') continue;
    double x = 0;
    const bool good = read_number(line, x);
    if (good) sample.push_back(x);
    if (!good && !first)
      return bad_input(
          file.string() + ":" + std::to_string(number) + ": \"" + std::string(line.substr(0, 40)) +
          "\" is not a finite number; the file must contain one column of numbers only");
    first = false;
  }
  if (sample.size() < 2)
    return bad_input(file.string() + ": " + std::to_string(sample.size()) +
                     " value(s), but an empirical distribution needs at least two");
  std::sort(sample.begin(), sample.end());
  return sample;
}

Result<Distribution> read_distribution(TomlTable& table, const std::filesystem::path& folder) {
  Distribution d;
  d.kind = read_kind(table);
  read_shape(table, d);
  if (d.kind == Kind::empirical) {
    const std::string file = table.string("file");
    if (file.empty()) {
      table.reject("file", "must be the name of a file with one column of numbers");
      return d;
    }
    auto sample = load_sample(folder / file);
    if (!sample) return in_context(table.where("file"), sample.error());
    d.sample = std::move(*sample);
  }
  return d;
}

}  // namespace mdof
