#include "tools/mdof/text/run_tables.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "daemon/measure/replay/request_json.h"
#include "daemon/words/words.h"
#include "schema/axis.h"
#include "schema/run_json.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/analyses/means_text.h"
#include "tools/mdof/text/notice_lines.h"
#include "tools/mdof/text/plausibility_text.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kLabel = 11;  // "recording  "

const char* label_of(Severity severity) {
  return severity == Severity::information ? "note"
         : severity == Severity::invalid   ? "INVALID"
                                           : "warning";
}

std::string labelled(std::string label, const std::string& text, std::size_t width) {
  label.resize(std::max(kLabel, label.size() + 1), ' ');
  return wrapped(label + one_line(text), width, kLabel) + "\n";
}

std::string temperature_text(const Temperature& read) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.2f °C (%.2f to %.2f)", read.mean_C, read.min_C,
                read.max_C);
  return text.data();
}

using Options = Result<daemon::PipelineOptions>;

// A text that states the zero of the positions. Empty: the device defines the zero, or a notice
// reports that it is unknown.
std::string datum_of(const Options& options) {
  return options ? datum_text(options->datum) : "";
}

std::string scans_of(const RunHeader& h) {
  if (!are_scans_known(h)) return "unknown (the end of the run was not stored)";
  return std::to_string(h.scans) +
         ", lost: " + (is_lost_known(h) ? std::to_string(h.scans_lost) : "unknown");
}

std::string flags_of(const MeasuredPoint& p) {
  std::string flags = to_string(p.point.flags);
  if (p.errors.valid) return flags;
  return flags + (flags.empty() ? "" : " ") + "unsolved: " + p.errors.reason;
}

// Value with its uncertainty as text. `u`: NaN if it is unknown.
std::string value_with_u(double value, double u, bool angle, double column = 0) {
  if (u >= 0) return angle ? urad_with_u(value, u, column) : um_with_u(value, u, column);
  return angle ? in_urad(value) : in_um(value);
}

}  // namespace

std::string simulated_notice(bool simulated) {
  return simulated ? "SIMULATED DATA: no machine was measured.\n" : "";
}

std::string noise_only_notice(NoiseOnly noise_only) {
  switch (noise_only) {
    case NoiseOnly::none:
      break;
    case NoiseOnly::some:
      return "NOISE ONLY IN PART: u of at least one error or value contains only noise and "
             "repeatability, so u is too small.\n";
    case NoiseOnly::all:
      return "NOISE ONLY: no declared uncertainty adds to u, so every u and U is too small.\n";
  }
  return "";
}

std::string noise_only_notice(bool noise_only) {
  return noise_only_notice(noise_only_if(noise_only));
}

std::string noise_only_comment(NoiseOnly noise_only) {
  return noise_only == NoiseOnly::none ? "" : "# " + noise_only_notice(noise_only);
}

std::string noise_only_comment(bool noise_only) {
  return noise_only_comment(noise_only_if(noise_only));
}

std::string arrow(int direction) {
  return direction > 0 ? "+" : direction < 0 ? "-" : "?";
}

std::string error_label(const std::string& key) {
  const auto at = key.find('_');
  const std::string name = key.substr(0, at), unit = key.substr(at + 1);
  return name + "/" + (unit == "um" ? "µm" : "µrad");
}

std::string stated_text(const StatedAt& at) {
  switch (at.reference) {
    case Reference::carriage:
      return "straightness of the carriage origin, which travels with the target\n";
    case Reference::tool: {
      std::string text = "straightness at the tool point of the fixture,";
      for (const double x : at.point_m) text += " " + in_mm(x);
      return text + " mm\n";
    }
    case Reference::fixture:
      break;
  }
  return "straightness at the fixture\n";
}

std::string head_text(const RunHeader& h, const std::string& result_sha256, std::size_t width,
                      bool all_warnings) {
  const auto& from = h.provenance;
  const Options options = daemon::read_options_json(from.options_json, {});
  const bool on_the_fly = options && options->on_the_fly;
  std::string out = simulated_notice(h.simulated);
  out += wrapped("run " + (h.id == 0 ? std::string("(not stored)") : std::to_string(h.id)) +
                     ", axis " + letter(h.axis) + ", " + to_string(h.state) +
                     (on_the_fly ? ", on the fly" : "") + ", model " + from.model + ", " +
                     h.started_utc,
                 width) +
         "\n";
  if (!h.note.empty()) out += labelled("note", h.note, width);
  if (h.supersedes) out += labelled("supersedes", "run " + std::to_string(*h.supersedes), width);
  out += labelled(from.recording_kind, from.recording_path, width);
  if (!from.recording_sha256.empty()) out += labelled("sha256", from.recording_sha256, width);
  out += labelled("scans", scans_of(h), width);
  if (const auto datum = datum_of(options); !datum.empty()) out += labelled("datum", datum, width);
  if (h.temperature) out += labelled("at", temperature_text(*h.temperature), width);
  out += labelled("software", from.software_version, width);
  for (const Notice& each : summarised(h.notices, all_warnings))
    out += labelled(label_of(each.severity), words::text(each), width);
  if (!result_sha256.empty()) out += labelled("result sha256", result_sha256, width);
  return out;
}

namespace {

Errors5 columns_u(const Run& run, const RunUncertainty& uncertainty) {
  Errors5 columns{};
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    std::vector<double> u;
    for (std::size_t j = 0; j < run.points.size(); ++j)
      if (run.points[j].errors.valid) u.push_back(uncertainty.points[j].u[k]);
    columns[k] = column_u(u);
  }
  return columns;
}

}  // namespace

