// Writes plots to files, and makes their file names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/output/output_files.h"
#include "schema/base/result.h"

namespace mdof::charts {

struct NamedChart {
  std::string file;  // "run-3-straightness.svg"
  std::string svg;
};

// Creates the folder if it is missing, and writes all files into it. Returns their paths. Error
// (io): one of the files cannot be written; then none of the files is written.
Result<std::vector<std::string>> write_charts(const std::vector<NamedChart>& charts,
                                              const std::filesystem::path& folder);

// Creates the folder if it is missing, and adds all charts to `files`, which the caller publishes.
// Returns their paths.
Result<std::vector<std::string>> add_charts(const std::vector<NamedChart>& charts,
                                            const std::filesystem::path& folder,
                                            OutputFiles& files);

// Creates the folder if it is missing. Error (io): the message states the remedy.
Status make_plot_folder(const std::filesystem::path& folder);

// Replaces each character that is not allowed in a file name by its bytes in hexadecimal. Different
// keys therefore make different file names.
std::string file_name(std::string_view key);

}  // namespace mdof::charts
