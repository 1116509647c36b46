# Plans and clusters.
dem_test(test_cluster SOURCES unit/test_cluster.cpp unit/test_slurm_words.cpp LIBRARIES dem_cluster dem_models)
dem_test(test_plan SOURCES cli/test_plan.cpp cli/program.cpp LIBRARIES dem_core)
target_compile_definitions(test_plan PRIVATE DEM_PROGRAM="$<TARGET_FILE:dem-report>")
add_dependencies(test_plan dem-report)

# A real Slurm of one host. Exit code 77: there is none here.
add_test(NAME test_slurm COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/cluster/slurm)
set_tests_properties(test_slurm PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900 LABELS cluster COST 200
                                           ENVIRONMENT "DEM_PROGRAM=$<TARGET_FILE:dem-report>")
