# The files of a folder are compiled together (tests in four parts), as most of the time of a build from nothing goes
# to headers (tests/CAMPAIGNS.md has the figures). So under sanitizers, in tools/quickstart and .ci/run; who edits one
# file builds faster without. Names of the anonymous namespaces of a folder must then differ; a file with a name that
# stands elsewhere too ("redefinition", "ambiguous") gets another name for it, or shares what is the same by a header.
# Alone is what Highway includes again for each instruction set, and what cannot be together for another such reason.
set(MDOF_COMPILE_TOGETHER "$ENV{MDOF_COMPILE_TOGETHER}" CACHE STRING
    "Compile the files of a folder together (ON, OFF; default: of the environment, else under sanitizers)")
set(MDOF_COMPILED_ALONE
  schema/base/number/number_columns_vector.cpp
  schema/base/number/number_digits.cpp
)
foreach(file ${MDOF_COMPILED_ALONE})
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${file})
    message(FATAL_ERROR "cmake/compile_together.cmake names ${file}, which is not there: give its new name, or leave it out")
  endif()
endforeach()

# mdof_compile_together(TARGET): once all its sources are known, in the folder that made it.
function(mdof_compile_together target)
  if(NOT (MDOF_COMPILE_TOGETHER OR (MDOF_SANITIZE AND MDOF_COMPILE_TOGETHER STREQUAL "")))
    return()
  endif()
  get_target_property(FILES ${target} SOURCES)
  foreach(file ${FILES})
    cmake_path(ABSOLUTE_PATH file OUTPUT_VARIABLE path)
    cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(GET path STEM name)
    if(path IN_LIST MDOF_COMPILED_ALONE)
      set_source_files_properties(${file} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    else()
      set(part "")
      if(folder MATCHES "^tests")
        # By the first letter, so that a new file does not change who is compiled with whom.
        string(REGEX REPLACE "^[a-c].*" "_a" part "${name}")
        string(REGEX REPLACE "^[d-l].*" "_d" part "${part}")
        string(REGEX REPLACE "^[m-r].*" "_m" part "${part}")
        string(REGEX REPLACE "^[s-z].*" "_s" part "${part}")
      endif()
      string(MAKE_C_IDENTIFIER "${folder}${part}" group)
      set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class of a source file may have members of its anonymous namespace, wherever the file is included.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