namespace {

constexpr std::size_t kMostFlagged = 12;  // largest number of rows without --all

bool is_flagged(const MeasuredPoint& point) {
  return !point.errors.valid || !point.point.flags.empty();
}

std::string rows_text(const Run& run, const RunUncertainty& uncertainty,
                      const std::vector<std::size_t>& rows, std::size_t width) {
  const Axis axis = run.header.axis;
  std::vector<std::string> head{"target", "run", "dir", "at/mm"};
  for (const auto& name : error_names(axis)) head.push_back(error_label(name.key));
  head.insert(head.end(), {"samples", "flags"});
  TextTable table(std::move(head), 4);
  const Errors5 column = columns_u(run, uncertainty);
  for (const std::size_t j : rows) {
    const MeasuredPoint& p = run.points[j];
    std::vector<std::string> row{std::to_string(p.target), std::to_string(p.run),
                                 arrow(p.point.direction), in_mm(p.point.position_m)};
    const Errors5 named = named_from_local(run.header.moving(), p.errors.local);
    for (std::size_t k = 0; k < 5; ++k) {
      const bool angle = error_names(axis)[k].angle;
      row.push_back(p.errors.valid
                        ? value_with_u(named[k], uncertainty.points[j].u[k], angle, column[k])
                        : "-");
    }
    row.insert(row.end(), {std::to_string(p.point.samples), flags_of(p)});
    table.add(std::move(row));
  }
  return table.text(width);
}

// A table of the points with flags or without errors, and their number.
std::string flagged_text(const Run& run, const RunUncertainty& uncertainty, std::size_t width) {
  std::vector<std::size_t> rows;
  std::size_t flagged = 0;
  for (std::size_t j = 0; j < run.points.size(); ++j)
    if (is_flagged(run.points[j]) && ++flagged <= kMostFlagged) rows.push_back(j);
  const std::string points = std::to_string(run.points.size());
  // A command without the option --all also shows stored runs.
  const std::string all =
      run.header.id == 0 ? "--all" : "mdof show " + std::to_string(run.header.id) + " --all";
  if (flagged == 0)
    return "points: " + points + ", none has a flag (" + all + " lists the points)\n";
  return wrapped("points: " + points +
                     "; with a flag or without errors: " + std::to_string(flagged) +
                     (flagged > rows.size()
                          ? "; the first " + std::to_string(rows.size()) + " are shown"
                          : "") +
                     " (" + all + " lists all points)",
                 width) +
         "\n" + rows_text(run, uncertainty, rows, width);
}

}  // namespace

std::string points_text(const Run& run, const RunUncertainty& uncertainty, std::size_t width) {
  std::vector<std::size_t> rows(run.points.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows_text(run, uncertainty, rows, width) +
         wrapped("± is the standard uncertainty u. It contains " + covers_text(uncertainty) +
                     ". error = actual - nominal position of the moving " +
                     run.header.sides.moves(),
                 width) +
         "\n" + stated_text(run.header.stated);
}

std::string points_or_means_text(const Run& run, const RunUncertainty& uncertainty,
                                 std::size_t width, bool means) {
  const std::string by_target = means ? means_text(run, width) : "";
  return (by_target.empty() ? points_text(run, uncertainty, width)
                            : by_target + "\n" + flagged_text(run, uncertainty, width)) +
         (run.plausibility ? "\n" + plausibility_text(*run.plausibility) : "");
}

std::string straightness_text(const std::vector<StraightnessFigure>& figures,
                              const std::vector<Budget>& budgets, std::size_t width) {
  TextTable table({"error", "approach", "least squares/µm", "end points/µm", "slope/µrad",
                   "form/µrad", "end slope/µrad", "peak at/mm", "valley at/mm"},
                  2);
  for (const auto& f : figures) {
    const Budget* budget = slope_budget(budgets, f);
    table.add({f.error_key.substr(0, 3), f.approach, in_um(f.straightness_least_squares_m),
               in_um(f.straightness_end_point_m),
               value_with_u(f.slope_least_squares_rad, budget ? budget->u : kNaN, true),
               in_urad(f.form_rad), in_urad(f.slope_end_point_rad), in_mm(f.peak_position_m),
               in_mm(f.valley_position_m)});
  }
  return "straightness, peak to valley about each reference line\n" + table.text(width) +
         wrapped(
             "± is the standard uncertainty u of the mean of the measured approaches. The column "
             "\"form\" is the standard deviation of the slope, calculated from the residuals about "
             "the line",
             width) +
         "\n";
}

std::string minimum_zone_text(const std::vector<StraightnessLines>& lines, std::size_t width) {
  TextTable table({"error", "approach", "minimum zone/µm", "slope/µrad"}, 2);
  for (const auto& of : lines) {
    const ReferenceLine& line = of.lines.minimum_zone;
    table.add(
        {of.error_key.substr(0, 3), of.approach, in_um(line.zone_m), in_urad(line.slope_rad)});
  }
  return "straightness about the minimum-zone line\n" + table.text(width);
}

std::string angles_text(const std::vector<AngleFigure>& figures, std::size_t width) {
  TextTable table({"error", "approach", "at start/µrad", "min/µrad", "max/µrad", "range/µrad"}, 2);
  for (const auto& f : figures) {
    table.add({f.error_key.substr(0, 3), f.approach, in_urad(f.start_rad), in_urad(f.min_rad),
               in_urad(f.max_rad), in_urad(f.max_rad - f.min_rad)});
  }
  return "angles, relative to the first target\n" + table.text(width);
}

}  // namespace mdof::tools
