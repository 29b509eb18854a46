#include "daemon/output/charts/study/study_plots.h"

#include <string>
#include <string_view>
#include <system_error>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/study/charts.h"
#include "schema/base/output/output_files.h"

namespace mdof::charts {
namespace {

namespace fs = std::filesystem;

Status make_folder(const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (!ec && fs::is_directory(folder, ec)) return {};
  return io_error(folder.string() + ": the folder for the plots cannot be made: " +
                  (ec ? ec.message() : "a file has this name") + "; name one that can be written");
}

// Keys are words already; whatever else one contains becomes its bytes in hexadecimal, so that
// different keys stay different files.
std::string file_name(std::string_view key) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
  std::string name;
  for (const char c : key) {
    const auto byte = static_cast<unsigned char>(c);
    if (kPlain.find(c) != std::string_view::npos)
      name += c;
    else
      name += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return name;
}

std::string bins_file(const StudyResult& result) {
  return "error-against-" + file_name(split_key(result.binned_key).name) + ".svg";
}

}  // namespace

Status write_study_plots(const StudyResult& result, const fs::path& folder) {
  MDOF_CHECK(make_folder(folder));
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
