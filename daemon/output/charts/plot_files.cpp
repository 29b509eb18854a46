#include "daemon/output/charts/plot_files.h"

#include <system_error>

namespace mdof::charts {

namespace fs = std::filesystem;

Status make_plot_folder(const fs::path& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (!ec && fs::is_directory(folder, ec)) return {};
  return io_error(folder.string() + ": cannot create the folder for the plots: " +
                  (ec ? ec.message() : "a file has this name") + "; give another folder");
}

Result<std::vector<std::string>> add_charts(const std::vector<NamedChart>& charts,
                                            const fs::path& folder, OutputFiles& files) {
  MDOF_CHECK(make_plot_folder(folder));
  std::vector<std::string> paths;
  for (const NamedChart& chart : charts) {
    paths.push_back((folder / chart.file).string());
    MDOF_TRY(const std::size_t file, files.add(paths.back()));
    MDOF_CHECK(files.write(file, chart.svg));
  }
  return paths;
}

Result<std::vector<std::string>> write_charts(const std::vector<NamedChart>& charts,
                                              const fs::path& folder) {
  OutputFiles files(Existing::replace);
  MDOF_TRY(auto paths, add_charts(charts, folder, files));
  MDOF_CHECK(files.publish());
  return paths;
}

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

}  // namespace mdof::charts
