add_executable(bench_texture bench/bench_texture.cpp)
target_include_directories(bench_texture PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(bench_texture PRIVATE dem_texture dem_warnings)
