#include <algorithm>
#include <cmath>

#include "tools/mdof/study/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

// The number of decimals with which a value of this size has four digits.
int decimals_for(double size) {
  if (!std::isfinite(size) || size <= 0) return 4;
  return std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 9);
}

std::string percent(double share) {
  std::string text = fixed(share * 100, 3);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " %";
}

std::string interval(const CoverageInterval& x, int decimals) {
  return "[" + fixed(x.low, decimals) + ", " + fixed(x.high, decimals) + "]";
}

std::string overall(const StudyResult& result) {
  const std::string p = percent(result.outputs.front().coverage);
  TextTable table({"", "mean", "se", "sd", "se", "min", "max", p + " symmetric", p + " shortest",
                   "resolution"});
  for (const OutputSummary& s : result.outputs) {
    const int d = decimals_for(s.sd);
    table.add({with_unit(s.key), fixed(s.mean, d), fixed(s.mean_se, d + 2), fixed(s.sd, d + 1),
               fixed(s.sd_se, d + 2), fixed(s.min, d), fixed(s.max, d), interval(s.symmetric, d),
               interval(s.shortest, d), fixed(s.resolution, d + 2)});
  }
  const std::size_t width = terminal_columns();
  return table.text(width) +
         wrapped(
             "sd: standard deviation; se: standard error. The coverage intervals (JCGM 101 7.7, "
             "5.3.4) and the quantiles are estimated from histograms. They differ from the exact "
             "values of the sorted trials by at most the value in the column \"resolution\".",
             width) +
         "\n";
}

std::string bins(const StudyResult& result) {
  std::vector<std::string> head{with_unit(result.binned_key)};
  for (const OutputSummary& s : result.outputs) head.push_back("sd " + with_unit(s.key));
  TextTable table(head);
  std::string reason;
  for (const StudyBin& bin : result.bins) {
    std::vector<std::string> row{fixed(bin.from, 3) + " to " + fixed(bin.to, 3)};
    for (std::size_t k = 0; k < bin.outputs.size(); ++k)
      row.push_back(fixed(bin.outputs[k].sd, decimals_for(result.outputs[k].sd) + 1));
    table.add(std::move(row));
    if (*bin.reason()) reason = std::string("\"-\": unknown, because ") + bin.reason() + "\n";
  }
  return "\n" + table.text(terminal_columns()) + reason;
}

std::string indices(const OutputIndices& output) {
  TextTable table({"cause", "first order", "total"});
  for (const CauseIndex& c : output.causes)
    table.add({c.cause, with_u(fixed(c.first, 4), fixed(c.first_se, 4)),
               with_u(fixed(c.total, 4), fixed(c.total_se, 4))});
  return "\nShares of the variance of " + with_unit(output.key) + "\n" +
         table.text(terminal_columns());
}

std::string tolerance(const AllocatedTolerance& t) {
  if (std::isnan(t.value) || std::isinf(t.value)) return t.tolerance + ": no effect on this output";
  const int d = decimals_for(t.value);
  if (std::isnan(t.low)) return t.tolerance + " " + fixed(t.value, d);
  return t.tolerance + " " + fixed(t.value, d) + " (" + fixed(t.low, d) + " ... " +
         fixed(t.high, d) + ")";
}

constexpr const char* kNotMet = ": none; the limit is not met even with the value 0";

std::string allocation(const Allocation& a) {
  std::string text = "\nLargest tolerances with which |" + with_unit(a.output) +
                     "| <= " + fixed(a.limit, decimals_for(a.limit)) + " has the probability " +
                     percent(a.probability) +
                     " (probability with the planned values: " + percent(a.reached) + ")\n";
  for (const AllocatedTolerance& t : a.alone)
    text += "  alone     " +
            (t.value == 0 && a.reached < a.probability ? t.tolerance + kNotMet : tolerance(t)) +
            "\n";
  text += a.common_factor == 0
              ? std::string("  together") + kNotMet + "\n"
              : "  together  all planned values multiplied by " + fixed(a.common_factor, 4) + "\n";
  for (const auto& pair : a.frontier) {
    std::vector<std::string> words;
    for (const AllocatedTolerance& t : pair) words.push_back(tolerance(t));
    text += "  pair      " + joined(words, " with ") + "\n";
  }
  text += "alone: the other tolerances have their planned values\n";
  if (!a.frontier.empty())
    text += "pair: a value of the first tolerance, with the largest value of the second\n";
  return text;
}

std::string comparison(const std::vector<ComparedOutput>& compared) {
  TextTable table({"", "sd, this fixture", "sd, other fixture", "other / this"});
  for (const ComparedOutput& c : compared) {
    const int d = decimals_for(c.sd_this) + 1;
    table.add({with_unit(c.key), fixed(c.sd_this, d), fixed(c.sd_other, d),
               with_u(fixed(c.ratio, 4), fixed(c.ratio_se, 4))});
  }
  return "\nComparison with the other fixture (same random numbers)\n" +
         table.text(terminal_columns());
}

std::string head(const StudyResult& result) {
  std::string text = result.name + ": " + std::to_string(result.trials) + " trials";
  if (result.trials_wanted > result.trials) text += " of " + std::to_string(result.trials_wanted);
  text += ", seed " + std::to_string(result.seed) + ", " + fixed(result.elapsed_s, 2) + " s";
  return text + (result.state == StudyState::interrupted ? ", INTERRUPTED\n\n" : "\n\n");
}

}  // namespace

std::string with_unit(const std::string& key) {
  const std::size_t at = key.rfind('_');
  if (at == std::string::npos) return key;
  std::string unit = key.substr(at + 1);
  if (unit == "um" || unit == "urad") unit.replace(0, 1, "µ");
  return key.substr(0, at) + "/" + unit;
}

std::string study_text(const StudyResult& result) {
  std::string text = head(result);
  if (!result.outputs.empty()) text += overall(result);
  if (!result.bins.empty()) text += bins(result);
  for (const OutputIndices& output : result.indices) text += indices(output);
  for (const Allocation& a : result.allocations) text += allocation(a);
  if (!result.comparison.empty()) text += comparison(result.comparison);
  return text;
}

}  // namespace mdof::tools
