// Reads the figures of a stored study from their JSON.
#include <simdjson.h>

#include <limits>

#include "tools/mdof/study/json.h"

namespace mdof::tools {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

// A missing member has an empty or default value, and null is NaN. This is no error, because this
// program wrote the figures.
double real(const element& of, const char* key) {
  double x = 0;
  return of.at_key(key).get(x) ? std::numeric_limits<double>::quiet_NaN() : x;
}
std::uint64_t natural(const element& of, const char* key) {
  std::uint64_t x = 0;
  return of.at_key(key).get(x) ? 0 : x;
}
std::string text(const element& of, const char* key) {
  std::string_view x;
  return of.at_key(key).get(x) ? std::string() : std::string(x);
}

template <class Visit>
void each(const element& of, const char* key, Visit visit) {
  array items;
  if (of.at_key(key).get(items)) return;
  for (const element item : items) visit(item);
}
template <class Visit>
void each_member(const element& of, const char* key, Visit visit) {
  object members;
  if (of.at_key(key).get(members)) return;
  for (const auto [name, value] : members) visit(std::string(name), value);
}

CoverageInterval interval(const element& of, const char* key) {
  double ends[2] = {};
  std::size_t n = 0;
  each(of, key, [&](const element& end) {
    if (n < 2 && end.get(ends[n++])) ends[n - 1] = std::numeric_limits<double>::quiet_NaN();
  });
  return {ends[0], ends[1]};
}

Histogram histogram(const element& h) {
  Histogram out{real(h, "from"), real(h, "width"), {}, natural(h, "below"), natural(h, "above")};
  each(h, "counts", [&](const element& count) { out.counts.push_back(count.get_uint64()); });
  return out;
}

OutputSummary summary(const std::string& key, const element& e) {
  OutputSummary s;
  s.key = key;
  s.n = natural(e, "n");
  s.unsolved = natural(e, "unsolved");
  s.mean = real(e, "mean");
  s.mean_se = real(e, "mean_se");
  s.sd = real(e, "sd");
  s.sd_se = real(e, "sd_se");
  s.min = real(e, "min");
  s.max = real(e, "max");
  each(e, "quantiles", [&](const element& q) {
    s.quantiles.push_back({real(q, "p"), real(q, "value")});
  });
  s.coverage = real(e, "coverage");
  s.symmetric = interval(e, "symmetric");
  s.shortest = interval(e, "shortest");
  s.resolution = real(e, "resolution");
  element h;
  if (!e.at_key("histogram").get(h)) s.histogram = histogram(h);
  return s;
}

std::vector<OutputSummary> errors(const element& of) {
  std::vector<OutputSummary> list;
  each_member(of, "errors",
              [&](const std::string& key, const element& e) { list.push_back(summary(key, e)); });
  return list;
}

void read_bins(const element& root, StudyResult& result) {
  element bins;
  if (root.at_key("bins").get(bins)) return;
  result.binned_key = text(bins, "quantity");
  each(bins, "bins", [&](const element& bin) {
    result.bins.push_back({real(bin, "from"), real(bin, "to"), errors(bin)});
  });
}

void read_convergence(const element& root, StudyResult& result) {
  each_member(root, "convergence", [&](const std::string& key, const element&) {
    result.convergence.push_back({key, {}});
  });
  element all;
  if (root.at_key("convergence").get(all)) return;
  for (Convergence& c : result.convergence) {
    each(all, c.key.c_str(), [&](const element& p) {
      c.points.push_back(
          {natural(p, "trials"), real(p, "mean"), real(p, "sd"), real(p, "low"), real(p, "high")});
    });
  }
}

void read_indices(const element& root, StudyResult& result) {
  each_member(root, "indices", [&](const std::string& key, const element& list) {
    OutputIndices output{key, {}};
    for (const element c : list.get_array()) {
      output.causes.push_back({text(c, "cause"), real(c, "first"), real(c, "first_se"),
                               real(c, "total"), real(c, "total_se")});
    }
    result.indices.push_back(std::move(output));
  });
}

AllocatedTolerance tolerance(const element& t) {
  return {text(t, "tolerance"), real(t, "value"), real(t, "low"), real(t, "high")};
}

void read_allocations(const element& root, StudyResult& result) {
  each(root, "allocations", [&](const element& e) {
    Allocation a;
    a.output = text(e, "output");
    a.limit = real(e, "limit");
    a.probability = real(e, "probability");
    a.reached = real(e, "reached");
    each(e, "alone", [&](const element& t) { a.alone.push_back(tolerance(t)); });
    a.common_factor = real(e, "common_factor");
    each(e, "frontier", [&](const element& pair) {
      a.frontier.emplace_back();
      for (const element t : pair.get_array()) a.frontier.back().push_back(tolerance(t));
    });
    result.allocations.push_back(std::move(a));
  });
}

void read_comparison(const element& root, StudyResult& result) {
  each_member(root, "comparison", [&](const std::string& key, const element& c) {
    result.comparison.push_back(
        {key, real(c, "sd_this"), real(c, "sd_other"), real(c, "ratio"), real(c, "ratio_se")});
  });
}

}  // namespace

Status read_study_figures(std::string_view json, const std::string& source, StudyResult& result) {
  simdjson::dom::parser parser;
  element root;
  const simdjson::padded_string text_of(json);
  if (parser.parse(text_of).get(root) || !root.is_object())
    return bad_input(source +
                     ": the stored results are not JSON; restore the database from a backup");
  result.name = text(root, "name");
  result.trials = natural(root, "trials");
  result.seed = natural(root, "seed");
  result.trials_wanted = natural(root, "trials_wanted");
  result.outputs = errors(root);
  read_bins(root, result);
  read_convergence(root, result);
  read_indices(root, result);
  read_allocations(root, result);
  read_comparison(root, result);
  each(root, "warnings",
       [&](const element& w) { result.warnings.emplace_back(std::string_view(w)); });
  return {};
}

}  // namespace mdof::tools
