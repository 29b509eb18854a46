# embed_page(OUTPUT FILE...): writes OUTPUT, a source file for daemon/rpc/web/page_files.h with the texts of these
# files under their names. A file below daemon/web/ has its path from there as its name. CMake runs again when one of
# the files changes.
function(embed_page output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
  foreach(file ${ARGN})
    if(NOT EXISTS ${file})
      message(FATAL_ERROR "${file} is not there: tools/install-dependencies installs it (libjs-dygraphs)")
    endif()
    get_filename_component(name ${file} NAME)
    set(page ${PROJECT_SOURCE_DIR}/daemon/web)
    cmake_path(IS_PREFIX page ${file} of_page)
    if(of_page)
      cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${page} OUTPUT_VARIABLE name)
    endif()
    file(READ ${file} text)
    string(APPEND rows "    {\"${name}\", R\"the_page(${text})the_page\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
// Generated from daemon/web/ and dygraphs by cmake/embed_page.cmake.
#include "daemon/rpc/web/page_files.h"

#pragma GCC diagnostic ignored "-Woverlength-strings"

namespace mdof::rpc {
namespace {
constexpr PageFile kPageFiles[] = {
@rows@};
}  // namespace

std::span<const PageFile> page_files() {
  return kPageFiles;
}

}  // namespace mdof::rpc
]])
endfunction()
