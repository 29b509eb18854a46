#include "tools/mdof/study/json.h"

#include "schema/base/json_writer.h"
#include "tools/mdof/output.h"
#include "tools/mdof/study/output.h"

namespace mdof::tools {
namespace {

void write_interval(JsonWriter& json, const char* name, const CoverageInterval& interval) {
  json.key(name).begin_array().value(interval.low).value(interval.high).end_array();
}

// Writes the list of quantiles, and also "p025" and "p975" as single members for scripts.
void write_quantiles(JsonWriter& json, const std::vector<Quantile>& quantiles) {
  for (const Quantile& q : quantiles) {
    if (q.p == 0.025) json.field("p025", q.value);
    if (q.p == 0.975) json.field("p975", q.value);
  }
  json.key("quantiles").begin_array();
  for (const Quantile& q : quantiles)
    json.begin_object().field("p", q.p).field("value", q.value).end_object();
  json.end_array();
}

void write_histogram(JsonWriter& json, const Histogram& histogram) {
  json.key("histogram").begin_object();
  json.field("from", histogram.from).field("width", histogram.width);
  json.field("below", histogram.below).field("above", histogram.above);
  json.key("counts").begin_array();
  for (const std::uint64_t count : histogram.counts) json.value(count);
  json.end_array().end_object();
}

void write_summary(JsonWriter& json, const OutputSummary& s) {
  json.begin_object();
  json.field("mean", s.mean).field("sd", s.sd).field("min", s.min).field("max", s.max);
  write_quantiles(json, s.quantiles);
  json.field("mean_se", s.mean_se).field("sd_se", s.sd_se);
  json.field("n", s.n).field("unsolved", s.unsolved).field("coverage", s.coverage);
  write_interval(json, "symmetric", s.symmetric);
  write_interval(json, "shortest", s.shortest);
  json.field("resolution", s.resolution);
  if (!s.histogram.counts.empty()) write_histogram(json, s.histogram);
  json.end_object();
}

void write_errors(JsonWriter& json, const std::vector<OutputSummary>& outputs) {
  json.key("errors").begin_object();
  for (const OutputSummary& s : outputs) write_summary(json.key(s.key), s);
  json.end_object();
}

void write_bins(JsonWriter& json, const StudyResult& result) {
  json.key("bins").begin_object().field("quantity", result.binned_key);
  json.key("bins").begin_array();
  for (const StudyBin& bin : result.bins) {
    json.begin_object().field("from", bin.from).field("to", bin.to);
    write_errors(json, bin.outputs);
    if (*bin.reason()) json.field("reason", bin.reason());
    json.end_object();
  }
  json.end_array().end_object();
}

void write_convergence(JsonWriter& json, const std::vector<Convergence>& convergence) {
  json.key("convergence").begin_object();
  for (const Convergence& c : convergence) {
    json.key(c.key).begin_array();
    for (const ConvergencePoint& p : c.points) {
      json.begin_object().field("trials", p.trials).field("mean", p.mean).field("sd", p.sd);
      json.field("low", p.low).field("high", p.high).end_object();
    }
    json.end_array();
  }
  json.end_object();
}

void write_indices(JsonWriter& json, const std::vector<OutputIndices>& indices) {
  json.key("indices").begin_object();
  for (const OutputIndices& output : indices) {
    json.key(output.key).begin_array();
    for (const CauseIndex& c : output.causes) {
      json.begin_object().field("cause", c.cause).field("first", c.first);
      json.field("first_se", c.first_se).field("total", c.total);
      json.field("total_se", c.total_se).end_object();
    }
    json.end_array();
  }
  json.end_object();
}

void write_tolerances(JsonWriter& json, const std::vector<AllocatedTolerance>& tolerances) {
  json.begin_array();
  for (const AllocatedTolerance& t : tolerances) {
    json.begin_object().field("tolerance", t.tolerance).field("value", t.value);
    json.field("low", t.low).field("high", t.high).end_object();
  }
  json.end_array();
}

void write_allocations(JsonWriter& json, const std::vector<Allocation>& allocations) {
  json.key("allocations").begin_array();
  for (const Allocation& a : allocations) {
    json.begin_object().field("output", a.output).field("limit", a.limit);
    json.field("probability", a.probability).field("reached", a.reached);
    write_tolerances(json.key("alone"), a.alone);
    json.field("common_factor", a.common_factor).key("frontier").begin_array();
    for (const auto& pair : a.frontier) write_tolerances(json, pair);
    json.end_array().end_object();
  }
  json.end_array();
}

void write_comparison(JsonWriter& json, const std::vector<ComparedOutput>& comparison) {
  json.key("comparison").begin_object();
  for (const ComparedOutput& c : comparison) {
    json.key(c.key).begin_object().field("sd_this", c.sd_this).field("sd_other", c.sd_other);
    json.field("ratio", c.ratio).field("ratio_se", c.ratio_se).end_object();
  }
  json.end_object();
}

}  // namespace

std::string study_figures_json(const StudyResult& result) {
  JsonWriter json;
  json.begin_object().field("name", result.name);
  json.field("trials", result.trials).field("seed", result.seed);
  json.key("trials_wanted");
  result.trials_wanted == 0 ? json.null() : json.value(result.trials_wanted);
  write_errors(json, result.outputs);
  if (!result.bins.empty()) write_bins(json, result);
  write_convergence(json, result.convergence);
  if (!result.indices.empty()) write_indices(json, result.indices);
  if (!result.allocations.empty()) write_allocations(json, result.allocations);
  if (!result.comparison.empty()) write_comparison(json, result.comparison);
  json.key("warnings").begin_array();
  for (const auto& warning : result.warnings) json.value(warning);
  json.end_array().end_object();
  return json.take();
}

std::string study_json(const StudyResult& result, const std::string& figures_json,
                       std::optional<std::int64_t> study) {
  JsonWriter head;
  head.begin_object();
  if (study) head.field("study", *study);
  head.field("state", to_string(result.state)).field("elapsed_s", result.elapsed_s);
  head.field("started_utc", result.started_utc).field("software_version", result.software);
  head.field("plan_toml", result.plan_toml);
  return head.take() + "," + figures_json.substr(1);
}

Status print_study(const StudyResult& result, const std::string& figures_json,
                   std::optional<std::int64_t> study, StudyForm form) {
  if (form == StudyForm::json) return write_line(study_json(result, figures_json, study));
  return write_out(form == StudyForm::csv ? study_csv(result) : study_text(result));
}

}  // namespace mdof::tools
