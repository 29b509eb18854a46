# embed_profiles(FOLDER OUTPUT): writes OUTPUT, a source file for drivers/modbus/profile.h with the texts of
# FOLDER/*.toml as raw strings. CMake runs again when one of the files changes.
function(embed_profiles folder output)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.toml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  list(SORT files)
  foreach(file ${files})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND rows "    {\"${name}\", R\"toml(${text})toml\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
// Generated from drivers/modbus/profiles/ by cmake/embed_profiles.cmake.
#include "drivers/modbus/profile.h"

namespace mdof::drivers::modbus {

std::span<const BuiltInProfile> built_in_profiles() {
  static constexpr BuiltInProfile kProfiles[] = {
@rows@  };
  return kProfiles;
}

}  // namespace mdof::drivers::modbus
]])
endfunction()
