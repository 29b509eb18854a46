# Headers that most files of a library include, read once for all of them. For a quick build from nothing
# (MDOF_BUILD_QUICKLY); not for who edits, nor for .ci/run: ccache keeps what is compiled without them, and a file that
# includes too little is found only there. So are warnings: g++ 12 gives false alarms for precompiled headers of the
# standard library, since it forgets that they are the system's.

set(MDOF_STANDARD_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <deque> <filesystem> <fstream>
  <functional> <map> <memory> <mutex> <optional> <set> <span> <sstream> <string> <string_view> <thread>
  <unordered_map> <utility> <variant> <vector>)

# mdof_precompile(TARGET [header...]): the standard ones and these, of ours by their path.
function(mdof_precompile target)
  if(MDOF_BUILD_QUICKLY)
    list(TRANSFORM ARGN REPLACE "^[^<].*" "${PROJECT_SOURCE_DIR}/\\0")
    target_precompile_headers(${target} PRIVATE ${MDOF_STANDARD_HEADERS} ${ARGN})
    target_compile_options(${target} PRIVATE -w)
  endif()
endfunction()
