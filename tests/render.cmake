# Pictures against tests/golden/NAME.png; candidates and differences of failed ones lie in BUILD/golden.
add_library(dem_golden STATIC support/golden.cpp)
target_link_libraries(dem_golden PUBLIC dem_render doctest::doctest PRIVATE dem_warnings)
target_compile_definitions(dem_golden PRIVATE DEM_GOLDEN_BASELINES="${PROJECT_SOURCE_DIR}/tests/golden"
                                              DEM_GOLDEN_OUT="${PROJECT_BINARY_DIR}/golden")

dem_test(test_render_colour SOURCES unit/test_colour.cpp LIBRARIES dem_render)
dem_test(test_render_parts SOURCES unit/test_render_parts.cpp LIBRARIES dem_render)
dem_test(test_render_files SOURCES unit/test_render_files.cpp LIBRARIES dem_golden)
dem_test(test_render_golden SOURCES unit/test_render_golden.cpp LIBRARIES dem_golden)
