# Under sanitizers the files of a folder are compiled together, in four parts: a build takes a third of the
# time, as most of it is headers. Names of the anonymous namespaces of a folder must then differ; a file with a
# name that stands elsewhere too ("redefinition", "ambiguous") gets another name for it, or a line here.
set(MDOF_COMPILED_ALONE
    algo/plausibility/encoder_jump.cpp algo/plausibility/plausibility_visits.cpp algo/points/robust_mean.cpp algo/sequence/sequence.cpp
    algo/sequence/sequence_cycle.cpp algo/sequence/sequence_odd_stops.cpp algo/sequence/usable_runs.cpp algo/sensitivity/statistics/moments.cpp
    algo/sensitivity/plan/experiment.cpp drivers/capancdt/controller.cpp drivers/labjack_t7/registers.cpp
    drivers/labjack_t7/stream.cpp drivers/labjack_u6/device.cpp drivers/mcc_usb1608fs_plus/protocol.cpp
    drivers/qsb/qsb.cpp drivers/simulator/options.cpp drivers/simulator/raw.cpp drivers/usb/simulated_usb.cpp
    daemon/methods/run.cpp daemon/measure/replay.cpp daemon/station/resume.cpp daemon/rpc/topic_hub.cpp
    daemon/store/study/study_read.cpp daemon/store/write.cpp tools/mdof/progress.cpp tools/mdof/commands/record.cpp
    tools/mdof/commands/replay.cpp tools/mdof/commands/status.cpp tools/mdof/plot/bins.cpp tools/mdof/plot/convergence.cpp
    tools/mdof/plot/frontier.cpp tools/mdof/plot/histogram.cpp tools/mdof/plot/indices.cpp
    tools/mdof/plot/panel.cpp tools/mdof/study/running/ranks.cpp tools/mdof_simulate/usbip.cpp
    tests/algo/sensitivity/indices_test.cpp tests/algo/sensitivity/plan_test.cpp
    tests/algo/sensitivity/presets_test.cpp tests/algo/sensitivity/statistics_test.cpp
    tests/daemon/measure/config_test.cpp tests/daemon/storekeeper/storekeeper_test.cpp tests/daemon/rpc/server_test.cpp
    tests/drivers/simulator_options_test.cpp tests/schema/base/number_columns_test.cpp
    tests/schema/base/number_test.cpp tests/drivers/modbus/driver_test.cpp
    tests/daemon/station/resume_test.cpp tests/daemon/station/unrecorded_test.cpp
)

# mdof_compile_together(TARGET): once all its sources are known, in the folder that made it.
function(mdof_compile_together target)
  if(NOT MDOF_SANITIZE)
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
      # By the first letter, so that a new file does not change who is compiled with whom.
      string(REGEX REPLACE "^[a-c].*" "a" part "${name}")
      string(REGEX REPLACE "^[d-l].*" "d" part "${part}")
      string(REGEX REPLACE "^[m-r].*" "m" part "${part}")
      string(REGEX REPLACE "^[s-z].*" "s" part "${part}")
      string(MAKE_C_IDENTIFIER "${folder}_${part}" group)
      set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
