// The charts of the differences between the visits of a target. A difference is the error at one
// visit minus the mean error of this target and approach. One chart shows the differences against
// the position (repeatability), the other chart against the time in the run (drift).
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/panel.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/charts/run/series.h"
#include "daemon/output/charts/style.h"
#include "schema/axis.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

using output::Phrase;
using output::phrase;

constexpr double kScatterLegendPx = 44;
using Visited = std::pair<int, int>;  // target number, direction of the approach

struct Visits {
  double sum = 0, squares = 0;  // sum of the errors; sum of the squared differences
  std::size_t n = 0;
};

// The differences of all solved points whose target was visited several times from the same side.
struct Scatter {
  std::array<std::vector<Mark>, kErrorCount> marks;
  std::array<double, kErrorCount> largest_s{};  // largest standard deviation of a target and
                                                // approach (divisor n - 1), in the unit of the key
};

bool is_visit(const Mark& mark) {
  return std::isfinite(mark.y) && mark.direction != 0;
}

Scatter scatter_of(const StatedResults& results) {
  Scatter scatter;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    std::map<Visited, Visits> targets;
    const std::vector<Mark> all = error_marks(results, k);
    for (const Mark& mark : all)
      if (is_visit(mark)) {
        Visits& visits = targets[{mark.target, mark.direction}];
        visits.sum += mark.y;
        ++visits.n;
      }
    for (Mark mark : all) {
      if (!is_visit(mark)) continue;
      Visits& visits = targets[{mark.target, mark.direction}];
      if (visits.n < 2) continue;
      mark.y -= visits.sum / static_cast<double>(visits.n);
      mark.U = std::nan("");  // U is the uncertainty of the error, not of this difference
      visits.squares += mark.y * mark.y;
      scatter.marks[k].push_back(std::move(mark));
    }
    for (const auto& [target, visits] : targets)
      if (visits.n > 1)
        scatter.largest_s[k] = std::max(
            scatter.largest_s[k], std::sqrt(visits.squares / static_cast<double>(visits.n - 1)));
  }
  return scatter;
}

// Sets x of each symbol to the time in s from the beginning of the first stop to the middle of its
// own stop.
void place_in_time(Scatter& scatter, const Run& run) {
  const std::int64_t first_ns = run.points.front().point.begin_ns;
  for (auto& marks : scatter.marks)
    for (Mark& mark : marks) {
      const Point& p = run.points[mark.row].point;
      mark.x = (ns_to_s(p.begin_ns - first_ns) + ns_to_s(p.end_ns - first_ns)) / 2;
    }
}

struct ScatterChart {
  Phrase title, note;
  const char* x_key;    // name of the data-… attribute
  std::string x_label;  // label of the axis
};

std::string scatter_svg(const StatedResults& results, const Scatter& scatter,
                        const ScatterChart& chart, Language language) {
  const RunHeader& header = results.run.header;
  std::vector<Range> y;
  Range x;
  for (const auto& marks : scatter.marks) {
    y.push_back(with_room(range_of_marks(marks)));
    for (const Mark& mark : marks) x.include(mark.x);
  }
  const std::vector<std::string> notes = {phrase(chart.note, language)};
  const auto marks_of_head =
      with_noise_only_mark(false, daemon::warning_marks(results.run, language), language);
  const double top = run_head_height(marks_of_head);
  const Sheet sheet(top + kScatterLegendPx, y, kOutputPx);
  const std::string title = run_title(header, phrase(chart.title, language), language);
  std::string words = about_run(header, language) + ".";
  for (const std::string& mark : daemon::warning_marks(results.run, language))
    words += " " + mark + ".";
  Svg svg(kWidthPx, sheet.bottom() + notes_height(notes) + 12, title, words, Theme::light);
  draw_run_head(svg, title, about_run(header, language), marks_of_head, language);
  draw_marks_legend(svg, top, marks_legend(scatter.marks.front()), {}, language);
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const ErrorName& name = error_names(header.axis)[k];
    const Panel panel = sheet.panel(k, with_room(x), false);
    svg.data("panel", name.key).data("x-key", chart.x_key).data("s", scatter.largest_s[k]);
    svg.begin_group();
    draw_axes(svg, panel, chart.x_label);
    draw_y_title(svg, panel, name.key);
    svg.text("quiet tick", {panel.corner.x + panel.width, panel.corner.y - 12}, Anchor::end,
             phrase(Phrase::largest_s, language,
                    {number_text(scatter.largest_s[k], 2) + " " + split_key(name.key).unit}));
    draw_marks(svg, panel, scatter.marks[k]);
    svg.end_group();
  }
  draw_notes(svg, sheet.bottom(), notes);
  return svg.take();
}

}  // namespace

bool has_repeatability(const StatedResults& results) {
  return !scatter_of(results).marks.front().empty();
}

std::string repeatability_svg(const StatedResults& results, Language language) {
  return scatter_svg(
      results, scatter_of(results),
      {Phrase::repeatability, Phrase::repeatability_note, "position_mm", position_key(language)},
      language);
}

std::string drift_svg(const StatedResults& results, Language language) {
  Scatter scatter = scatter_of(results);
  place_in_time(scatter, results.run);
  return scatter_svg(results, scatter,
                     {Phrase::drift_of_run, Phrase::drift_note, "time_s",
                      std::string(phrase(Phrase::time, language)) + "_s"},
                     language);
}

}  // namespace mdof::charts
