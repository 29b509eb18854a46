#include "tools/mdof/list_page.h"

#include <CLI/CLI.hpp>

#include "tools/mdof/options.h"

namespace mdof::tools {

void add_page_options(CLI::App& command, ListPage& page) {
  command.add_option("--offset", page.offset, "Number of entries to skip")
      ->check(not_negative_number());
  command.add_option("--count", page.count, "Largest number of entries to list")
      ->check(not_negative_number())
      ->capture_default_str();
}

std::string left_out(std::size_t shown, std::int64_t total, const char* of_what) {
  if (static_cast<std::int64_t>(shown) >= total) return "";
  return std::to_string(shown) + " of " + std::to_string(total) + " " + of_what +
         " are shown; see --offset and --count\n";
}

}  // namespace mdof::tools
