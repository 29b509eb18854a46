# Every target links mdof_options: C++20, warnings as errors, hardening, and arithmetic that gives the same bits with
# every compiler and build type: no contraction into fused multiply-add, and Eigen without vectorised reductions, so
# that each sum has the order of the source.
add_library(mdof_options INTERFACE)
target_include_directories(mdof_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(mdof_options INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY
                           $<$<CONFIG:Release>:EIGEN_NO_DEBUG>)
target_compile_options(mdof_options INTERFACE
  -ffp-contract=off
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Werror
  # When files are compiled together, a local name may shadow a name in the anonymous namespace of another file. g++
  # still reports locals that shadow locals; builds with separate files report all other cases.
  $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false alarms of g++ 12 on std::string + (GCC bug 105329)
  -fstack-protector-strong)
target_link_options(mdof_options INTERFACE -Wl,-z,relro,-z,now)

# For tools/quickstart, which builds everything: no optimisation (the same bits, slower programs) and no debug
# information. When files are compiled together, precompiled headers save little.
option(MDOF_BUILD_QUICKLY "Spend as little time as possible on compiling" OFF)

# Assertions guard against bugs and stay on in Release. No build has debug information, which takes a fifth of its time;
# CXXFLAGS=-g1 adds line numbers.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
if(MDOF_BUILD_QUICKLY)
  set(CMAKE_CXX_FLAGS_RELEASE "-O0")
  target_compile_options(mdof_options INTERFACE -w)  # warnings are errors in every other build
endif()
set(CMAKE_C_FLAGS_RELEASE "-O2")
if(MDOF_SANITIZE)
  target_compile_definitions(mdof_options INTERFACE MDOF_SANITIZED)
  target_compile_options(mdof_options INTERFACE -fsanitize=${MDOF_SANITIZE}
                         -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(NOT MDOF_SANITIZE STREQUAL thread)
    target_compile_options(mdof_options INTERFACE
                           -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitizer_ignore.txt)
  endif()
  # Fixed addresses; otherwise each start of a program relocates 800,000 pointers of the sanitizer's checks.
  set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(mdof_options INTERFACE $<$<NOT:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,MODULE_LIBRARY>>:-fno-pie>)
  target_link_options(mdof_options INTERFACE -fsanitize=${MDOF_SANITIZE}
                      $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-no-pie>)
else()
  target_compile_definitions(mdof_options INTERFACE $<$<CONFIG:Release>:_FORTIFY_SOURCE=2>
                             _GLIBCXX_ASSERTIONS)
endif()
find_program(MOLD mold)
if(MOLD)
  target_link_options(mdof_options INTERFACE -fuse-ld=mold)
endif()

# For code that calculates: loops over samples, trials and digits. Under sanitizers -O2 takes three times as long to
# compile, so only this target and the next one use it.
set(OPTIMISED $<AND:$<CONFIG:Release>,$<NOT:$<BOOL:${MDOF_BUILD_QUICKLY}>>>)
add_library(mdof_hot INTERFACE)
target_compile_options(mdof_hot INTERFACE $<${OPTIMISED}:-O3>)
if(MDOF_SANITIZE)
  target_compile_options(mdof_hot INTERFACE -O2)
endif()

# For code that waits for devices.
add_library(mdof_waiting INTERFACE)
target_compile_options(mdof_waiting INTERFACE $<${OPTIMISED}:-O1>)
if(MDOF_SANITIZE)  # simulated devices must keep pace with the clock
  target_compile_options(mdof_waiting INTERFACE -O2)
endif()

# For code that calculates nothing (most tests, the command line): compiling takes longer than running.
add_library(mdof_cold INTERFACE)
target_compile_options(mdof_cold INTERFACE $<${OPTIMISED}:-O1>)
