# embed_sql(FOLDER OUTPUT): writes OUTPUT, a source file for schema/sql/sql.h with the texts of FOLDER/NNN_*.sql and
# FOLDER/*/NNN_*.sql (migrations, in the order of their numbers) and of schema/recording/recording.sql as raw strings.
# CMake runs again when one of the files changes.
function(embed_sql folder output)
  set(recording_file ${PROJECT_SOURCE_DIR}/schema/recording/recording.sql)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.sql ${folder}/*/*.sql)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files} ${recording_file})
  file(GLOB migrations ${folder}/[0-9][0-9][0-9]_*.sql ${folder}/*/[0-9][0-9][0-9]_*.sql)
  list(SORT migrations COMPARE FILE_BASENAME)
  foreach(file ${migrations})
    get_filename_component(name ${file} NAME)
    string(REGEX MATCH "^0*([0-9]+)_" unused ${name})
    set(version ${CMAKE_MATCH_1})
    if(version STREQUAL last_version)
      message(FATAL_ERROR "schema/sql has two migrations ${version}; give ${name} the next number")
    endif()
    set(last_version ${version})
    file(READ ${file} text)
    string(APPEND rows "    {${version}, \"${name}\", R\"sql(${text})sql\"},\n")
  endforeach()
  file(READ ${recording_file} recording)
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
// Generated from schema/sql/ by cmake/embed_sql.cmake.
#include "schema/sql/sql.h"

namespace mdof::sql {
namespace {
constexpr Migration kMigrations[] = {
@rows@};
constexpr char kRecording[] = R"sql(@recording@)sql";
}  // namespace

std::span<const Migration> migrations() { return kMigrations; }
const char* recording() { return kRecording; }

}  // namespace mdof::sql
]])
endfunction()
