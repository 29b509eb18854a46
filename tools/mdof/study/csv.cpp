#include <array>

#include "schema/base/number/number.h"
#include "tools/mdof/study/output.h"

namespace mdof::tools {
namespace {

class Rows {
 public:
  Rows& field(const std::string& text) {
    text_ += (at_start_ ? "" : ",") + text;
    at_start_ = false;
    return *this;
  }
  Rows& field(double x) {
    std::array<char, kDouble17Size> digits;
    return field(std::string(digits.data(), write_double_17(digits.data(), x)));
  }
  void end() {
    text_ += '\n';
    at_start_ = true;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  bool at_start_ = true;
};

void head(Rows& rows, const StudyResult& result) {
  for (const char* name : {"output", "from", "to", "trials", "unsolved", "mean", "mean_se", "sd",
                           "sd_se", "min", "max"})
    rows.field(name);
  const OutputSummary& first = result.outputs.front();
  for (const Quantile& q : first.quantiles) {
    std::array<char, kDouble17Size> digits;
    const auto p = std::string(digits.data(), write_double_17(digits.data(), 100 * q.p));
    rows.field("percentile_" + p);
  }
  for (const char* name : {"coverage", "symmetric_low", "symmetric_high", "shortest_low",
                           "shortest_high", "resolution"})
    rows.field(name);
  rows.end();
}

void row(Rows& rows, const OutputSummary& s, double from, double to, bool binned) {
  rows.field(s.key);
  binned ? rows.field(from).field(to) : rows.field("").field("");
  rows.field(std::to_string(s.n)).field(std::to_string(s.unsolved));
  for (const double x : {s.mean, s.mean_se, s.sd, s.sd_se, s.min, s.max}) rows.field(x);
  for (const Quantile& q : s.quantiles) rows.field(q.value);
  for (const double x : {s.coverage, s.symmetric.low, s.symmetric.high, s.shortest.low,
                         s.shortest.high, s.resolution})
    rows.field(x);
  rows.end();
}

}  // namespace

std::string study_csv(const StudyResult& result) {
  Rows rows;
  rows.field("# " + result.name + " seed " + std::to_string(result.seed) + " trials " +
             std::to_string(result.trials));
  rows.end();
  if (!result.binned_key.empty()) {
    rows.field("# columns from and to: the limits of a bin in " + result.binned_key +
               "; both are empty in a row for the whole range");
    rows.end();
  }
  if (result.outputs.empty()) return rows.take();
  head(rows, result);
  for (const OutputSummary& s : result.outputs) row(rows, s, 0, 0, false);
  for (const StudyBin& bin : result.bins)
    for (const OutputSummary& s : bin.outputs) row(rows, s, bin.from, bin.to, true);
  return rows.take();
}

}  // namespace mdof::tools
