#include "daemon/output/charts/study/study_plots.h"

#include <string>
#include <string_view>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/output/charts/study/charts.h"
#include "schema/base/output/output_files.h"

namespace mdof::charts {
namespace {

namespace fs = std::filesystem;

std::string bins_file(const StudyResult& result) {
  return "error-against-" + file_name(split_key(result.binned_key).name) + ".svg";
}

}  // namespace

Status write_study_plots(const StudyResult& result, const fs::path& folder) {
  MDOF_CHECK(make_plot_folder(folder));
  OutputFiles files(Existing::replace);
  const auto add = [&](const std::string& name, const std::string& svg) -> Status {
    MDOF_TRY(const std::size_t file, files.add(folder / name));
    return files.write(file, svg);
  };
  for (const OutputSummary& output : result.outputs)
    if (has_histogram(output))
      MDOF_CHECK(add("histogram-" + file_name(output.key) + ".svg", histogram_svg(result, output)));
  if (has_bins(result)) MDOF_CHECK(add(bins_file(result), bins_svg(result)));
  if (has_indices(result)) MDOF_CHECK(add("sensitivity.svg", indices_svg(result)));
  if (has_convergence(result)) MDOF_CHECK(add("convergence.svg", convergence_svg(result)));
  if (has_frontier(result)) MDOF_CHECK(add("allocation.svg", frontier_svg(result)));
  return files.publish();
}

}  // namespace mdof::charts
