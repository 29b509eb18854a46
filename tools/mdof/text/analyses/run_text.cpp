#include "tools/mdof/text/analyses/run_text.h"

#include "algo/iso230/straightness.h"
#include "tools/mdof/text/analyses/budget_text.h"
#include "tools/mdof/text/analyses/drift_text.h"
#include "tools/mdof/text/run_tables.h"

namespace mdof::tools {
namespace {

std::string approaches_text(const Run& run, const StatedFigures& figures, std::size_t width) {
  return straightness_text(run.straightness, figures.budgets, width) + "\n" +
         angles_text(run.angles, width) + "\n" + stated_figures_text(figures, width);
}

std::string brief_figures_text(const Run& run, const StatedFigures& figures, std::size_t width) {
  const std::string drift = drift_notice(run, daemon::drift_of(run).found, width);
  // If U is unknown, shows the figures of each approach.
  return (figures.why.empty() ? stated_figures_text(figures, width)
                              : approaches_text(run, figures, width)) +
         (drift.empty() ? "" : "\n" + drift);
}

std::string all_figures_text(const Run& run, const StatedFigures& figures, std::size_t width) {
  return approaches_text(run, figures, width) + "\n" +
         minimum_zone_text(algo::straightness_lines(run.header.moving(), run.points), width) +
         "\n" + drift_text(run, daemon::drift_of(run), width);
}

}  // namespace

std::string run_text(const Run& run, const daemon::StatedRun& stated,
                     const std::string& result_sha256, std::size_t width, Extent extent,
                     bool all_warnings) {
  const std::string head = noise_only_notice(stated.points.noise_only) +
                           head_text(run.header, result_sha256, width, all_warnings) + "\n";
  if (extent == Extent::figures) return head + all_figures_text(run, stated.figures, width);
  const bool brief = extent == Extent::brief;
  return head + points_or_means_text(run, stated.points, width, brief) + "\n" +
         (brief ? brief_figures_text(run, stated.figures, width)
                : all_figures_text(run, stated.figures, width));
}

}  // namespace mdof::tools
