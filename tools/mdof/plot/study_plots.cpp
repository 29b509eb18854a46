#include "tools/mdof/plot/study_plots.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "tools/mdof/plot/charts.h"
#include "tools/mdof/plot/labels.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

Status make_folder(const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (!ec && fs::is_directory(folder, ec)) return {};
  return io_error(folder.string() + ": the folder for the plots cannot be made: " +
                  (ec ? ec.message() : "a file has this name") + "; name one that can be written");
}

// Under its name only once whole.
Status write_file(const fs::path& file, const std::string& text) {
  const fs::path partial = file.string() + "." + std::to_string(::getpid()) + ".partial";
  errno = 0;
  std::ofstream out(partial, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  std::error_code ec;
  if (!out) ec.assign(errno ? errno : EIO, std::generic_category());
  if (!ec) fs::rename(partial, file, ec);
  if (!ec) return {};
  std::error_code ignored;
  fs::remove(partial, ignored);
  return io_error(file.string() + ": the plot cannot be written: " + ec.message() +
                  "; name a folder that can be written and has room");
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
  return "error-against-" + file_name(plot::split_key(result.binned_key).name) + ".svg";
}

}  // namespace

Status write_study_plots(const StudyResult& result, const fs::path& folder) {
  MDOF_CHECK(make_folder(folder));
  for (const OutputSummary& output : result.outputs) {
    if (!plot::has_histogram(output)) continue;
    MDOF_CHECK(write_file(folder / ("histogram-" + file_name(output.key) + ".svg"),
                          plot::histogram_svg(result, output)));
  }
  if (plot::has_bins(result))
    MDOF_CHECK(write_file(folder / bins_file(result), plot::bins_svg(result)));
  if (plot::has_indices(result))
    MDOF_CHECK(write_file(folder / "sensitivity.svg", plot::indices_svg(result)));
  if (plot::has_convergence(result))
    MDOF_CHECK(write_file(folder / "convergence.svg", plot::convergence_svg(result)));
  if (plot::has_frontier(result))
    MDOF_CHECK(write_file(folder / "allocation.svg", plot::frontier_svg(result)));
  return {};
}

}  // namespace mdof::tools
