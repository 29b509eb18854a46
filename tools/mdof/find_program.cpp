#include "tools/mdof/find_program.h"

#include <unistd.h>

#include <cstdlib>

namespace mdof::tools {

namespace fs = std::filesystem;

std::optional<fs::path> find_program(const std::string& name) {
  const char* value = std::getenv("PATH");
  const std::string path = value ? value : "";
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find(':', at), path.size());
    const fs::path file = fs::path(path.substr(at, end - at)) / name;
    if (end > at && ::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file)) return file;
    at = end + 1;
  }
  return std::nullopt;
}

}  // namespace mdof::tools
