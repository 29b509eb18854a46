// The files of the web page, which the build embeds in the program (cmake/embed_page.cmake).
#pragma once

#include <span>
#include <string_view>

namespace mdof::rpc {

struct PageFile {
  std::string_view name;  // "index.html", "views/runs.js"
  std::string_view text;
};

std::span<const PageFile> page_files();

}  // namespace mdof::rpc
