# The command line: options and verbs as such, then the program as used.
dem_test(test_options SOURCES cli/test_options.cpp cli/test_assets.cpp LIBRARIES dem_commands)
target_compile_definitions(test_options PRIVATE DEM_BUILD_DIR="${PROJECT_BINARY_DIR}")
dem_test(test_usage SOURCES cli/test_usage.cpp cli/program.cpp LIBRARIES dem_core)
dem_test(test_runs SOURCES cli/test_runs.cpp cli/program.cpp LIBRARIES dem_core)
foreach(test test_usage test_runs)
  target_compile_definitions(${test} PRIVATE DEM_PROGRAM="$<TARGET_FILE:dem-report>")
  add_dependencies(${test} dem-report)
endforeach()
