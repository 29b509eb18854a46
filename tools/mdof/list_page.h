// The part of a list that a command shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace mdof::tools {

struct ListPage {
  std::int64_t offset = 0, count = 50;
};

void add_page_options(CLI::App& command, ListPage& page);  // adds --offset and --count

// "50 of 120 runs are shown; see --offset and --count", with a line end; empty if all are shown.
std::string left_out(std::size_t shown, std::int64_t total, const char* of_what);

}  // namespace mdof::tools
