# Plans and clusters.
dem_test(test_cluster SOURCES unit/test_cluster.cpp LIBRARIES dem_cluster dem_models)
dem_test(test_plan SOURCES cli/test_plan.cpp cli/program.cpp LIBRARIES dem_core)
target_compile_definitions(test_plan PRIVATE DEM_PROGRAM="$<TARGET_FILE:dem-report>")
add_dependencies(test_plan dem-report)
