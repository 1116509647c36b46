# The command line: options and verbs as such, then the program as used.
dem_test(test_options SOURCES cli/test_options.cpp cli/test_assets.cpp cli/test_last_words.cpp LIBRARIES dem_commands)
target_compile_definitions(test_options PRIVATE DEM_BUILD_DIR="${PROJECT_BINARY_DIR}")
dem_test(test_usage SOURCES cli/test_usage.cpp cli/program.cpp LIBRARIES dem_core)
dem_test(test_runs SOURCES cli/test_runs.cpp cli/program.cpp LIBRARIES dem_core)
dem_test(test_calibrate SOURCES cli/test_calibrate.cpp cli/program.cpp LIBRARIES dem_core nlohmann_json::nlohmann_json)
dem_test(test_night SOURCES cli/test_night.cpp cli/program.cpp LIBRARIES dem_core)
dem_test(test_tools SOURCES cli/test_tools.cpp cli/program.cpp LIBRARIES dem_core)
dem_test(test_shells SOURCES cli/test_shells.cpp cli/program.cpp LIBRARIES dem_commands)
dem_test(test_install SOURCES cli/test_install.cpp cli/program.cpp LIBRARIES dem_core)
target_compile_definitions(test_install PRIVATE DEM_BUILD_DIR="${PROJECT_BINARY_DIR}")
add_dependencies(test_install dem_shown)
foreach(test test_calibrate test_install test_shells test_usage test_runs test_night test_tools)
  target_compile_definitions(${test} PRIVATE DEM_PROGRAM="$<TARGET_FILE:dem-report>")
  add_dependencies(${test} dem-report)
endforeach()

# The launcher, in clones of its own with a CMake that only pretends. Exit code 77: not on this machine.
add_test(NAME test_launcher COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/cli/launcher)
set_tests_properties(test_launcher PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)

# Pages of smoke reports as Chromium shows and prints them, looked at by axe-core. Exit code 77: one of them is not to be had.
add_test(NAME test_pages COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/page/run $<TARGET_FILE:dem-report>
                                 ${CMAKE_CURRENT_BINARY_DIR}/pages)
set_tests_properties(test_pages PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1200 DEPENDS test_references
                                           ENVIRONMENT "DEM_SMOKE=${PROJECT_BINARY_DIR}/smoke")

# The Debian package in a bare system. Minutes, and the network: not in tests/run. Exit code 77: not on this machine.
add_test(NAME test_package COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/package/run ${PROJECT_BINARY_DIR})
set_tests_properties(test_package PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1800 LABELS "package")

# All scenarios at smoke scale against what was accepted. Exit code 77: there are no references.
add_test(NAME test_references
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/references/check $<TARGET_FILE:dem-report> ${PROJECT_BINARY_DIR}/smoke)
set_tests_properties(test_references PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1800 PROCESSORS 2 COST 300)
