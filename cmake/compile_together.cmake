# Compiles all files of a target together, because headers and templates take most of the time of a full build
# (tests/CAMPAIGNS.md has the figures). This is the default under sanitizers, in tools/quickstart and in .ci/run;
# after an edit of one file a separate compilation is faster. Compiled together, names in anonymous namespaces must
# differ. Folders that use equal names are in different parts below; tests are also divided by the first letter of the
# file. After a new clash ("redefinition", "ambiguous"), choose another name, a shared header, or another part for the
# folder. Files that Highway includes again for each instruction set, and files with a similar obstacle, are compiled
# alone.
set(MDOF_COMPILE_TOGETHER "$ENV{MDOF_COMPILE_TOGETHER}" CACHE STRING
    "Compile the files of a target together (ON, OFF; default: of the environment, else under sanitizers)")
set(MDOF_COMPILED_ALONE
  daemon/rpc/web/http_head.cpp
  schema/base/number/number_columns_vector.cpp
  schema/base/number/number_digits.cpp
)
set(MDOF_PART_2 algo_model algo_model_small_angle algo_on_the_fly algo_sensitivity_plan algo_sensitivity_statistics
  algo_uncertainty_positioning daemon_measure_replay daemon_rpc_session daemon_store_study daemon_storekeeper
  drivers_imported drivers_linux_comedi drivers_qsb schema_calibration schema_machine schema_recording schema_study
  tests_algo_compensation_d tests_algo_drift_m tests_algo_iso230_m tests_algo_iso230_positioning_m tests_algo_m
  tests_algo_plausibility_d tests_algo_plausibility_encoder_d tests_algo_sensitivity_d tests_algo_sensitivity_s
  tests_algo_uncertainty_budget_m tests_algo_uncertainty_effects_m tests_algo_uncertainty_m tests_algo_uncertainty_s
  tests_algo_uncertainty_statistics_s tests_daemon_measure_configuration_s tests_daemon_measure_s
  tests_daemon_rpc_line_d tests_daemon_rpc_line_m tests_daemon_rpc_session_s tests_daemon_station_a
  tests_daemon_station_device_a tests_daemon_store_m tests_daemon_storekeeper_s tests_drivers_linux_comedi_a
  tests_drivers_linux_counter_d tests_drivers_simulator_s tests_schema_plausibility_m tests_schema_recording_a
  tests_schema_rig_s tests_schema_study_m tools_mdof tools_mdof_commands_form tools_mdof_commands_milling
  tools_mdof_commands_part tools_mdof_csv tools_mdof_study)
set(MDOF_PART_3 algo_drift algo_sequence algo_uncertainty_effects drivers_labjack_u6 drivers_modbus tests_algo_form_m
  tests_algo_iso230_d tests_algo_iso230_s tests_algo_model_m tests_algo_on_the_fly_m tests_algo_plausibility_encoder_m
  tests_algo_plausibility_m tests_algo_plausibility_probe_m tests_algo_sensitivity_a tests_algo_sequence_s
  tests_algo_uncertainty_a tests_algo_uncertainty_budget_a tests_algo_uncertainty_statistics_a tests_daemon_station_d
  tests_drivers_csv_stream_a tests_drivers_linux_counter_m tools_mdof_commands_calibration
  tools_mdof_commands_compensation tools_mdof_commands_machine tools_mdof_commands_measure
  tools_mdof_commands_separate tools_mdof_study_running)
set(MDOF_PART_4 algo_compensation algo_compensation_volumetric algo_milling algo_separation drivers_csv_stream
  drivers_mcc_usb1608fs_plus tests_algo_compensation_a tests_algo_points_d tests_algo_separation_s
  tests_algo_uncertainty_d tests_algo_uncertainty_effects_d tests_algo_uncertainty_statistics_d
  tests_drivers_labjack_t7_a tests_drivers_linux_iio_d tools_mdof_text_analyses)
set(MDOF_PART_5 algo_calibration algo_uncertainty algo_uncertainty_budget drivers_pokeys57u tests_algo_form_a
  tests_algo_machine_geometric_tests_s tests_algo_machine_s tests_algo_separation_m tests_drivers_labjack_u6_a
  tests_drivers_qsb_d)
set(MDOF_PART_6 algo_plausibility algo_plausibility_encoder algo_plausibility_probe drivers_simulator
  tests_drivers_mcc_usb1608fs_plus_a)
set(MDOF_PART_7 algo_machine algo_machine_geometric_tests tests_drivers_modbus_d)
set(MDOF_PART_8 algo_sensitivity_kernels)
foreach(part RANGE 2 8)
  foreach(group ${MDOF_PART_${part}})
    set(MDOF_PART_OF_${group} ${part})
  endforeach()
endforeach()
foreach(file ${MDOF_COMPILED_ALONE})
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${file})
    message(FATAL_ERROR "cmake/compile_together.cmake names ${file}, which is not there: give its new name, or leave it out")
  endif()
endforeach()

# mdof_compile_together(TARGET): call it after all sources are known, in the folder that defines the target.
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
      string(MAKE_C_IDENTIFIER "${folder}" group)
      if(folder MATCHES "^tests")
        # Uses the first letter, so that a new file does not change the groups.
        string(REGEX REPLACE "^[a-c].*" "a" part "${name}")
        string(REGEX REPLACE "^[d-l].*" "d" part "${part}")
        string(REGEX REPLACE "^[m-r].*" "m" part "${part}")
        string(REGEX REPLACE "^[s-z].*" "s" part "${part}")
        set(group "${group}_${part}")
      endif()
      set(part 1)
      if(DEFINED MDOF_PART_OF_${group})
        set(part ${MDOF_PART_OF_${group}})
      endif()
      set_source_files_properties(${file} PROPERTIES UNITY_GROUP part_${part})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class in a source file may have members from its anonymous namespace, even if the file is included elsewhere.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()
